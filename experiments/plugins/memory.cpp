#include "experiments/plugins/memory.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <new>

namespace ogc::experiments {

namespace {

std::size_t page() {
  static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size;
}

std::size_t whole_pages(std::size_t bytes) { return (bytes + page() - 1) / page() * page(); }

/// Size of the protected address space before and behind an array [bytes]. It occupies no memory. Accesses farther away
/// are not caught.
constexpr std::size_t untouchable = 16u << 20;

/// Holds pages between two protected ranges of address space.
class Pages {
 public:
  explicit Pages(std::size_t bytes) : bytes_(whole_pages(bytes)) {
    void* const mapped = mmap(nullptr, bytes_ + 2 * untouchable, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE,
                              -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    base_ = static_cast<std::byte*>(mapped);
    protect(PROT_READ | PROT_WRITE);
  }
  ~Pages() {
    if (base_) munmap(base_, bytes_ + 2 * untouchable);
  }
  Pages(Pages&& other) noexcept : base_(other.base_), bytes_(other.bytes_) { other.base_ = nullptr; }
  Pages(const Pages&) = delete;
  Pages& operator=(const Pages&) = delete;
  Pages& operator=(Pages&&) = delete;

  void protect(int access) {
    if (bytes_ > 0 && mprotect(begin(), bytes_, access) != 0) throw std::bad_alloc();
  }
  std::byte* begin() const { return base_ + untouchable; }
  std::byte* end() const { return begin() + bytes_; }

 private:
  std::byte* base_;
  std::size_t bytes_;
};

bool holds_pattern(Bytes zone) {
  const std::vector<std::byte> expected = pattern(zone.size(), 4);
  return std::memcmp(zone.data(), expected.data(), zone.size()) == 0;
}

class HostMemory final : public PluginMemory {
 public:
  const void* input(Bytes content) override {
    // Rounds up to 16 bytes, the alignment that a compiler may assume for vector loads.
    const std::size_t bytes = (content.size() + 15) / 16 * 16;
    Pages& pages = inputs_.emplace_back(bytes);
    std::byte* const data = pages.end() - bytes;
    if (!content.empty()) std::memcpy(data, content.data(), content.size());
    pages.protect(PROT_READ);
    return data;
  }

  void* output(std::size_t bytes, std::size_t unit) override {
    Pages pages(guard_bytes + bytes + guard_bytes);
    std::byte* const data = pages.begin() + guard_bytes;
    fill(pages.begin(), data, 4);
    fill(data, data + bytes, unit);
    fill(data + bytes, data + bytes + guard_bytes, 4);
    outputs_.push_back({std::move(pages), data, bytes});
    return data;
  }

  void synchronize() override {}

  Damage damage(std::size_t k) override {
    const Output& output = outputs_[k];
    if (!holds_pattern({output.data - guard_bytes, guard_bytes})) return Damage::before;
    return holds_pattern({output.data + output.bytes, guard_bytes}) ? Damage::none : Damage::behind;
  }

  std::vector<std::byte> content(std::size_t k, std::size_t bytes) override {
    return {outputs_[k].data, outputs_[k].data + bytes};
  }

  void release() override {
    inputs_.clear();
    outputs_.clear();
  }

  bool can_go_on() override { return false; }

 private:
  struct Output {
    Pages pages;
    std::byte* data;
    std::size_t bytes;
  };
  static void fill(std::byte* first, std::byte* last, std::size_t unit) {
    const std::vector<std::byte> bytes = pattern(static_cast<std::size_t>(last - first), unit);
    std::copy(bytes.begin(), bytes.end(), first);
  }
  std::vector<Pages> inputs_;
  std::vector<Output> outputs_;
};

}  // namespace

std::vector<std::byte> pattern(std::size_t bytes, std::size_t unit) {
  if (unit == 1) return std::vector<std::byte>(bytes, std::byte{unwritten_byte});
  std::vector<std::byte> filled(bytes);
  for (std::size_t i = 0; i < bytes; ++i) filled[i] = static_cast<std::byte>(unwritten_word >> (8 * (i % 4)));
  return filled;
}

std::unique_ptr<PluginMemory> host_memory() { return std::make_unique<HostMemory>(); }

}  // namespace ogc::experiments

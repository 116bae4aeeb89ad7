// A socket between `ogc` and a worker process, and blocks of bytes over it: each with its length in front, so that both sides read what was written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace ogc::experiments {

using Bytes = std::span<const std::byte>;

/// The bytes of items that lie one behind the other.
template <class Items>
Bytes bytes_of(const Items& items) {
  static_assert(std::is_trivially_copyable_v<typename Items::value_type>);
  return std::as_bytes(std::span(items.data(), items.size()));
}

/// The bytes of one item.
template <class Item>
Bytes bytes_of_one(const Item& item) {
  static_assert(std::is_trivially_copyable_v<Item>);
  return std::as_bytes(std::span(&item, 1));
}

enum class Received { block, end, timeout };

/// One end of the socket, which it owns.
class Channel {
 public:
  Channel() = default;
  explicit Channel(int descriptor) : descriptor_(descriptor) {}
  ~Channel() { close(); }
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  Channel(Channel&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  Channel& operator=(Channel&& other) noexcept;

  void close();
  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  /// False where the other side is gone.
  bool send(Bytes block);
  /// Waits for a block; `seconds` < 0: for ever. `end` where the other side is gone, also in the middle of a block.
  Received receive(std::vector<std::byte>& block, double seconds);

 private:
  Received read(std::byte* to, std::size_t count, const std::optional<double>& deadline);
  int descriptor_ = -1;
};

/// A text as it is sent and as it comes back.
inline std::string text_of(const std::vector<std::byte>& block) { return {reinterpret_cast<const char*>(block.data()), block.size()}; }

}  // namespace ogc::experiments

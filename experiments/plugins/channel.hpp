// Connects `ogc` and a worker process by a socket, and sends blocks of bytes over it. Each block begins with a mark and
// its length, so that a reader recognises bytes that are no block. A plug-in runs in the worker's process and can write
// to the socket. Everything that arrives is therefore checked before it is used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace ogc::experiments {

/// A block to send.
using Bytes = std::span<const std::byte>;

/// Returns the bytes of contiguous items.
template <class Items>
Bytes bytes_of(const Items& items) {
  static_assert(std::is_trivially_copyable_v<typename Items::value_type>);
  return std::as_bytes(std::span(items.data(), items.size()));
}

/// Returns the bytes of one item.
template <class Item>
Bytes bytes_of_one(const Item& item) {
  static_assert(std::is_trivially_copyable_v<Item>);
  return std::as_bytes(std::span(&item, 1));
}

/// Holds the head in front of each block.
struct BlockHead {
  std::uint64_t mark = right_mark;  ///< tells a head from other bytes
  std::uint64_t length = 0;         ///< bytes of the block that follows the head
  /// The bytes "gc-block". A plug-in is unlikely to send them by chance in a length, a count or a text.
  static constexpr std::uint64_t right_mark = 0x6b636f6c622d6367;
};

struct BlockLength {
  std::uint64_t least = 0, most = std::numeric_limits<std::uint64_t>::max();  ///< inclusive
};
/// Allows exactly this length.
constexpr BlockLength exactly(std::uint64_t bytes) { return {bytes, bytes}; }

/// Thrown if the received bytes are no block or have a wrong length. what() completes the sentence "a message …".
struct MalformedBlock : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Result of a transfer.
enum class Transfer {
  whole,
  end,  ///< the other process closed the socket, possibly in the middle of a block
  timeout,
};

/// Limits how long to wait for the other process.
struct Patience {
  double seconds = -1;  ///< < 0: for ever
  /// Returns whether the other process is still running. The socket alone can't show this, because children of that
  /// process may keep it open.
  std::function<bool()> other_runs{};
};

/// Owns one end of the socket.
class Channel {
 public:
  Channel() = default;
  explicit Channel(int descriptor) : descriptor_(descriptor) {}
  ~Channel() { close(); }
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  Channel(Channel&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  Channel& operator=(Channel&& other) noexcept;

  /// Closes this end of the socket; the other process then receives Transfer::end.
  void close();
  /// Returns whether this end is open.
  bool is_open() const { return descriptor_ >= 0; }
  /// Returns the socket's descriptor; negative if closed.
  int descriptor() const { return descriptor_; }
  Transfer send(Bytes block, const Patience& patience = {});
  /// Waits for a block. Throws MalformedBlock, before it allocates memory for the block, if the head is invalid or the
  /// length is not allowed.
  Transfer receive(std::vector<std::byte>& block, BlockLength allowed, const Patience& patience = {});

 private:
  using Deadline = std::optional<double>;
  Transfer wait(short until, const Patience& patience, const Deadline& deadline) const;
  Transfer read(std::span<std::byte> to, const Patience& patience, const Deadline& deadline);
  int descriptor_ = -1;
};

/// Returns a received block as text.
inline std::string text_of(const std::vector<std::byte>& block) {
  return {reinterpret_cast<const char*>(block.data()), block.size()};
}

}  // namespace ogc::experiments

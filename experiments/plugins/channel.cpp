#include "experiments/plugins/channel.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>

namespace ogc::experiments {

namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Milliseconds for poll, rounded up; -1 waits for ever.
int milliseconds_until(const std::optional<double>& deadline) {
  if (!deadline) return -1;
  return static_cast<int>(std::clamp((*deadline - now()) * 1000 + 1, 0.0, 1e9));
}

}  // namespace

Channel& Channel::operator=(Channel&& other) noexcept {
  if (this != &other) {
    close();
    std::swap(descriptor_, other.descriptor_);
  }
  return *this;
}

void Channel::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

bool Channel::send(Bytes block) {
  const std::uint64_t length = block.size();
  for (Bytes rest : {bytes_of_one(length), block}) {
    while (!rest.empty()) {
      const ssize_t sent = ::send(descriptor_, rest.data(), rest.size(), MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) return false;
      rest = rest.subspan(static_cast<std::size_t>(sent));
    }
  }
  return true;
}

Received Channel::receive(std::vector<std::byte>& block, double seconds) {
  const std::optional<double> deadline = seconds < 0 ? std::nullopt : std::optional(now() + seconds);
  std::uint64_t length = 0;
  if (const Received head = read(reinterpret_cast<std::byte*>(&length), sizeof length, deadline); head != Received::block) return head;
  block.resize(length);
  return read(block.data(), length, deadline);
}

Received Channel::read(std::byte* to, std::size_t count, const std::optional<double>& deadline) {
  while (count > 0) {
    pollfd waiting{descriptor_, POLLIN, 0};
    const int ready = poll(&waiting, 1, milliseconds_until(deadline));
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) return Received::timeout;
    const ssize_t got = ready < 0 ? -1 : ::read(descriptor_, to, count);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return Received::end;
    to += got;
    count -= static_cast<std::size_t>(got);
  }
  return Received::block;
}

}  // namespace ogc::experiments

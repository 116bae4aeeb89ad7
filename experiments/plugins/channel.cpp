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

/// Time between two checks whether the other process is still running [ms].
constexpr int look_again = 50;
/// A block grows by this number of bytes at a time while it arrives. So memory follows the received bytes, not the
/// announced length.
constexpr std::uint64_t piece = 16u << 20;

std::optional<double> deadline_of(const Patience& patience) {
  return patience.seconds < 0 ? std::nullopt : std::optional(now() + patience.seconds);
}

/// Returns the milliseconds for poll, rounded up; -1 waits for ever.
int milliseconds_until(const std::optional<double>& deadline) {
  if (!deadline) return -1;
  return static_cast<int>(std::clamp((*deadline - now()) * 1000 + 1, 0.0, 1e9));
}

/// Returns the allowed lengths as text, "88" or "0 to 65536".
std::string printed(BlockLength allowed) {
  return (allowed.least == allowed.most ? "" : std::to_string(allowed.least) + " to ") + std::to_string(allowed.most);
}

void check(const BlockHead& head, BlockLength allowed) {
  if (head.mark != BlockHead::right_mark) throw MalformedBlock("does not begin as its messages do");
  if (head.length < allowed.least || head.length > allowed.most)
    throw MalformedBlock("is " + std::to_string(head.length) + " bytes long instead of " + printed(allowed));
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

Transfer Channel::send(Bytes block, const Patience& patience) {
  const Deadline deadline = deadline_of(patience);
  const BlockHead head{.length = block.size()};
  for (Bytes rest : {bytes_of_one(head), block}) {
    while (!rest.empty()) {
      if (const Transfer ready = wait(POLLOUT, patience, deadline); ready != Transfer::whole) return ready;
      const ssize_t sent = ::send(descriptor_, rest.data(), rest.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent < 0 && (errno == EINTR || errno == EAGAIN)) continue;
      if (sent <= 0) return Transfer::end;
      rest = rest.subspan(static_cast<std::size_t>(sent));
    }
  }
  return Transfer::whole;
}

Transfer Channel::receive(std::vector<std::byte>& block, BlockLength allowed, const Patience& patience) {
  const Deadline deadline = deadline_of(patience);
  BlockHead head;
  const auto head_bytes = std::as_writable_bytes(std::span(&head, 1));
  if (const Transfer got = read(head_bytes, patience, deadline); got != Transfer::whole) return got;
  check(head, allowed);
  block.clear();
  while (block.size() < head.length) {
    const std::size_t before = block.size();
    block.resize(before + std::min(piece, head.length - before));
    if (const Transfer got = read(std::span(block).subspan(before), patience, deadline); got != Transfer::whole)
      return got;
  }
  return Transfer::whole;
}

Transfer Channel::wait(short until, const Patience& patience, const Deadline& deadline) const {
  for (;;) {
    // The process is checked before the socket. If it has ended, the socket may still hold data that it sent.
    const bool runs = !patience.other_runs || patience.other_runs();
    const int left = milliseconds_until(deadline), soon = left < 0 ? look_again : std::min(left, look_again);
    const int turn = patience.other_runs ? soon : left;
    pollfd waiting{descriptor_, until, 0};
    const int ready = poll(&waiting, 1, runs ? turn : 0);
    if (ready > 0) return Transfer::whole;
    if (ready < 0 && errno != EINTR) return Transfer::end;
    if (ready == 0 && !runs) return Transfer::end;
    if (ready == 0 && left >= 0 && turn == left) return Transfer::timeout;
  }
}

Transfer Channel::read(std::span<std::byte> to, const Patience& patience, const Deadline& deadline) {
  while (!to.empty()) {
    if (const Transfer ready = wait(POLLIN, patience, deadline); ready != Transfer::whole) return ready;
    const ssize_t got = ::read(descriptor_, to.data(), to.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return Transfer::end;
    to = to.subspan(static_cast<std::size_t>(got));
  }
  return Transfer::whole;
}

}  // namespace ogc::experiments

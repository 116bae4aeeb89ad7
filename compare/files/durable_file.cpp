#include "compare/files/durable_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "compare/files/bytes.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

/// A folder that is gone, or a disk that takes no more writing, was there when the program began to write: the machine
/// failed, not the user.
[[noreturn]] void refuse(const std::filesystem::path& path, const char* action, int error) {
  if (error != ENOENT && error != EROFS) refuse_path(path, action, {error, std::generic_category()});
  throw ResourceError(path.string() + ": can't " + action + " (" + std::strerror(error) +
                      "): its folder or disk was taken away");
}

/// An open file that is closed on every way out.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : number(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (number < 0) refuse(path, "open the file", errno);
  }
  ~Descriptor() { ::close(number); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  const int number;
};

/// 0, or the error that stopped it.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(descriptor) == 0 ? 0 : errno;
}

/// False where another process has it; a file system without locks has no process to tell of.
bool take_lock(int descriptor) { return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

[[noreturn]] void refuse_locked(const std::filesystem::path& path) {
  throw InputError(path.string() +
                   ": another process writes to it: the run is still going on; wait for it, or stop it");
}

}  // namespace

void expect_no_appender(const std::filesystem::path& path) {
  const Descriptor file(path, O_RDONLY);
  if (!take_lock(file.number)) refuse_locked(path);
}

std::filesystem::path partial_name(const std::filesystem::path& path) { return path.string() + ".partial"; }

void sync_to_disk(const std::filesystem::path& path) {
  const Descriptor file(path, O_RDONLY);
  if (::fsync(file.number) != 0) refuse(path, "sync to the disk", errno);
}

void commit_partial(const std::filesystem::path& path) {
  const std::filesystem::path partial = partial_name(path);
  sync_to_disk(partial);
  if (std::rename(partial.c_str(), path.c_str()) != 0) refuse(path, "rename the finished file", errno);
  sync_to_disk(path.has_parent_path() ? path.parent_path() : ".");
}

void write_durably(const std::filesystem::path& path, std::string_view bytes) {
  const std::filesystem::path partial = partial_name(path);
  int error = 0;
  {
    const Descriptor file(partial, O_WRONLY | O_CREAT | O_TRUNC);
    error = write_all(file.number, bytes);
  }
  if (error != 0) {
    ::unlink(partial.c_str());
    refuse(path, "write the file", error);
  }
  commit_partial(path);
}

void write_and_reserve(const std::filesystem::path& path, std::string_view bytes, std::size_t size) {
  int error = 0;
  {
    const Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
    error = write_all(file.number, bytes);
    if (error == 0) error = ::posix_fallocate(file.number, 0, static_cast<off_t>(size));
  }
  if (error == 0) return;
  ::unlink(path.c_str());
  refuse(path, ("reserve " + std::to_string(size >> 10) + " KiB").c_str(), error);
}

LineAppender::LineAppender(const std::filesystem::path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) refuse(path, "open the file", errno);
  take_lock(descriptor_);
}

LineAppender::LineAppender(const std::filesystem::path& path, std::size_t length)
    : path_(path), descriptor_(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC)), length_(length) {
  if (descriptor_ < 0) refuse(path, "open the file", errno);
  if (!take_lock(descriptor_)) {
    ::close(descriptor_);
    refuse_locked(path);
  }
  if (::ftruncate(descriptor_, static_cast<off_t>(length)) == 0) return;
  const int error = errno;
  ::close(descriptor_);
  refuse(path, "cut the file", error);
}

LineAppender::~LineAppender() { ::close(descriptor_); }

void LineAppender::append(std::string_view lines) {
  if (const int error = write_all(descriptor_, lines); error != 0) {
    const bool restored = ::ftruncate(descriptor_, static_cast<off_t>(length_)) == 0;
    refuse(path_, restored ? "append lines" : "append lines, and the last one may be incomplete", error);
  }
  length_ += lines.size();
}

}  // namespace ogc::compare

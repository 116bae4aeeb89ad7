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

/// Throws for a failed action. A missing folder or a read-only disk is a ResourceError here: the folder existed and the
/// disk was writable when the program began to write, so the machine failed, not the user.
[[noreturn]] void refuse(const std::filesystem::path& path, const char* action, int error) {
  if (error != ENOENT && error != EROFS) refuse_path(path, action, {error, std::generic_category()});
  throw ResourceError(path.string() + ": can't " + action + " (" + std::strerror(error) +
                      "): its folder or disk was taken away");
}

/// Owns an open file; the destructor closes it.
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

/// Writes all bytes; returns 0 or the error that stopped it.
int write_bytes_of(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Writes all bytes and syncs; returns 0 or the error that stopped it.
int write_and_sync(int descriptor, std::string_view bytes) {
  const int error = write_bytes_of(descriptor, bytes);
  return error != 0 || ::fsync(descriptor) == 0 ? error : errno;
}

void rename_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) refuse(to, "rename the finished file", errno);
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

/// Creates a file and calls `write`, which returns an error or 0. Leaves no file after an error.
template <class Write>
void write_new(const std::filesystem::path& path, const std::filesystem::path& named, const char* action, Write write) {
  int error = 0;
  {
    const Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
    error = write(file.number);
  }
  if (error == 0) return;
  ::unlink(path.c_str());
  refuse(named, action, error);
}

/// Takes the lock; returns false if another process holds it. On a file system without locks it always succeeds.
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

void commit_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  sync_to_disk(from);
  rename_file(from, to);
  sync_to_disk(folder_of(to));
}

void commit_partial(const std::filesystem::path& path) { commit_file(partial_name(path), path); }

void write_durably(const std::filesystem::path& path, std::string_view bytes) {
  write_new(partial_name(path), path, "write the file", [&](int file) { return write_and_sync(file, bytes); });
  commit_partial(path);
}

void write_partial(const std::filesystem::path& path, std::string_view bytes) {
  write_new(partial_name(path), path, "write the file", [&](int file) { return write_bytes_of(file, bytes); });
}

void commit_group(const std::filesystem::path& folder, std::span<const std::filesystem::path> files) {
  const Descriptor file(folder, O_RDONLY | O_DIRECTORY);
  if (::syncfs(file.number) != 0) refuse(folder, "sync to the disk", errno);
  for (const std::filesystem::path& path : files) rename_file(partial_name(path), path);
  if (!files.empty() && ::fsync(file.number) != 0) refuse(folder, "sync to the disk", errno);
}

void write_and_reserve(const std::filesystem::path& path, std::string_view bytes, std::size_t size) {
  write_new(path, path, ("reserve " + std::to_string(size >> 10) + " KiB").c_str(), [&](int file) {
    const int error = write_and_sync(file, bytes);
    return error != 0 ? error : ::posix_fallocate(file, 0, static_cast<off_t>(size));
  });
}

void reserve(const std::filesystem::path& path, std::size_t from, std::size_t to) {
  const Descriptor file(path, O_WRONLY);
  const int error = ::posix_fallocate(file.number, static_cast<off_t>(from), static_cast<off_t>(to - from));
  if (error != 0) refuse(path, ("reserve " + std::to_string(to >> 10) + " KiB").c_str(), error);
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
  if (const int error = write_bytes_of(descriptor_, lines); error != 0) {
    const bool restored = ::ftruncate(descriptor_, static_cast<off_t>(length_)) == 0;
    refuse(path_, restored ? "append lines" : "append lines, and the last one may be incomplete", error);
  }
  length_ += lines.size();
}

}  // namespace ogc::compare

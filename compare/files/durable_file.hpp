// Writes files that a killed run leaves whole: under a temporary name, synced, then renamed. Temporary names end in
// ".partial", which no reader looks for.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace ogc::compare {

/// Returns the temporary name: `path` followed by ".partial".
std::filesystem::path partial_name(const std::filesystem::path& path);

/// Writes all of `bytes` under the partial name and commits it. Throws ResourceError with the path if the disk fails;
/// then neither name remains. Throws InputError if another path or right would do (compare/files/bytes.hpp); so do all
/// functions here.
void write_durably(const std::filesystem::path& path, std::string_view bytes);

/// Writes `bytes` to a new file and reserves `size` bytes of disk for it, so that filling it meets no full disk. Throws
/// ResourceError, and leaves no file then.
void write_and_reserve(const std::filesystem::path& path, std::string_view bytes, std::size_t size);

/// Reserves disk for an existing file from byte `from` to byte `to`, which becomes its end if it was shorter. Throws
/// ResourceError.
void reserve(const std::filesystem::path& path, std::size_t from, std::size_t to);

/// Writes all of `bytes` under the partial name. They survive a killed program at once, and a power cut once
/// commit_group has synced them. Throws ResourceError with the path if the disk fails; then the partial name does not
/// remain.
void write_partial(const std::filesystem::path& path, std::string_view bytes);

/// Syncs the file system of `folder` once, with everything that any program wrote there; then gives `files` of that
/// folder, whose partial names were written, their names, and syncs the folder. A hundred files cost as much as one.
/// Throws ResourceError.
void commit_group(const std::filesystem::path& folder, std::span<const std::filesystem::path> files);

/// Syncs `from`, renames it to `to` in the same folder, and syncs the folder. Throws ResourceError.
void commit_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Syncs the partial file of `path`, gives it its name, and syncs the folder. Throws ResourceError.
void commit_partial(const std::filesystem::path& path);

/// Syncs a file or folder that has its final name. Throws ResourceError.
void sync_to_disk(const std::filesystem::path& path);

/// Throws InputError if a LineAppender of another process has the file.
void expect_no_appender(const std::filesystem::path& path);

/// Appends whole lines to a file, and holds a lock on it that ends with the process, however the process ends.
class LineAppender {
 public:
  /// Creates the file. Throws ResourceError if that fails.
  explicit LineAppender(const std::filesystem::path& path);
  /// Continues a file and keeps its first `length` bytes. Throws InputError if another process appends to it,
  /// ResourceError if it cannot be opened.
  LineAppender(const std::filesystem::path& path, std::size_t length);
  ~LineAppender();
  LineAppender(const LineAppender&) = delete;
  LineAppender& operator=(const LineAppender&) = delete;
  /// Appends lines, each with its line end. They survive a killed program, but a power cut only once synced. If the
  /// disk fails the file keeps its former length, and ResourceError is thrown.
  void append(std::string_view lines);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::size_t length_ = 0;
};

}  // namespace ogc::compare

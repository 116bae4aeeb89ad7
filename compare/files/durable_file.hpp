// Files that a killed run leaves whole: written under a temporary name, synced, renamed. The name of the temporary file
// ends in ".partial", which no reader looks for.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace ogc::compare {

/// Where a file is written before it gets its name: `path` with ".partial" behind it.
std::filesystem::path partial_name(const std::filesystem::path& path);

/// Writes all of `bytes` under the partial name and commits it. Throws ResourceError with the path where the disk does
/// not take it; then neither name is left. Throws InputError where another path or right would do
/// (compare/files/bytes.hpp), as all of these do.
void write_durably(const std::filesystem::path& path, std::string_view bytes);

/// Writes `bytes` to a new file and reserves `size` bytes of disk for it, so that whoever fills it meets no full disk.
/// Throws ResourceError, and leaves no file then.
void write_and_reserve(const std::filesystem::path& path, std::string_view bytes, std::size_t size);

/// Reserves the disk for an existing file from byte `from` to byte `to`, which becomes its end where it was shorter.
/// Throws ResourceError.
void reserve(const std::filesystem::path& path, std::size_t from, std::size_t to);

/// Writes all of `bytes` under the partial name. They survive a killed program at once, a power cut when commit_group
/// has synced them. Throws ResourceError with the path where the disk does not take it; then the partial name is not
/// left.
void write_partial(const std::filesystem::path& path, std::string_view bytes);

/// Syncs the file system of `folder` once, with all that was written there, whoever wrote it; then the files of that
/// folder whose partial names were written get their names, and the folder is synced. A hundred files cost what one
/// does. Throws ResourceError.
void commit_group(const std::filesystem::path& folder, std::span<const std::filesystem::path> files);

/// Syncs `from`, gives it the name `to` in the same folder, and syncs the folder. Throws ResourceError.
void commit_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Syncs the partial file of `path`, gives it its name, and syncs the folder. Throws ResourceError.
void commit_partial(const std::filesystem::path& path);

/// Syncs a file or folder that stands under its name already. Throws ResourceError.
void sync_to_disk(const std::filesystem::path& path);

/// Throws InputError where a LineAppender of another process has the file.
void expect_no_appender(const std::filesystem::path& path);

/// Appends to a file by whole lines, and holds a lock on it that ends with the process, however that ends.
class LineAppender {
 public:
  /// Creates the file; throws ResourceError where it can't.
  explicit LineAppender(const std::filesystem::path& path);
  /// Goes on with a file of which the first `length` bytes are kept. Throws InputError where another process appends to
  /// it, ResourceError where it can't.
  LineAppender(const std::filesystem::path& path, std::size_t length);
  ~LineAppender();
  LineAppender(const LineAppender&) = delete;
  LineAppender& operator=(const LineAppender&) = delete;
  /// Appends lines, each with its line end. They survive a killed program; a power cut leaves those that were synced.
  /// Where the disk does not take them the file keeps its former length, and ResourceError is thrown.
  void append(std::string_view lines);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::size_t length_ = 0;
};

}  // namespace ogc::compare

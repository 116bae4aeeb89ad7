// Writes files so that a killed run leaves only complete ones: under a temporary name, synced, then renamed. Temporary
// names end in ".partial", which no reader looks for.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace ogc::compare {

/// Returns the temporary name: `path` followed by ".partial".
std::filesystem::path partial_name(const std::filesystem::path& path);

/// Writes `bytes` under the partial name and commits the file. If the disk fails, leaves no file under either name and
/// throws ResourceError with the path. All functions here throw InputError if another path or other rights would solve
/// an error (compare/files/bytes.hpp).
void write_durably(const std::filesystem::path& path, std::string_view bytes);

/// Writes `bytes` to a new file and reserves `size` bytes of disk for it, so that later writes cannot find the disk
/// full. Throws ResourceError, and leaves no file then.
void write_and_reserve(const std::filesystem::path& path, std::string_view bytes, std::size_t size);

/// Reserves disk space for an existing file from byte `from` to byte `to`. A shorter file is extended to `to`. Throws
/// ResourceError.
void reserve(const std::filesystem::path& path, std::size_t from, std::size_t to);

/// Writes `bytes` under the partial name. After return the bytes survive if the program is killed. They survive a power
/// cut only after commit_group. If the disk fails, leaves no partial file and throws ResourceError with the path.
void write_partial(const std::filesystem::path& path, std::string_view bytes);

/// Syncs the file system of `folder` once, including all that other programs wrote there. Then renames `files` of that
/// folder from their partial to their final names, and syncs the folder. The cost does not depend on the number of
/// files. Throws ResourceError.
void commit_group(const std::filesystem::path& folder, std::span<const std::filesystem::path> files);

/// Syncs `from`, renames it to `to` in the same folder, and syncs the folder. Throws ResourceError.
void commit_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Syncs the partial file of `path`, renames it to `path`, and syncs the folder. Throws ResourceError.
void commit_partial(const std::filesystem::path& path);

/// Syncs a file or folder that has its final name. Throws ResourceError.
void sync_to_disk(const std::filesystem::path& path);

/// Throws InputError if another process holds the file with a LineAppender.
void expect_no_appender(const std::filesystem::path& path);

/// Appends whole lines to a file and holds a lock on it. The system releases the lock when the process ends or is
/// killed.
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
  /// Appends lines, each with its line end. After return the lines survive if the program is killed. They survive a
  /// power cut only after a sync. If the disk fails, cuts the file to its former length and throws ResourceError.
  void append(std::string_view lines);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::size_t length_ = 0;
};

}  // namespace ogc::compare

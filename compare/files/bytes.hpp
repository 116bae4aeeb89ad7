// Reads and writes whole files. Meshes and scenes are small enough for that, and a parser of one string can name the
// line of every error.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace ogc::compare {

/// Throws "PATH: can't ACTION (REASON): REMEDY" for the failure `error` at `path`. It is an InputError if another path
/// or other rights would solve the error (no such folder, a file in its place, a loop of links, a name that is too
/// long, no permission), and a ResourceError if the disk failed.
[[noreturn]] void refuse_path(const std::filesystem::path& path, const std::string& action, std::error_code error);

/// Throws InputError that names the path if it has no content to read: it is missing, a folder, or a pipe or device,
/// which might never end.
void expect_regular_file(const std::filesystem::path& path);

/// Returns the content of a regular file. Throws InputError that names the path if expect_regular_file throws or the
/// file cannot be read.
std::string read_bytes(const std::filesystem::path& path);

/// Writes a file, replacing one of the same name, and creates missing folders. Throws the errors of refuse_path.
void write_bytes(const std::filesystem::path& path, std::string_view bytes);

/// Returns FNV-1a over 64 bits as 16 hexadecimal digits. It detects damage, but no forgery.
std::string digest(std::string_view bytes);

}  // namespace ogc::compare

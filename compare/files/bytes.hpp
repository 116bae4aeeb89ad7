// Reads and writes whole files: meshes and scenes are small enough, and a parser over one string can name every line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace ogc::compare {

/// Throws "PATH: can't ACTION (REASON): REMEDY" for a failure `error` at `path`: an InputError if another path or right
/// would do (no such folder, a file in its place, a loop of links, a name that is too long, no permission), a
/// ResourceError if the disk failed.
[[noreturn]] void refuse_path(const std::filesystem::path& path, const std::string& action, std::error_code error);

/// Throws InputError that names the path if no content can be read: it is missing, a folder, or a pipe or device, which
/// might never end.
void expect_regular_file(const std::filesystem::path& path);

/// Returns the content of a regular file. Throws InputError that names it if expect_regular_file does or it cannot be
/// read.
std::string read_bytes(const std::filesystem::path& path);

/// Writes a file, replaces one of that name, and creates missing folders. Throws as refuse_path does.
void write_bytes(const std::filesystem::path& path, std::string_view bytes);

/// Returns FNV-1a over 64 bits as 16 hexadecimal digits. It distinguishes contents, but detects no forgery.
std::string digest(std::string_view bytes);

}  // namespace ogc::compare

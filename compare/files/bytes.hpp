// Whole files in and out: meshes and scenes are small enough, and a parser over one string can name every line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace ogc::compare {

/// Throws the error that fits the reason `error` of a failure at `path`: InputError where another path or right would
/// do (no such folder, a file in its place, a loop of links, a name that is too long, no permission), ResourceError
/// where the disk does not take it. "PATH: can't ACTION (REASON): REMEDY".
[[noreturn]] void refuse_path(const std::filesystem::path& path, const std::string& action, std::error_code error);

/// Throws InputError that names the path where no content can be read: missing, a folder, a pipe or a device, which
/// might never end.
void expect_regular_file(const std::filesystem::path& path);

/// The content of a regular file. Throws InputError that names it: as above, or unreadable.
std::string read_bytes(const std::filesystem::path& path);

/// Writes a file, replacing what is there; creates missing folders. Throws as refuse_path does.
void write_bytes(const std::filesystem::path& path, std::string_view bytes);

/// FNV-1a over 64 bits; 16 hexadecimal digits. Tells one content from another, not a forgery.
std::string digest(std::string_view bytes);

}  // namespace ogc::compare

// Whole files in and out: meshes and scenes are small enough, and a parser over one string can name every line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ogc::compare {

/// The content of a file. Throws InputError that names it: missing, a folder, unreadable.
std::string read_bytes(const std::filesystem::path& path);

/// Writes a file, replacing what is there; creates missing folders. Throws ResourceError that names it where the disk does not take it.
void write_bytes(const std::filesystem::path& path, std::string_view bytes);

/// FNV-1a over 64 bits; 16 hexadecimal digits. Tells one content from another, not a forgery.
std::string digest(std::string_view bytes);

}  // namespace ogc::compare

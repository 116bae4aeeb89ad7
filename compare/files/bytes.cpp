// Closes written files explicitly and checks the result, because streams report a full disk only when they are flushed.
#include "compare/files/bytes.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <system_error>

#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {

namespace {

/// Returns a path as text; the middle of a long path is left out.
std::string shown_path(const std::filesystem::path& path) {
  constexpr std::size_t most_shown = 160, kept = 60;
  const std::string text = path.string();
  if (text.size() <= most_shown) return text;
  std::size_t tail = text.size() - kept;
  while (tail < text.size() && (static_cast<unsigned char>(text[tail]) & 0xc0) == 0x80)
    ++tail;  // does not cut inside a UTF-8 character
  return shown(text) + text.substr(tail);
}

/// Returns whether the user can solve the error by another path or other rights.
bool is_input(std::error_code error) {
  constexpr std::array reasons{std::errc::no_such_file_or_directory,
                               std::errc::not_a_directory,
                               std::errc::is_a_directory,
                               std::errc::filename_too_long,
                               std::errc::permission_denied,
                               std::errc::operation_not_permitted,
                               std::errc::read_only_file_system,
                               std::errc::file_exists,
                               std::errc::too_many_symbolic_link_levels,
                               std::errc::invalid_argument,
                               std::errc::no_such_device_or_address};
  return std::ranges::any_of(reasons, [&](std::errc reason) { return error == reason; });
}

std::string remedy(std::error_code error) {
  for (const auto reason :
       {std::errc::permission_denied, std::errc::operation_not_permitted, std::errc::read_only_file_system})
    if (error == reason) return ": choose a folder that you may write to, or check its permissions";
  if (error == std::errc::filename_too_long) return ": choose a shorter name";
  if (error == std::errc::too_many_symbolic_link_levels) return ": its links lead in a circle; name the file itself";
  return is_input(error) ? ": check the path" : ": free space there, or choose a folder on another disk";
}

std::error_code last_error() { return {errno, std::generic_category()}; }

}  // namespace

void refuse_path(const std::filesystem::path& path, const std::string& action, std::error_code error) {
  const std::string text = shown_path(path) + ": can't " + action + " (" + error.message() + ")" + remedy(error);
  if (is_input(error)) throw InputError(text);
  throw ResourceError(text);
}

void expect_regular_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw InputError(shown_path(path) + ": no such file; check the path");
  if (error) refuse_path(path, "read the file", error);
  if (std::filesystem::is_directory(status)) throw InputError(path.string() + ": is a folder; name a file in it");
  if (!std::filesystem::is_regular_file(status))
    throw InputError(
        path.string() +
        ": is a pipe or a device, and only regular files are read; save its content to a file and name that");
}

std::string read_bytes(const std::filesystem::path& path) {
  expect_regular_file(path);
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse_path(path, "read the file", last_error());
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw InputError(path.string() + ": can't be read; check its permissions");
  return bytes;
}

void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) refuse_path(path.parent_path(), "make the folder", error);
  errno = 0;
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  if (!stream) refuse_path(path, "write the file", last_error());
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw ResourceError(path.string() + ": can't be written; check free space and permissions");
}

std::string digest(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

}  // namespace ogc::compare

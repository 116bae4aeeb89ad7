// What goes to standard output, in one place: it is checked (a full disk behind a pipe is an error, not a shorter
// result), and everything else goes to standard error.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compare/problem/vector.hpp"

namespace ogc::experiments {

/// Keys keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// Writes to standard output, at once. Throws compare::ResourceError where it is not taken.
void print_result(const std::string& text);
/// The same for a JSON object, one line for each of its members. Numbers that are not finite become null.
void print_result(const Json& json);
/// One line on standard error.
void log_line(const std::string& text);

/// `value` with `digits` significant digits, "1.23e-05" where that is shorter.
std::string number(double value, int digits = 3);
/// "1 contact", "2 contacts".
std::string counted(std::size_t count, const std::string& noun);
/// Columns aligned, two spaces between them; the first `left_columns` to the left, the others to the right.
std::string table(const std::vector<std::vector<std::string>>& rows, std::size_t left_columns);

/// FNV-1a over 64 bits of the positions' bits, x y z in turn, low byte first; 16 hexadecimal digits. Equal if and
/// (almost) only if every bit is.
std::string state_hash(std::span<const compare::Vec3f> positions);

/// Now, UTC, for names of folders: "20250801-120000".
std::string utc_stamp();

}  // namespace ogc::experiments

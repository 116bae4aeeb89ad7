// Writes to standard output in one place and checks each write, because a full disk behind a pipe is an error, not a
// shorter result. Everything else goes to standard error.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compare/problem/vector.hpp"

namespace ogc::experiments {

/// JSON whose keys keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// Writes to standard output without delay. Throws compare::ResourceError if the write fails.
void print_result(const std::string& text);
/// Writes a JSON object in this way, one line for each member. Numbers that are not finite become null.
void print_result(const Json& json);
/// Writes one line to standard error.
void log_line(const std::string& text);

/// Returns `value` with `digits` significant digits, as "1.23e-05" where that is shorter.
std::string number(double value, int digits = 3);
/// Returns "1 contact" or "2 contacts".
std::string counted(std::size_t count, const std::string& noun);
/// Returns a table with aligned columns and two spaces between them. The first `left_columns` are aligned to the left,
/// the others to the right.
std::string table(const std::vector<std::vector<std::string>>& rows, std::size_t left_columns);

/// Returns FNV-1a over 64 bits of the positions' bits, in the order x y z, low byte first, as 16 hexadecimal digits.
/// Two hashes are equal if all bits are equal, and (almost) only then.
std::string state_hash(std::span<const compare::Vec3f> positions);

/// Returns the current time, UTC, for names of folders: "20250801-120000".
std::string utc_stamp();

}  // namespace ogc::experiments

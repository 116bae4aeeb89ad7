// Writes to standard output in one place and checks each write, so that a full disk behind a pipe is an error, not a
// shorter result. All other output goes to standard error.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compare/problem/vector.hpp"

namespace ogc::experiments {

/// JSON that keeps the order of its keys.
using Json = nlohmann::ordered_json;

/// Writes to standard output without delay. Throws compare::ResourceError if the write fails.
void print_result(const std::string& text);
/// Writes a JSON object with one line for each member. Numbers that are not finite become null.
void print_result(const Json& json);
/// Writes one line to standard error.
void log_line(const std::string& text);

/// Returns `value` with `digits` significant digits, as "1.23e-05" if that is shorter.
std::string number(double value, int digits = 3);
/// Returns "1 contact" or "2 contacts".
std::string counted(std::size_t count, const std::string& noun);
/// Returns a table with aligned columns, two spaces apart. The first `left_columns` are left-aligned, the others
/// right-aligned.
std::string table(const std::vector<std::vector<std::string>>& rows, std::size_t left_columns);

/// Returns the 64-bit FNV-1a hash of the positions' bits, in the order x y z, low byte first, as 16 hexadecimal digits.
/// Equal hashes mean, almost certainly, equal bits.
std::string state_hash(std::span<const compare::Vec3f> positions);

/// Returns the current UTC time for names of folders: "20250801-120000".
std::string utc_stamp();

}  // namespace ogc::experiments

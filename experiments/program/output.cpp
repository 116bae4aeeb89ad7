#include "experiments/program/output.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <sstream>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/problem/error.hpp"

namespace ogc::experiments {

namespace {

/// Returns the number of characters: all bytes of UTF-8 that do not continue a character.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

void print_result(const std::string& text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (std::fflush(stdout) != 0 || !written)
    throw compare::ResourceError(std::string("standard output does not take the result: ") + std::strerror(errno) +
                                 "; free some space or write elsewhere");
}

void print_result(const Json& json) {
  std::string text;
  for (const auto& [key, value] : json.items()) {
    const std::string compact = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    text += (text.empty() ? "{\n  " : ",\n  ") + Json(key).dump() + ": " + compact;
  }
  print_result(text + "\n}\n");
}

void log_line(const std::string& text) { std::fputs((text + "\n").c_str(), stderr); }

std::string number(double value, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string table(const std::vector<std::vector<std::string>>& rows, std::size_t left_columns) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t column = 0; column < row.size(); ++column) {
      if (widths.size() <= column) widths.push_back(0);
      widths[column] = std::max(widths[column], width(row[column]));
    }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column) {
      const std::string padding(widths[column] - width(row[column]), ' ');
      line += (column == 0 ? "" : "  ") + (column < left_columns ? row[column] + padding : padding + row[column]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string state_hash(std::span<const compare::Vec3f> positions) {
  static_assert(std::endian::native == std::endian::little, "the low byte comes first");
  return compare::digest({reinterpret_cast<const char*>(positions.data()), positions.size_bytes()});
}

std::string utc_stamp() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 16> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y%m%d-%H%M%S", &parts)};
}

}  // namespace ogc::experiments

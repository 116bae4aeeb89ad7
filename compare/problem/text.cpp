// The edit distance compares a few short names, so the code is simple rather than fast.
#include "compare/problem/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>
#include <utility>
#include <vector>

namespace ogc::compare {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](char c) { return lower(c); });
  return result;
}

/// Returns the number of typing errors between both words (Damerau's distance; each pair of letters is swapped at most
/// once). Only rows i − 2, i − 1 and i of the usual table are kept.
std::size_t typing_errors(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, above, row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    before = std::exchange(above, row);
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({above[j] + (a[i] == b[j] ? 0 : 1), above[j + 1] + 1, row[j] + 1});
      if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j]) row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
    }
  }
  return row.back();
}

/// Returns whether the shorter text abbreviates the name, as "stvk" does "st_venant_kirchhoff".
bool abbreviates(std::string_view shorter, std::string_view name) {
  if (shorter.size() < 3 || name.empty() || shorter.front() != name.front()) return false;
  for (const char c : name)
    if (!shorter.empty() && shorter.front() == c) shorter.remove_prefix(1);
  return shorter.empty();
}

}  // namespace

std::string_view near_name(std::string_view name, std::span<const std::string_view> known) {
  if (name.empty()) return {};
  const std::string wanted = lower(name);
  std::string_view best;
  std::size_t fewest = std::max<std::size_t>(1, wanted.size() / 3) + 1;
  for (const std::string_view candidate : known) {
    const std::string other = lower(candidate);
    const std::size_t errors = other.starts_with(wanted) ? 0 : typing_errors(wanted, other);
    if (errors >= fewest) continue;
    fewest = errors;
    best = candidate;
  }
  if (!best.empty()) return best;
  const auto meant = std::ranges::find_if(
      known, [&](std::string_view candidate) { return abbreviates(wanted, lower(candidate)); });
  return meant == known.end() ? std::string_view{} : *meant;
}

std::string unknown_name(std::string_view what, std::string_view name, std::span<const std::string_view> known) {
  constexpr std::size_t most_listed = 64;
  std::string text = "unknown " + std::string(what) + " '" + shown(name) + "'";
  if (known.empty()) return text;
  const std::string_view near = near_name(name, known);
  text += near.empty() ? "; there are: " : "; did you mean '" + std::string(near) + "'? There are: ";
  text += joined(known.first(std::min(known.size(), most_listed)));
  return known.size() > most_listed ? text + " and " + std::to_string(known.size() - most_listed) + " more" : text;
}

std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

std::string shown(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  std::size_t end = most;
  // does not cut inside a UTF-8 character
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return std::string(text.substr(0, end)) + "…";
}

std::string shortest(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

double as_typed(double value) {
  const auto single = static_cast<float>(value);
  if (static_cast<double>(single) != value) return value;
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), single).ptr;
  double typed = value;
  std::from_chars(buffer.data(), end, typed);
  return typed;
}

}  // namespace ogc::compare

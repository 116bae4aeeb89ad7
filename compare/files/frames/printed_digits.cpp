#include "compare/files/frames/printed_digits.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "compare/files/bytes.hpp"
#include "compare/files/numbers.hpp"
#include "compare/files/text_lines.hpp"

namespace ogc::compare {
namespace {

/// Numbers with 16 digits do not count as rounded, since 16 digits distinguish nearly all doubles.
constexpr std::size_t all_digits = 16;
/// Numbers with fewer digits than these do not count as rounded: people type such numbers, or they are exact. A rounded
/// number mostly has all digits of its format.
constexpr std::size_t least_significant = 6, least_decimals = 4;
/// A format is accepted if these shares of all numbers have all of its decimals, or all of its significant digits. In a
/// rounded file all numbers have all decimals. Only nine of ten have all significant digits, since zeros at the end are
/// left out. Two coordinates of three may be exact and shorter, so the second share is small.
constexpr double share_of_decimals = 0.9, share_of_significant = 0.25;

std::vector<std::string_view> words_of(std::string_view line, std::size_t most) {
  std::vector<std::string_view> words;
  for (std::string_view word = next_word(line); !word.empty() && words.size() < most; word = next_word(line))
    words.push_back(word);
  return words;
}

std::string_view next_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  text.remove_prefix(std::min(line.size() + (text.substr(line.size()).starts_with("\r\n") ? 2 : 1), text.size()));
  return line;
}

/// Finds the number of digits to which coordinates are rounded.
class Digits {
 public:
  void look_at(std::string_view word) {
    double value = 0;
    if (!parse_number(word, value) || !std::isfinite(value)) return;
    largest_ = std::max(largest_, std::abs(value));
    const std::size_t exponent = word.find_first_of("eE"), point = word.find('.');
    const std::string_view mantissa = word.substr(0, exponent);
    ++numbers_;
    if (point != std::string_view::npos && exponent == std::string_view::npos)
      ++decimals_[std::min(mantissa.size() - point - 1, all_digits)];
    std::size_t significant = 0;
    for (const char c : mantissa)
      if (c >= (significant == 0 ? '1' : '0') && c <= '9') ++significant;
    if (significant > 0) ++significant_[std::min(significant, all_digits)];
  }

  std::optional<PrintedDigits> conclude() const {
    if (largest_ == 0) return std::nullopt;
    const auto has = [](std::size_t count) { return count > 0; };
    const auto most = [&](const Histogram& all) {
      return static_cast<std::size_t>(std::find_if(all.rbegin(), all.rend(), has).base() - all.begin()) - 1;
    };
    const auto share = [](std::size_t some, std::size_t all) {
      return static_cast<double>(some) / static_cast<double>(all);
    };
    const auto common = static_cast<std::size_t>(std::ranges::max_element(decimals_) - decimals_.begin());
    const std::size_t significant = most(significant_);
    if (significant == all_digits) return std::nullopt;
    if (common >= least_decimals && share(decimals_[common], numbers_) >= share_of_decimals)
      return of_unit(common, true, std::pow(10.0, -static_cast<double>(common)));
    std::size_t nonzero = 0;
    for (const std::size_t count : significant_) nonzero += count;
    const std::size_t full = significant_[significant] + significant_[significant - 1];
    if (significant < least_significant || share(full, nonzero) < share_of_significant) return std::nullopt;
    return of_unit(significant, false,
                   std::pow(10.0, std::floor(std::log10(largest_)) + 1 - static_cast<double>(significant)));
  }

 private:
  using Histogram = std::array<std::size_t, all_digits + 1>;
  static PrintedDigits of_unit(std::size_t digits, bool are_decimals, double unit) {
    return {static_cast<int>(digits), are_decimals, unit};
  }

  Histogram decimals_{}, significant_{};  // number of coordinates for each number of digits
  std::size_t numbers_ = 0;
  double largest_ = 0;
};

void look_at_all(const std::vector<std::string_view>& words, std::size_t first, std::size_t end, Digits& digits) {
  for (std::size_t k = first; k < std::min(end, words.size()); ++k) digits.look_at(words[k]);
}

/// Reads the numbers of lines that begin with `keyword`: `v` in OBJ, `vertex` in STL.
void after_keyword(std::string_view text, std::string_view keyword, Digits& digits) {
  while (!text.empty()) {
    const auto words = words_of(next_line(text), 4);
    if (!words.empty() && words[0] == keyword) look_at_all(words, 1, 4, digits);
  }
}

struct PlyVertices {
  std::size_t before = 0, count = 0;  ///< number of lines before the vertices, and number of vertices
  std::vector<std::size_t> places{};  ///< which words of a line are x, y and z, from 0
};

/// Reads the header of a PLY file and moves `text` to its end. Returns nothing if vertices are not lines of scalars.
std::optional<PlyVertices> ply_header(std::string_view& text) {
  PlyVertices found;
  bool is_ascii = false, is_vertex = false;
  std::size_t property = 0;
  while (!text.empty()) {
    const auto words = words_of(next_line(text), 5);
    if (words.size() == 1 && words[0] == "end_header") break;
    if (words.size() < 3) continue;
    if (words[0] == "format") is_ascii = words[1] == "ascii";
    if (words[0] == "element") {
      std::size_t count = 0;
      parse_number(words[2], count);
      is_vertex = words[1] == "vertex";
      if (is_vertex)
        found.count = count;
      else if (found.count == 0)
        found.before += count;
    }
    if (words[0] != "property" || !is_vertex) continue;
    if (words[1] == "list") return std::nullopt;
    if (words[2] == "x" || words[2] == "y" || words[2] == "z") found.places.push_back(property);
    ++property;
  }
  if (!is_ascii || found.places.empty()) return std::nullopt;
  return found;
}

void of_ply(std::string_view text, Digits& digits) {
  std::optional<PlyVertices> vertices = ply_header(text);
  while (vertices && !text.empty() && vertices->count > 0) {
    const auto words = words_of(next_line(text), vertices->places.back() + 1);
    if (words.empty()) continue;
    if (vertices->before > 0) {
      --vertices->before;
      continue;
    }
    --vertices->count;
    for (const std::size_t place : vertices->places)
      if (place < words.size()) digits.look_at(words[place]);
  }
}

void of_off(std::string_view text, Digits& digits) {
  std::size_t vertices = 0;
  bool counted = false;
  while (!text.empty() && (!counted || vertices > 0)) {
    std::string_view line = next_line(text);
    auto words = words_of(line.substr(0, line.find('#')), 4);
    if (!words.empty() && !counted && words[0].ends_with("OFF")) words.erase(words.begin());
    if (words.empty()) continue;
    if (counted) {
      look_at_all(words, 0, 3, digits);
      --vertices;
    } else if (!parse_number(words[0], vertices)) {
      return;
    }
    counted = true;
  }
}

/// Reads the array of points of a VTK XML file, if it is text.
void of_vtk_xml(std::string_view text, Digits& digits) {
  for (std::size_t at = text.find("<Points"); at != std::string_view::npos; at = text.find("<Points")) {
    text.remove_prefix(at);
    const std::size_t array = text.find("<DataArray"), end = text.find('>', array);
    if (array == std::string_view::npos || end == std::string_view::npos) return;
    const bool is_text = text.substr(array, end - array).find("\"ascii\"") != std::string_view::npos;
    text.remove_prefix(end + 1);
    if (!is_text) continue;
    std::string_view numbers = text.substr(0, text.find('<'));
    for (std::string_view word = next_word(numbers); !word.empty(); word = next_word(numbers)) digits.look_at(word);
  }
}

/// Reads nodes of a Gmsh file. In version 2 their lines begin with a number, in version 4 they are lines of three
/// numbers.
void of_msh(std::string_view text, Digits& digits) {
  const std::size_t format = text.find("$MeshFormat"), nodes = text.find("$Nodes"), end = text.find("$EndNodes");
  if (format == std::string_view::npos || nodes == std::string_view::npos || end == std::string_view::npos) return;
  std::string_view head = text.substr(format + 11);
  const bool is_old = next_word(head).starts_with('2');
  if (next_word(head) != "0") return;
  text = text.substr(nodes, end - nodes);
  while (!text.empty()) {
    const auto words = words_of(next_line(text), 5);
    if (words.size() == (is_old ? 4 : 3)) look_at_all(words, is_old ? 1 : 0, 4, digits);
  }
}

/// Reads a count, the word after `keyword`. Then reads that many vertices, each of `each` words; the first three words
/// are the coordinates.
void of_counted(std::string_view text, std::string_view keyword, std::size_t each, Digits& digits) {
  std::size_t count = 0;
  for (std::string_view word = next_word(text); !word.empty() && word != keyword;) word = next_word(text);
  if (!parse_number(next_word(text), count)) return;
  if (keyword == "POINTS") next_word(text);  // type of the points
  for (std::size_t i = 0; i < count && !text.empty(); ++i)
    for (std::size_t k = 0; k < each; ++k) {
      const std::string_view word = next_word(text);
      if (k < 3) digits.look_at(word);
    }
}

/// Reads the points of an older VTK file, if its third line is "ASCII".
void of_vtk(std::string_view text, Digits& digits) {
  std::string_view head = text;
  for (int line = 0; line < 2; ++line) next_line(head);
  if (next_word(head) == "ASCII") of_counted(head, "POINTS", 3, digits);
}

}  // namespace

std::optional<PrintedDigits> printed_digits(const std::filesystem::path& file) {
  std::string kind = file.extension().string();
  std::ranges::transform(kind, kind.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::string_view, 9> kinds{".obj", ".stl", ".ply", ".off", ".vtp",
                                                  ".vtu", ".vtk", ".msh", ".mesh"};
  if (std::ranges::find(kinds, kind) == kinds.end()) return std::nullopt;
  const std::string text = read_bytes(file);
  Digits digits;
  if (kind == ".obj") after_keyword(text, "v", digits);
  if (kind == ".stl" && text.starts_with("solid")) after_keyword(text, "vertex", digits);
  if (kind == ".ply") of_ply(text, digits);
  if (kind == ".off") of_off(text, digits);
  if (kind == ".vtp" || kind == ".vtu") of_vtk_xml(text, digits);
  if (kind == ".vtk") of_vtk(text, digits);
  if (kind == ".msh") of_msh(text, digits);
  if (kind == ".mesh") of_counted(text, "Vertices", 4, digits);
  return digits.conclude();
}

}  // namespace ogc::compare

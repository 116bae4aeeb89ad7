// A file is a sequence of lines of words. Some lines are followed by a block of numbers, which are words or big-endian
// bytes.
#include "compare/files/meshes/vtk_legacy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "compare/files/byte_cursor.hpp"
#include "compare/files/meshes/vtk_cells.hpp"
#include "compare/files/numbers.hpp"
#include "compare/files/text_lines.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

constexpr std::array<std::pair<std::string_view, ScalarType>, 13> types{{{"char", ScalarType::int8},
                                                                         {"signed_char", ScalarType::int8},
                                                                         {"unsigned_char", ScalarType::uint8},
                                                                         {"short", ScalarType::int16},
                                                                         {"unsigned_short", ScalarType::uint16},
                                                                         {"int", ScalarType::int32},
                                                                         {"vtkIdType", ScalarType::int32},
                                                                         {"unsigned_int", ScalarType::uint32},
                                                                         {"long", ScalarType::int64},
                                                                         {"vtktypeint64", ScalarType::int64},
                                                                         {"unsigned_long", ScalarType::uint64},
                                                                         {"float", ScalarType::float32},
                                                                         {"double", ScalarType::float64}}};

/// Reads lines and blocks of numbers, in text or binary.
class VtkBlocks {
 public:
  /// Reads the header: version, title, and ASCII or BINARY.
  VtkBlocks(std::string_view bytes, const std::string& name) : lines_(bytes, name) {
    if (!lines_.next() || !lines_.rest().starts_with("# vtk DataFile Version "))
      throw InputError(name + ": does not begin with '# vtk DataFile Version'; it is no VTK file of the older format");
    for (int k = 0; k < 4; ++k) lines_.word();
    const std::string_view version = lines_.word();
    is_new_ = !version.empty() && version.front() >= '5' && version.front() <= '9';
    if (!lines_.next() || !lines_.next()) lines_.fail_truncated("ASCII or BINARY");
    const std::string_view kind = lines_.word();
    if (kind == "BINARY") {
      cursor_.emplace(bytes, name, std::endian::big, bytes.size() - lines_.bytes_left());
    } else if (kind != "ASCII") {
      lines_.fail("'" + shown(kind) + "' stands where ASCII or BINARY should");
    }
  }

  bool is_new() const { return is_new_; }  ///< version 5 or later, with offsets of cells

  /// Goes to the next line, even a blank one; returns false after the last line.
  bool next_line() {
    if (cursor_ ? cursor_->left() == 0 : !lines_.next()) return false;
    if (cursor_) line_ = cursor_->line();
    return true;
  }

  bool next_filled_line() {
    while (next_line())
      if (!line_is_blank()) return true;
    return false;
  }

  bool line_is_blank() const { return is_blank(cursor_ ? line_ : lines_.rest()); }
  std::string_view word() { return cursor_ ? next_word(line_) : lines_.word(); }

  std::size_t count(const std::string& what) {
    const std::string_view found = word();
    std::int64_t value = 0;
    if (!parse_number(found, value) || value < 0) fail("'" + shown(found) + "' is no " + what);
    return static_cast<std::size_t>(value);
  }

  ScalarType type() {
    const std::string_view found = word();
    const auto known = std::ranges::find(types, found, &std::pair<std::string_view, ScalarType>::first);
    if (known == types.end()) fail("'" + shown(found) + "' is no type of numbers that is read");
    return known->second;
  }

  /// Returns the block after the line, `rows` of `columns` numbers. Checks that the file is long enough before memory
  /// is allocated.
  std::vector<double> numbers(std::size_t rows, std::size_t columns, ScalarType type, const std::string& what) {
    const std::size_t least = cursor_ ? size_of(type) : 2;  // a digit and a blank
    const std::size_t left = (cursor_ ? cursor_->left() : lines_.bytes_left() + 1) / least;
    if (columns != 0 && rows > left / columns)
      fail(std::to_string(rows) + " " + what + " can't stand in the " +
           std::to_string(cursor_ ? cursor_->left() : lines_.bytes_left()) +
           " bytes that follow: the file is truncated or damaged");
    std::vector<double> values(rows * columns);
    for (double& value : values) value = cursor_ ? binary(type, what) : text(what);
    if (std::string_view rest = lines_.rest(); !cursor_ && !is_blank(rest))
      lines_.fail("'" + shown(rest) + "' stands behind the last of the " + what + "; mend their count");
    return values;
  }

  [[noreturn]] void fail(const std::string& what) const {
    if (cursor_) cursor_->fail(what);
    lines_.fail(what);
  }

 private:
  static bool is_blank(std::string_view text) { return next_word(text).empty(); }

  double binary(ScalarType type, const std::string& what) {
    return scalar_at(cursor_->take(size_of(type), what).data(), type, std::endian::big);
  }

  double text(const std::string& what) {
    const std::string_view found = lines_.far_word();
    if (found.empty()) lines_.fail_truncated("another of the " + what);
    double value = 0;
    if (!parse_number(found, value)) lines_.fail(what + ": " + no_coordinate(found));
    return value;
  }

  TextLines lines_;
  std::optional<ByteCursor> cursor_;  ///< after the header of a binary file
  bool is_new_ = false;
  std::string_view line_;  ///< in a binary file: rest of the line after the words taken so far
};

class VtkLegacyParser {
 public:
  VtkLegacyParser(std::string_view bytes, const std::string& name) : name_(name), blocks_(bytes, name) {
    mesh_.source.file = name;
  }

  PolygonMesh parse() {
    while (blocks_.next_filled_line()) {
      const std::string keyword(blocks_.word());
      if (keyword == "POINT_DATA" || keyword == "CELL_DATA") break;
      section(keyword);
    }
    if (!is_grid_ && !is_surface_) throw InputError(name_ + ": has no DATASET: the file is truncated or no VTK file");
    if (mesh_.positions.empty()) throw InputError(name_ + ": has no points: the section POINTS is missing or empty");
    add_cells();
    return std::move(mesh_);
  }

 private:
  void section(const std::string& keyword) {
    if (keyword == "DATASET") {
      const std::string kind(blocks_.word());
      is_grid_ = kind == "UNSTRUCTURED_GRID";
      is_surface_ = kind == "POLYDATA";
      if (!is_grid_ && !is_surface_)
        blocks_.fail("a data set of kind '" + shown(kind) + "' is not read, only POLYDATA and UNSTRUCTURED_GRID");
    } else if (keyword == "POINTS") {
      const std::size_t points = blocks_.count("number of points");
      const ScalarType type = blocks_.type();
      add_vtk_points(blocks_.numbers(points, 3, type, "points"), name_, mesh_);
    } else if (keyword == "CELL_TYPES") {
      kinds_ = blocks_.numbers(blocks_.count("number of cells"), 1, ScalarType::int32, "types of cells");
    } else if (const auto list = std::ranges::find(lists_, keyword, &List::keyword); list != lists_.end()) {
      blocks_.is_new() ? new_cells(*list) : old_cells(*list);
    } else if (keyword == "FIELD") {
      field();
    } else if (keyword == "METADATA") {
      while (blocks_.next_line() && !blocks_.line_is_blank()) {}
    } else {
      blocks_.fail("'" + shown(keyword) + "' is no section that is known here");
    }
  }

  /// A section of cells: one of POLYDATA's lists, or the only list of a grid. A grid has the kinds of its cells in
  /// another section.
  struct List {
    std::string_view keyword;
    int kind;
    VtkCellLists cells{};
  };

  /// Reads cells of versions before 5: for each cell its number of corners, then the corners.
  void old_cells(List& list) {
    const std::size_t cells = blocks_.count("number of cells"), size = blocks_.count("number of numbers");
    const std::vector<double> numbers = blocks_.numbers(size, 1, ScalarType::int32, "numbers of cells");
    std::size_t at = 0;
    for (std::size_t i = 0; i < cells; ++i) {
      const double corners = at < size ? numbers[at] : -1;
      if (!(corners >= 0 && corners < static_cast<double>(size - at) && corners == std::floor(corners)))
        blocks_.fail("cell " + std::to_string(i) + " of " + std::to_string(cells) + " has " + shortest(corners) +
                     " corners, with " + std::to_string(size - std::min(at, size)) + " numbers left: the counts of " +
                     std::string(list.keyword) + " are wrong");
      const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(at + 1);
      list.cells.corners.insert(list.cells.corners.end(), first, first + static_cast<std::ptrdiff_t>(corners));
      list.cells.ends.push_back(static_cast<double>(list.cells.corners.size()));
      at += 1 + static_cast<std::size_t>(corners);
    }
    if (at != size)
      blocks_.fail(std::to_string(size - at) + " numbers follow the last of the " + std::to_string(cells) +
                   " cells: the counts of " + std::string(list.keyword) + " are wrong");
  }

  /// Reads cells of version 5: first the offsets, then the corners. The first offset is 0, and there is one offset more
  /// than cells.
  void new_cells(List& list) {
    const std::size_t offsets = blocks_.count("number of offsets"), corners = blocks_.count("number of corners");
    list.cells.ends = array("OFFSETS", offsets);
    list.cells.corners = array("CONNECTIVITY", corners);
    if (list.cells.ends.empty()) return;
    if (list.cells.ends.front() != 0) blocks_.fail("the first offset of " + std::string(list.keyword) + " is not 0");
    list.cells.ends.erase(list.cells.ends.begin());
  }

  std::vector<double> array(const char* keyword, std::size_t count) {
    if (!blocks_.next_filled_line() || blocks_.word() != keyword)
      blocks_.fail(std::string("'") + keyword + "' should stand here: the file is truncated or damaged");
    const ScalarType type = blocks_.type();
    return blocks_.numbers(count, 1, type, keyword);
  }

  /// Skips a FIELD section: arrays that describe the whole data set.
  void field() {
    blocks_.word();
    const std::size_t arrays = blocks_.count("number of arrays");
    for (std::size_t i = 0; i < arrays; ++i) {
      if (!blocks_.next_filled_line()) blocks_.fail("an array of FIELD is missing: the file is truncated");
      blocks_.word();
      const std::size_t columns = blocks_.count("number of components"), rows = blocks_.count("number of tuples");
      const ScalarType type = blocks_.type();
      blocks_.numbers(rows, columns, type, "numbers of a field");
    }
  }

  void add_cells() {
    VtkCells cells(mesh_, name_);
    for (List& list : lists_) {
      list.cells.where = name_ + ": " + std::string(list.keyword);
      list.cells.count = mesh_.positions.size();
      if (list.kind == 0 && kinds_.size() != list.cells.ends.size())
        throw InputError(name_ + ": has " + std::to_string(list.cells.ends.size()) + " cells in CELLS and " +
                         std::to_string(kinds_.size()) + " in CELL_TYPES: the file is truncated or damaged");
      each_vtk_cell(list.cells, [&](std::size_t i, std::span<const Index> c) {
        cells.add(list.kind == 0 ? vtk_kind(kinds_[i]) : list.kind, c);
      });
    }
    cells.finish();
  }

  const std::string& name_;
  VtkBlocks blocks_;
  bool is_grid_ = false, is_surface_ = false;
  std::array<List, 5> lists_{{{"VERTICES", 2},
                              {"LINES", vtk_poly_line},
                              {"POLYGONS", vtk_polygon},
                              {"TRIANGLE_STRIPS", vtk_strip},
                              {"CELLS", 0}}};
  std::vector<double> kinds_;
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh parse_vtk_legacy(std::string_view bytes, const std::string& name) {
  return VtkLegacyParser(bytes, name).parse();
}

}  // namespace ogc::compare

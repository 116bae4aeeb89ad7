// A separate reader is needed because stage.obj contains statements that other meshes do not have (stitch, seam), and
// because the groups of its faces matter.
#include "experiments/scenes/dress_data.hpp"

#include <algorithm>
#include <cmath>

#include "compare/files/bytes.hpp"
#include "compare/files/numbers.hpp"
#include "compare/problem/error.hpp"

namespace ogc::experiments {
namespace {

using compare::Index;
using compare::InputError;
using compare::Triangle;
using compare::Vec3;

constexpr const char* remedy = "give the folder with Codimensional IPC's files as they were published";

struct Obj {
  std::vector<Vec3> positions;
  std::vector<std::array<double, 2>> pattern;
  std::vector<Triangle> triangles, pattern_triangles;
  std::vector<Index> panel;  ///< by triangle
  Index panels = 0;
  std::vector<Stitch> stitches;
};

class ObjReader {
 public:
  explicit ObjReader(const std::filesystem::path& file) : name_(file.string()), text_(compare::read_bytes(file)) {}

  Obj read() {
    for (std::string_view rest = text_; !rest.empty();) {
      ++line_;
      words_ = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(words_.size() + 1, rest.size()));
      statement(word());
    }
    return std::move(obj_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(name_ + ": line " + std::to_string(line_) + ": " + what + "; " + remedy);
  }

  std::string_view word() {
    constexpr std::string_view blanks = " \t\r";
    words_.remove_prefix(std::min(words_.find_first_not_of(blanks), words_.size()));
    const std::string_view found = words_.substr(0, words_.find_first_of(blanks));
    words_.remove_prefix(found.size());
    return found;
  }

  template <class Number>
  Number parsed(std::string_view text) const {
    Number number{};
    if (!compare::parse_number(text, number)) fail("'" + std::string(text) + "' is no number of the right kind");
    return number;
  }
  double coordinate() { return parsed<double>(word()); }
  Index vertex() { return parsed<Index>(word()); }

  void statement(std::string_view keyword) {
    if (keyword == "v") {
      const double x = coordinate(), y = coordinate();
      obj_.positions.push_back({x, y, coordinate()});
    } else if (keyword == "vt") {
      const double u = coordinate();
      obj_.pattern.push_back({u, coordinate()});
    } else if (keyword == "f") {
      face();
    } else if (keyword == "g") {
      ++obj_.panels;
    } else if (keyword == "stitch") {
      const Index first = vertex(), second = vertex(), third = vertex();
      obj_.stitches.push_back({first, second, third, coordinate()});
    }
  }

  void face() {
    Triangle corners{}, pattern{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string_view text = word(), first = text.substr(0, text.find('/'));
      const std::string_view after = text.substr(std::min(first.size() + 1, text.size()));
      corners[k] = parsed<Index>(first) - 1;
      pattern[k] = after.empty() ? corners[k] : parsed<Index>(after.substr(0, after.find('/'))) - 1;
    }
    obj_.triangles.push_back(corners);
    obj_.pattern_triangles.push_back(pattern);
    obj_.panel.push_back(obj_.panels - 1);
  }

  std::string name_, text_;
  std::string_view words_;
  std::size_t line_ = 0;
  Obj obj_;
};

/// Returns the first of the possible paths that exists. The error names the most usual path.
std::filesystem::path found(const std::filesystem::path& folder, const std::string& subfolder,
                            const std::string& name) {
  for (const std::filesystem::path& place : {folder / subfolder / name, folder / name}) {
    if (std::filesystem::exists(place)) return place;
  }
  throw InputError((folder / subfolder / name).string() + ": does not exist, nor does " + (folder / name).string() +
                   "; " + remedy);
}

void check_count(const std::filesystem::path& file, const char* what, std::size_t count, std::size_t wanted) {
  if (count != wanted)
    throw InputError(file.string() + ": has " + std::to_string(count) + " " + what + " instead of " +
                     std::to_string(wanted) + "; " + remedy);
}

void check_corners(const std::filesystem::path& file, const std::vector<Triangle>& triangles, std::size_t vertices) {
  for (const Triangle& triangle : triangles) {
    for (const Index v : triangle) {
      if (v < 0 || static_cast<std::size_t>(v) >= vertices)
        throw InputError(file.string() + ": a face names vertex " + std::to_string(v + 1) + " of " +
                         std::to_string(vertices) + "; " + remedy);
    }
  }
}

void check_stage(const std::filesystem::path& file, const Obj& stage, const DressCounts& counts) {
  check_count(file, "vertices", stage.positions.size(), counts.vertices);
  check_count(file, "points of the pattern (vt)", stage.pattern.size(), counts.vertices);
  check_count(file, "faces", stage.triangles.size(), counts.triangles);
  check_count(file, "panels (g)", static_cast<std::size_t>(stage.panels), counts.panels);
  check_count(file, "stitches", stage.stitches.size(), counts.stitches);
  check_corners(file, stage.triangles, counts.vertices);
  if (stage.triangles != stage.pattern_triangles)
    throw InputError(file.string() + ": vertices and points of the pattern are numbered differently; " + remedy);
  if (std::ranges::count(stage.panel, -1) > 0)
    throw InputError(file.string() + ": has faces before its first panel (g); " + remedy);
  for (const Stitch& s : stage.stitches) {
    const std::string text = "stitch " + std::to_string(s.first) + " " + std::to_string(s.second) + " " +
                             std::to_string(s.third);
    for (const Index v : {s.first, s.second, s.third}) {
      if (v < 0 || static_cast<std::size_t>(v) >= counts.vertices)
        throw InputError(file.string() + ": " + text +
                         " names a vertex that does not exist; they are numbered from 0 to " +
                         std::to_string(counts.vertices - 1) + "; " + remedy);
    }
    if (s.first == s.second || s.first == s.third || s.second == s.third || !(s.ratio >= 0 && s.ratio <= 1))
      throw InputError(file.string() + ": " + text + " does not join a vertex to a point between two others; " +
                       remedy);
  }
}

void take_start(DressData& data, const std::filesystem::path& file, const Obj& stage, const DressCounts& counts) {
  const Obj drape = ObjReader(file).read();
  check_count(file, "vertices", drape.positions.size(), counts.vertices + counts.body_vertices);
  check_count(file, "faces", drape.triangles.size(), counts.triangles + counts.body_triangles);
  check_corners(file, drape.triangles, drape.positions.size());
  const auto vertices = static_cast<std::ptrdiff_t>(counts.vertices),
             faces = static_cast<std::ptrdiff_t>(counts.triangles);
  if (!std::equal(stage.triangles.begin(), stage.triangles.end(), drape.triangles.begin()))
    throw InputError(file.string() + ": does not begin with the faces of stage.obj; " + remedy);
  data.garment = {{drape.positions.begin(), drape.positions.begin() + vertices}, stage.triangles, {}};
  data.body.positions.assign(drape.positions.begin() + vertices, drape.positions.end());
  for (auto face = drape.triangles.begin() + faces; face != drape.triangles.end(); ++face) {
    const auto first = static_cast<Index>(counts.vertices);
    const auto& [a, b, c] = *face;
    if (std::min({a, b, c}) < first)
      throw InputError(file.string() + ": a face of the body has a vertex of the garment; " + remedy);
    data.body.triangles.push_back({a - first, b - first, c - first});
  }
}

/// Returns the translation from `from` to `to`. Throws if they differ by more than a translation and the rounding of
/// the files.
Vec3 translation(const std::vector<Vec3>& from, const std::vector<Vec3>& to, const std::filesystem::path& file) {
  constexpr double printed = 2e-6;  // [m]: rounding to seven digits of lengths below 2 m, in two files
  Vec3 mean;
  const double share = 1.0 / static_cast<double>(from.size());
  for (std::size_t v = 0; v < from.size(); ++v)
    mean = {mean.x + share * (to[v].x - from[v].x), mean.y + share * (to[v].y - from[v].y),
            mean.z + share * (to[v].z - from[v].z)};
  for (std::size_t v = 0; v < from.size(); ++v) {
    const double off = std::max({std::abs(to[v].x - from[v].x - mean.x), std::abs(to[v].y - from[v].y - mean.y),
                                 std::abs(to[v].z - from[v].z - mean.z)});
    if (!(off <= printed))
      throw InputError(file.string() + ": vertex " + std::to_string(v + 1) +
                       " is not where the body of drape.obj has it, moved like all others; " + remedy);
  }
  return mean;
}

}  // namespace

DressData read_dress_data(const std::filesystem::path& folder, const DressCounts& counts) {
  const std::filesystem::path file = found(folder, "dress_knife", "stage.obj");
  Obj stage = ObjReader(file).read();
  check_stage(file, stage, counts);
  DressData data;
  const bool beside = std::filesystem::exists(folder / "dress_knife" / "drape.obj");
  take_start(data, found(folder, beside ? "dress_knife" : "", "drape.obj"), stage, counts);
  data.pattern = std::move(stage.pattern);
  data.panel_of_triangle = std::move(stage.panel);
  data.stitches = std::move(stage.stitches);
  Vec3 shift;
  for (std::size_t k = 0; k < counts.frames; ++k) {
    const std::filesystem::path shell = found(folder, "Rumba_Dancing", "shell" + std::to_string(k) + ".obj");
    std::vector<Vec3> positions = ObjReader(shell).read().positions;
    check_count(shell, "vertices", positions.size(), counts.body_vertices);
    if (k == 0) shift = translation(data.body.positions, positions, shell);
    for (Vec3& v : positions) v = {v.x - shift.x, v.y - shift.y, v.z - shift.z};
    data.motion.push_back(std::move(positions));
  }
  return data;
}

}  // namespace ogc::experiments

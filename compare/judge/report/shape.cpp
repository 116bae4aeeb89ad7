#include "compare/judge/report/shape.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/report/svg.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/validate_mesh.hpp"

namespace ogc::compare {

namespace {

constexpr double picture_size = 480, margin = 24;
constexpr std::size_t most_labels = 24;

std::string numbered(const char* kind, std::span<const Index> indices) {
  std::string line = kind;
  for (const Index i : indices) line += " " + std::to_string(i + 1);
  return line + "\n";
}

std::size_t slot(Index i) { return static_cast<std::size_t>(i); }

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// Turns a shape into a mesh that validate accepts. Vertex v of the mesh is the point with index `points[v]` of the
/// shape; −1 means that the shape has no such point.
class LegalMesh {
 public:
  explicit LegalMesh(const Shape& shape) : positions_(to_double(shape.points)) {
    for (const Triangle& t : shape.triangles) add(t);
    for (const Edge& e : shape.lines) add(e);
    add_lonely_points();
    std::erase_if(lines_, [&](const Edge& line) { return sides_.contains(line); });
    renumber();
  }

  Mesh mesh;
  std::vector<Index> points;

 private:
  static Edge ordered(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

  bool is_legal(const Triangle& t) const {
    return validate({{positions_[slot(t[0])], positions_[slot(t[1])], positions_[slot(t[2])]}, {{0, 1, 2}}, {}})
        .empty();
  }
  bool is_legal(const Edge& e) const {
    return validate({{positions_[slot(e[0])], positions_[slot(e[1])]}, {}, {{0, 1}}}).empty();
  }

  void add(const Triangle& t) {
    Triangle sorted = t;
    std::sort(sorted.begin(), sorted.end());
    if (!seen_.insert(sorted).second) return;
    if (is_legal(t)) {
      triangles_.push_back(t);
      for (std::size_t k = 0; k < 3; ++k) sides_.insert(ordered(t[k], t[(k + 1) % 3]));
      return;
    }
    const auto length = [&](std::size_t k) {
      return distance(positions_[slot(t[k])], positions_[slot(t[(k + 1) % 3])]);
    };
    const std::size_t longest = length(0) >= length(1) ? (length(0) >= length(2) ? 0 : 2)
                                                       : (length(1) >= length(2) ? 1 : 2);
    add(Edge{t[longest], t[(longest + 1) % 3]});
  }

  void add(const Edge& e) {
    if (is_legal(e)) lines_.insert(ordered(e[0], e[1]));
  }

  std::vector<bool> held() const {
    std::vector<bool> held(positions_.size());
    for (const Triangle& t : triangles_)
      for (const Index v : t) held[slot(v)] = true;
    for (const Edge& e : lines_)
      for (const Index v : e) held[slot(v)] = true;
    return held;
  }

  /// Returns a point beyond v, at v + (v − c)/2 for the centre c of the first `count` points without v. If v is at c,
  /// the direction is arbitrary.
  Vec3 away_from_others(std::size_t v, std::size_t count) const {
    Vec3 centre{};
    double spread = 0;
    for (std::size_t w = 0; w < count; ++w) {
      if (w == v) continue;
      const double share = 1.0 / static_cast<double>(count - 1);
      centre = {centre.x + share * positions_[w].x, centre.y + share * positions_[w].y,
                centre.z + share * positions_[w].z};
      spread = std::max(spread, distance(positions_[v], positions_[w]));
    }
    const Vec3& p = positions_[v];
    const auto away = [](double from, double to) { return double{static_cast<float>(to + (to - from) / 2)}; };
    const Vec3 end{away(centre.x, p.x), away(centre.y, p.y), away(centre.z, p.z)};
    return end == p ? Vec3{away(p.x - spread, p.x), p.y, p.z} : end;
  }

  void add_lonely_points() {
    const std::vector<bool> is_held = held();
    const std::size_t count = positions_.size();
    for (std::size_t v = 0; v < count; ++v) {
      if (is_held[v]) continue;
      positions_.push_back(away_from_others(v, count));
      add(Edge{static_cast<Index>(v), static_cast<Index>(positions_.size()) - 1});
    }
    shape_points_ = count;
  }

  void renumber() {
    const std::vector<bool> is_held = held();
    std::vector<Index> number(positions_.size(), -1);
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      if (!is_held[v]) continue;
      number[v] = static_cast<Index>(mesh.positions.size());
      mesh.positions.push_back(positions_[v]);
      points.push_back(v < shape_points_ ? static_cast<Index>(v) : -1);
    }
    for (const auto& [a, b, c] : triangles_)
      mesh.triangles.push_back({number[slot(a)], number[slot(b)], number[slot(c)]});
    for (const auto& [a, b] : lines_) mesh.loose_edges.push_back({number[slot(a)], number[slot(b)]});
  }

  std::vector<Vec3> positions_;
  std::vector<Triangle> triangles_;
  std::set<Triangle> seen_;
  std::set<Edge> lines_, sides_;
  std::size_t shape_points_ = 0;
};

/// The two axes with the largest extents, the larger one horizontal, and the range of each.
struct Projection {
  std::array<int, 2> axis{0, 1};
  std::array<double, 2> low{}, high{};
  double scale = 1;

  explicit Projection(const std::vector<Vec3f>& points) {
    std::array<double, 3> least, most;
    least.fill(INFINITY);
    most.fill(-INFINITY);
    for (const Vec3f& p : points)
      for (int k = 0; k < 3; ++k) {
        least[k] = std::min(least[k], coordinate(p, k));
        most[k] = std::max(most[k], coordinate(p, k));
      }
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return most[a] - least[a] > most[b] - least[b]; });
    for (int k = 0; k < 2; ++k) {
      axis[k] = order[k];
      low[k] = least[order[k]];
      high[k] = most[order[k]];
    }
    const double extent = std::max(high[0] - low[0], high[1] - low[1]);
    scale = extent > 0 && std::isfinite(extent) ? (picture_size - 2 * margin) / extent : 0;
  }
  static double coordinate(const Vec3f& p, int k) { return k == 0 ? p.x : k == 1 ? p.y : p.z; }
  std::array<double, 2> at(const Vec3f& p) const {
    return {margin + scale * (coordinate(p, axis[0]) - low[0]),
            picture_size - margin - scale * (coordinate(p, axis[1]) - low[1])};
  }
};

}  // namespace

Index Shape::add(const Vec3f& p) {
  points.push_back(p);
  return static_cast<Index>(points.size()) - 1;
}

void Shape::add(const Topology& topology, const std::vector<Vec3f>& positions) {
  add_all(positions);
  triangles = topology.triangles;
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    if (topology.edge_triangles[e].empty()) lines.push_back(topology.edges[e]);
}

Shape shape_of(const TestCase& test) { return traits_of(test.name.stage).shape(test.data); }

std::string print_shape_obj(const Shape& shape) {
  const LegalMesh legal(shape);
  if (legal.mesh.positions.empty()) return {};
  std::string text;
  for (const Index dot : shape.dots) text += "# asked about: vertex " + std::to_string(dot) + " of the case\n";
  for (std::size_t v = 0; v < legal.points.size(); ++v) {
    const Vec3& p = legal.mesh.positions[v];
    text += "v " + shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z);
    if (legal.points[v] < 0)
      text += "  # no vertex of the case: it holds a point";
    else if (slot(legal.points[v]) != v)
      text += "  # vertex " + std::to_string(legal.points[v]) + " of the case";
    text += "\n";
  }
  for (const Triangle& t : legal.mesh.triangles) text += numbered("f", t);
  for (const Edge& e : legal.mesh.loose_edges) text += numbered("l", e);
  return text;
}

std::string print_shape_svg(const Shape& shape, const std::string& title) {
  if (shape.points.empty()) return {};
  const Projection projection(shape.points);
  Svg svg(picture_size, picture_size);
  svg.title(title);
  const auto at = [&](Index i) { return projection.at(shape.points[static_cast<std::size_t>(i)]); };
  for (const auto& t : shape.triangles)
    svg.polygon({at(t[0]), at(t[1]), at(t[2])}, "fill:#4477aa;fill-opacity:.25;stroke:#224466");
  for (const auto& l : shape.lines) svg.line(at(l[0]), at(l[1]), "stroke:#aa3377;stroke-width:2");
  for (const Index dot : shape.dots) svg.circle(at(dot), 5, "fill:#cc3311");
  for (std::size_t i = 0; i < shape.points.size() && shape.points.size() <= most_labels; ++i) {
    const auto [x, y] = at(static_cast<Index>(i));
    svg.circle({x, y}, 2, "fill:#000");
    svg.text({x + 5, y - 5}, std::to_string(i), "font:12px sans-serif");
  }
  constexpr std::array axes{"x", "y", "z"};
  const std::string legend = std::string(axes[projection.axis[0]]) + " to the right, " + axes[projection.axis[1]] +
                             " upwards";
  svg.text({margin, picture_size - 5}, legend, "font:11px sans-serif;fill:#666");
  return svg.finish();
}

}  // namespace ogc::compare

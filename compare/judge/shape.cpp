#include "compare/judge/shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "compare/judge/svg.hpp"

namespace ogc::compare {

namespace {

constexpr double picture_size = 480, margin = 24;
constexpr std::size_t most_labels = 24;

struct Builder {
  Shape shape;

  Index add(const Vec3f& p) {
    shape.points.push_back(p);
    return static_cast<Index>(shape.points.size()) - 1;
  }
  template <class Points>
  Index add_all(const Points& points) {
    const auto first = static_cast<Index>(shape.points.size());
    shape.points.insert(shape.points.end(), points.begin(), points.end());
    return first;
  }
  void mesh(const Topology& topology, const std::vector<Vec3f>& positions) {
    add_all(positions);
    shape.triangles = topology.triangles;
    for (std::size_t e = 0; e < topology.edges.size(); ++e)
      if (topology.edge_triangles[e].empty()) shape.lines.push_back(topology.edges[e]);
  }

  void operator()(const ClosestFaceCase& c) {
    shape.dots.push_back(add(c.point));
    add_all(c.triangle);
    shape.triangles.push_back({1, 2, 3});
  }
  void operator()(const ClosestPointsCase& c) {
    add_all(c.first);
    add_all(c.second);
    shape.lines = {{0, 1}, {2, 3}};
  }
  void operator()(const MeshCase& c) { mesh(*c.topology, c.positions); }
  void operator()(const BlockCase& c) {
    mesh(*c.topology, c.positions);
    for (const BlockQuestion& question : c.questions)
      if (question.kind == BlockQuestion::Kind::vertex_in_surface) shape.dots.push_back(question.of);
  }
  void operator()(const RestStateCase& c) { mesh(*c.topology, to_single(c.scene->rest_positions)); }
  void operator()(const SweepCase& c) { mesh(build_topology(*c.scene), c.previous); }
  void operator()(const StepCase& c) { mesh(*c.topology, to_single(c.scene->mesh.positions)); }
  void operator()(const TruncateCase& c) {
    shape.dots.push_back(add(c.previous));
    add(c.position);
    shape.lines.push_back({0, 1});
  }
  void operator()(const InitialGuessCase& c) {
    shape.dots.push_back(add(c.previous));
    add(c.start);
    shape.lines.push_back({0, 1});
  }
  void operator()(const MembraneCase& c) {
    add_all(c.corner);
    shape.triangles.push_back({0, 1, 2});
  }
  void operator()(const BendingCase& c) {
    add_all(c.vertex);
    shape.triangles = {{0, 1, 2}, {1, 0, 3}};
    shape.dots.push_back(c.own);
  }
  void operator()(const SpringCase& c) {
    add_all(c.vertex);
    shape.lines = {{0, 1}};
    if (c.ratio > 0) shape.lines.push_back({1, 2});
    shape.dots.push_back(c.own);
  }
  void operator()(const ContactForceCase& c) {
    const auto count = static_cast<std::size_t>(vertex_count(c.sides));
    add_all(std::vector<Vec3f>(c.vertex.begin(), c.vertex.begin() + static_cast<std::ptrdiff_t>(count)));
    if (c.sides == ContactSides::point_edge) shape.lines = {{1, 2}};
    if (c.sides == ContactSides::edge_edge) shape.lines = {{0, 1}, {2, 3}};
    if (c.sides == ContactSides::point_triangle) shape.triangles = {{1, 2, 3}};
    shape.dots.push_back(c.own);
  }
  void operator()(const FrictionForceCase& c) { (*this)(c.contact); }
  template <class Other>
  void operator()(const Other&) {}
};

std::string numbered(const char* kind, std::initializer_list<Index> indices) {
  std::string line = kind;
  for (const Index i : indices) line += " " + std::to_string(i + 1);
  return line + "\n";
}

/// The two axes with the largest extents, the larger one to the right; and from where to where.
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
    return {margin + scale * (coordinate(p, axis[0]) - low[0]), picture_size - margin - scale * (coordinate(p, axis[1]) - low[1])};
  }
};

}  // namespace

Shape shape_of(const CaseData& data) {
  Builder builder;
  std::visit([&](const auto& c) { builder(c); }, data);
  return std::move(builder.shape);
}

std::string print_shape_obj(const Shape& shape) {
  std::string text;
  for (const Vec3f& p : shape.points) {
    char buffer[96];
    std::snprintf(buffer, sizeof buffer, "v %.9g %.9g %.9g\n", double{p.x}, double{p.y}, double{p.z});
    text += buffer;
  }
  for (const Index dot : shape.dots) text += numbered("p", {dot});
  for (const auto& t : shape.triangles) text += numbered("f", {t[0], t[1], t[2]});
  for (const auto& l : shape.lines) text += numbered("l", {l[0], l[1]});
  return text;
}

std::string print_shape_svg(const Shape& shape, const std::string& title) {
  if (shape.points.empty()) return {};
  const Projection projection(shape.points);
  Svg svg(picture_size, picture_size);
  svg.title(title);
  const auto at = [&](Index i) { return projection.at(shape.points[static_cast<std::size_t>(i)]); };
  for (const auto& t : shape.triangles) svg.polygon({at(t[0]), at(t[1]), at(t[2])}, "fill:#4477aa;fill-opacity:.25;stroke:#224466");
  for (const auto& l : shape.lines) svg.line(at(l[0]), at(l[1]), "stroke:#aa3377;stroke-width:2");
  for (const Index dot : shape.dots) svg.circle(at(dot), 5, "fill:#cc3311");
  for (std::size_t i = 0; i < shape.points.size() && shape.points.size() <= most_labels; ++i) {
    const auto [x, y] = at(static_cast<Index>(i));
    svg.circle({x, y}, 2, "fill:#000");
    svg.text({x + 5, y - 5}, std::to_string(i), "font:12px sans-serif");
  }
  constexpr std::array axes{"x", "y", "z"};
  const std::string legend = std::string(axes[projection.axis[0]]) + " to the right, " + axes[projection.axis[1]] + " upwards";
  svg.text({margin, picture_size - 5}, legend, "font:11px sans-serif;fill:#666");
  return svg.finish();
}

}  // namespace ogc::compare

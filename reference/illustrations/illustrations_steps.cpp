// Computes Fig. 9 and 22b, in which bounds cut the steps. Uses the reference's detections, bounds and truncations, with
// lengths as in cloth. Fig. 9 is a slice of swept polylines, as in illustrations_2d.cpp. The line search that Fig. 9b
// shows for comparison finds the first root of a quadratic.
#include <algorithm>

#include "compare/problem/settings.hpp"
#include "reference/geometry/bound.hpp"
#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "reference/geometry/pair_planes.hpp"
#include "reference/geometry/truncate.hpp"
#include "reference/illustrations/illustration_parts.hpp"
#include "reference/illustrations/slice.hpp"
#include "reference/solvers/feasible_regions.hpp"

namespace ogc::reference {
namespace {

using Point2 = Slice::Point2;
using Plane = std::array<double, 2>;

std::vector<float> bounds_of(const compare::Topology& topology, const std::vector<Vec3f>& positions,
                             float contact_radius, float query_radius) {
  const std::vector<Index> no_groups;
  const compare::DetectIn in{&topology, no_groups, positions, contact_radius, query_radius};
  const auto facets = detect_vertex_facet(in).exact;
  const auto edges = detect_edge_edge(in).exact;
  const auto bounds_relaxation = static_cast<float>(compare::Settings{}.bounds_relaxation);
  return bound({&topology, facets.d_min_vertex, edges.d_min_edge, facets.d_min_triangle, bounds_relaxation})
      .exact.bound;
}

/// The result of a truncation to the ball about X_prev (Eq. 27, 28).
struct Cut {
  Vec3f position;
  bool cut = false;
};
Cut cut_to_ball(const Vec3f& previous, const Vec3f& target, float bound) {
  const compare::TruncateTruth truth = truncate({{previous}, {target}, {bound}});
  return {stored_within(truth.position[0], previous, bound), truth.cut[0] != 0};
}

template <class Points>
DrawingLayer polyline(const std::string& name, const Points& points, std::vector<double> values = {}) {
  DrawingLayer layer{name, {}, {}, {{}}, std::move(values), true};
  for (const auto& p : points) {
    layer.lines[0].push_back(static_cast<int>(layer.points.size()));
    layer.points.push_back({p[0], p[1], 0});
  }
  return layer;
}

// Fig. 9 [m]: thirteen vertices 10 mm apart, and a circle of radius 12 mm whose top is 1 mm below the middle vertex.
constexpr int vertices = 13, circle_corners = 32;
constexpr double spacing = 0.01, obstacle_radius = 0.012, gap = 0.001;

struct OneStep {
  std::vector<Plane> before, target, obstacle;
};

OneStep one_step() {
  OneStep step;
  for (int i = 0; i < vertices; ++i) {
    const double u = i - (vertices - 1) / 2;
    step.before.push_back({spacing * u, 0.00004 * u * u});
    step.target.push_back({spacing * u * 0.99, 0.00006 * u * u - 0.0042});
  }
  for (int k = 0; k <= circle_corners; ++k) {
    const auto [x, y] = on_circle(k, circle_corners);
    step.obstacle.push_back({obstacle_radius * x, obstacle_radius * y - obstacle_radius - gap});
  }
  return step;
}

std::vector<Point2> singles(const std::vector<Plane>& points) {
  std::vector<Point2> single;
  for (const Plane& p : points) single.push_back({static_cast<float>(p[0]), static_cast<float>(p[1])});
  return single;
}

/// Returns b_v for each vertex of the moving polyline M. The bounds include the distances between M and the obstacle.
std::vector<float> bounds_beside(const OneStep& step) {
  const Slice line(singles(step.before)), obstacle(singles(step.obstacle));
  std::vector<Vec3f> positions(line.mesh().positions.begin(), line.mesh().positions.end());
  std::vector<compare::Triangle> triangles = line.mesh().topology.triangles;
  const auto shift = static_cast<Index>(positions.size());
  positions.insert(positions.end(), obstacle.mesh().positions.begin(), obstacle.mesh().positions.end());
  for (const auto& t : obstacle.mesh().topology.triangles)
    triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  const auto topology = compare::build_topology(static_cast<Index>(positions.size()), triangles);
  const std::vector<float> all = bounds_of(topology, positions, 0.005f, 0.02f);
  std::vector<float> bounds;
  for (int i = 0; i < vertices; ++i) bounds.push_back(all[static_cast<std::size_t>(line.vertex(i))]);
  return bounds;
}

double crossed(const Plane& a, const Plane& b) { return a[0] * b[1] - a[1] * b[0]; }
Plane less(const Plane& a, const Plane& b) { return {a[0] - b[0], a[1] - b[1]}; }
Plane along(const Plane& a, const Plane& b, double s) { return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])}; }

/// Returns the smallest share s ≤ 1 of the step at which a moving point lies on a moving segment.
double first_touch(const std::array<Plane, 2>& point, const std::array<Plane, 2>& a, const std::array<Plane, 2>& b) {
  const auto at = [&](const std::array<Plane, 2>& x, double s) { return along(x[0], x[1], s); };
  const auto area = [&](double s) { return crossed(less(at(b, s), at(a, s)), less(at(point, s), at(a, s))); };
  // c0 + slope s + c2 s²
  const double c0 = area(0), middle = area(0.5), c1 = area(1), c2 = 2 * (c0 + c1 - 2 * middle), slope = c1 - c0 - c2;
  const double root = std::sqrt(std::max(0.0, slope * slope - 4 * c0 * c2));
  double first = 1;
  for (const double s : {2 * c0 / (-slope + root), 2 * c0 / (-slope - root)}) {
    if (!(s >= 0 && s < first)) continue;
    const Plane e = less(at(b, s), at(a, s)), p = less(at(point, s), at(a, s));
    const double share = (p[0] * e[0] + p[1] * e[1]) / (e[0] * e[0] + e[1] * e[1]);
    if (share >= 0 && share <= 1) first = s;
  }
  return first;
}

/// Returns the share of the step at which M first touches the obstacle. A line search with continuous detection stops
/// there.
double first_collision(const OneStep& step) {
  double first = 1;
  for (std::size_t i = 0; i < step.before.size(); ++i) {
    const std::array<Plane, 2> v{step.before[i], step.target[i]};
    for (std::size_t k = 0; k + 1 < step.obstacle.size(); ++k) {
      const Plane &a = step.obstacle[k], &b = step.obstacle[k + 1];
      first = std::min(first, first_touch(v, {a, a}, {b, b}));
      if (i + 1 < step.before.size())
        first = std::min(first, first_touch({a, a}, v, {step.before[i + 1], step.target[i + 1]}));
    }
  }
  return first;
}

// Fig. 22b [m, s]: two triangles side by side, 10 mm apart, that fall in their plane.
constexpr float contact_radius = 0.005f;
constexpr double time_step = 0.01, gravity = 9.81;
constexpr int most_rounds = 64;

struct Fall {
  std::vector<Vec3f> start, target;
  std::vector<std::vector<Vec3f>> rounds;  ///< positions after each round
  std::vector<std::vector<float>> bounds;  ///< b_v at the beginning of each round
};

/// Returns the positions, truncated by planes between near pairs (method.md §5.6).
std::vector<Cut> cut_by_planes(const compare::Topology& topology, const std::vector<Vec3f>& x,
                               const std::vector<Vec3f>& target, float query_radius) {
  const std::vector<Index> no_groups;
  const std::vector<std::uint8_t> all_free(x.size(), 0);
  compare::PlaneOut held = pair_planes(
      {&topology, no_groups, x, all_free, query_radius, static_cast<float>(compare::Settings{}.bounds_relaxation)});
  Detected here;
  here.previous = x, here.bound = std::move(held.bound), here.planes = std::move(held.planes);
  const FeasibleRegions regions(here, compare::Bounds::planes);
  const auto wide = [](const Vec3f& p) { return Triple<double>{p.x, p.y, p.z}; };
  std::vector<Cut> cuts;
  for (std::size_t v = 0; v < x.size(); ++v) {
    const FeasibleRegions::Inside inside = regions.inside(v, wide(x[v]), wide(target[v]));
    cuts.push_back({rounded({inside.x}).front(), inside.cut});
  }
  return cuts;
}

/// Runs rounds of detection and truncation until no vertex is cut. All vertices fall by the same distance, so there is
/// no contact.
Fall fall(double speed, compare::Bounds kind = compare::Bounds::ball) {
  Fall f;
  f.start = {{-0.025f, 0, 0}, {-0.005f, 0, 0}, {-0.015f, 0.015f, 0},
             {0.005f, 0, 0},  {0.025f, 0, 0},  {0.015f, 0.015f, 0}};
  const auto topology = compare::build_topology(6, std::vector<compare::Triangle>{{0, 1, 2}, {3, 4, 5}});
  const double way = time_step * speed + time_step * time_step * gravity;
  for (const Vec3f& x : f.start) f.target.push_back({x.x, static_cast<float>(x.y - way), x.z});
  const float query_radius = std::min(contact_radius + static_cast<float>(way),
                                      static_cast<float>(compare::Settings{}.detection_radius_cap) * contact_radius);
  std::vector<Vec3f> x = f.start;
  const bool has_planes = traits_of(kind).has_planes;
  for (bool cut = true; cut && static_cast<int>(f.rounds.size()) < most_rounds;) {
    f.bounds.push_back(bounds_of(topology, x, contact_radius, query_radius));
    cut = false;
    std::vector<Cut> moved;
    if (has_planes) moved = cut_by_planes(topology, x, f.target, query_radius);
    for (std::size_t v = 0; v < x.size(); ++v) {
      if (!has_planes) moved.push_back(cut_to_ball(x[v], f.target[v], f.bounds.back()[v]));
      x[v] = moved[v].position;
      cut = cut || moved[v].cut;
    }
    f.rounds.push_back(x);
  }
  return f;
}

DrawingLayer triangles_at(const std::string& name, const std::vector<Vec3f>& positions,
                          std::vector<double> values = {}) {
  DrawingLayer layer{name, {}, {{0, 1, 2}, {3, 4, 5}}, {{0, 1, 2, 0}, {3, 4, 5, 3}}, std::move(values), true};
  for (const Vec3f& x : positions) layer.points.push_back({x.x, x.y, x.z});
  return layer;
}

}  // namespace

std::vector<DrawingPanel> one_iteration() {
  const OneStep step = one_step();
  const std::vector<float> bounds = bounds_beside(step);
  const double share = first_collision(step);
  std::vector<Plane> global, local;
  std::vector<double> shares;
  for (std::size_t i = 0; i < step.before.size(); ++i) {
    global.push_back(along(step.before[i], step.target[i], share));
    const auto to = [](const Plane& p) { return Vec3f{static_cast<float>(p[0]), static_cast<float>(p[1]), 0}; };
    const Vec3f x = cut_to_ball(to(step.before[i]), to(step.target[i]), bounds[i]).position;
    local.push_back({x.x, x.y});
    const Plane all = less(step.target[i], step.before[i]), part = less(local.back(), step.before[i]);
    shares.push_back(std::hypot(part[0], part[1]) / std::hypot(all[0], all[1]));
  }
  const DrawingLayer before = polyline("before", step.before), target = polyline("target", step.target),
                     obstacle = polyline("obstacle", step.obstacle);
  const std::vector<double> same(step.before.size(), share);
  return {
      {"a",
       "the state X^prev, and the full step of the optimizer (dashed), which penetrates",
       {before, target, obstacle}},
      {"b",
       "the whole step truncated where the first collision happens",
       {before, target, obstacle, polyline("after", global, same)}},
      {"c",
       "the conservative bounds b_v, one for each vertex",
       {before, target, obstacle, polyline("bounds", step.before, {bounds.begin(), bounds.end()})}},
      {"d", "each vertex truncated to its own bound", {before, target, obstacle, polyline("after", local, shares)}}};
}

std::vector<DrawingPanel> falling_triangles() {
  constexpr double drawn_speed = 2;
  const Fall drawn = fall(drawn_speed);
  DrawingPanel way{"b", "two triangles fall in parallel: bounds of each round, and the inertial target", {}};
  way.layers.push_back(triangles_at("start", drawn.start, {drawn.bounds[0].begin(), drawn.bounds[0].end()}));
  for (std::size_t k = 0; k < drawn.rounds.size(); ++k) {
    const bool last = k + 1 == drawn.rounds.size();
    const std::vector<float>& next = drawn.bounds[last ? k : k + 1];
    way.layers.push_back(triangles_at(last ? "end" : "round", drawn.rounds[k], {next.begin(), next.end()}));
  }
  way.layers.push_back(triangles_at("target", drawn.target, {drawn_speed, time_step}));
  DrawingLayer rounds{"rounds", {}, {}, {{}}, {}, true}, with_planes{"rounds with planes", {}, {}, {{}}, {}, true};
  for (int k = 0; k <= 64; ++k) {
    const double speed = 0.125 * k;
    for (const auto& [layer, kind] :
         {std::pair{&rounds, compare::Bounds::ball}, {&with_planes, compare::Bounds::planes}}) {
      layer->lines[0].push_back(k);
      layer->points.push_back({speed, static_cast<double>(fall(speed, kind).rounds.size()), 0});
    }
  }
  const auto limit = static_cast<double>(compare::Settings{}.guess_rounds);
  const DrawingLayer most{"guess_rounds", {{0, limit, 0}, {rounds.points.back()[0], limit, 0}}, {}, {{0, 1}}, {}, true};
  return {std::move(way),
          {"rounds",
           "rounds of detection and truncation until the target is reached",
           {std::move(rounds), std::move(with_planes), most}}};
}

}  // namespace ogc::reference

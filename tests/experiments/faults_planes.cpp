// Plants faults of the planes: faults that let a pair pass through each other, and faults that restrict vertices
// without need.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/stages/bound.hpp"
#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "reference/geometry/pair_planes.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

using Kind = PrimitivePair::Kind;
using Rows = std::vector<std::vector<VertexPlane>>;

Rows rows_of(const PlaneOut& out) {
  Rows rows;
  for (std::size_t v = 0; v < out.bound.size(); ++v) {
    const auto row = out.planes.of(static_cast<Index>(v));
    rows.emplace_back(row.begin(), row.end());
  }
  return rows;
}

VertexPlanes planes_of(const Rows& rows) {
  VertexPlanes planes{{0}, {}};
  for (const auto& row : rows) {
    planes.items.insert(planes.items.end(), row.begin(), row.end());
    planes.offsets.push_back(static_cast<Index>(planes.items.size()));
  }
  return planes;
}

/// Returns whether vertex v belongs to the pair's second side.
bool is_second(const PlaneIn& in, const PrimitivePair& pair, Index v) {
  if (pair.kind == Kind::vertex_triangle) return v != pair.first;
  return std::ranges::find(in.topology->edges[static_cast<std::size_t>(pair.first)], v) ==
         in.topology->edges[static_cast<std::size_t>(pair.first)].end();
}

/// Returns a fault that changes the right answer by `spoil(in, out)`.
template <class Spoil>
Fault ball_fault(const std::string& name, Spoil spoil) {
  return spoiled("plane: " + name, &Contestant::plane, spoil);
}

/// Returns a fault that changes the half-spaces of the right answer by `spoil(in, rows)`.
template <class Spoil>
Fault row_fault(const std::string& name, Spoil spoil) {
  return ball_fault(name, [spoil](const PlaneIn& in, PlaneOut& out) {
    Rows rows = rows_of(out);
    spoil(in, rows);
    out.planes = planes_of(rows);
  });
}

/// Returns a fault that changes each half-space of the right answer by `spoil(in, vertex, plane)`.
template <class Spoil>
Fault plane_fault(const std::string& name, Spoil spoil) {
  return row_fault(name, [spoil](const PlaneIn& in, Rows& rows) {
    for (std::size_t v = 0; v < rows.size(); ++v)
      for (VertexPlane& plane : rows[v]) spoil(in, static_cast<Index>(v), plane);
  });
}

std::array<std::vector<Index>, 2> sides_of(const Topology& topology, const PrimitivePair& pair) {
  const auto second = static_cast<std::size_t>(pair.second);
  if (pair.kind == Kind::vertex_triangle)
    return {{{pair.first}, {topology.triangles[second].begin(), topology.triangles[second].end()}}};
  const Edge &e = topology.edges[static_cast<std::size_t>(pair.first)], &f = topology.edges[second];
  return {{{e.begin(), e.end()}, {f.begin(), f.end()}}};
}

double height(const Vec3f& n, const Vec3f& x) { return double{n.x} * x.x + double{n.y} * x.y + double{n.z} * x.z; }

/// Speeds of approach by vertex: n·w for the pair's first side, −n·w for its second side; w is the displacement.
struct Speeds {
  std::vector<double> first, second;
};

/// Returns a fault with wrong offsets: where displacements divide a pair's gap, the first side gets the share
/// `share_of_first(speeds)`.
Fault divided_otherwise(const std::string& name, const std::function<double(const Speeds&)>& share_of_first) {
  return plane_fault(name, [share_of_first](const PlaneIn& in, Index v, VertexPlane& plane) {
    if (in.displacement.empty()) return;
    const auto moves = [&](Index i) { return in.is_fixed[static_cast<std::size_t>(i)] == 0; };
    const std::array<std::vector<Index>, 2> sides = sides_of(*in.topology, plane.pair);
    for (const auto& side : sides)
      if (std::ranges::none_of(side, moves)) return;
    const bool second = is_second(in, plane.pair, v);
    const Vec3f n = second ? Vec3f{-plane.normal.x, -plane.normal.y, -plane.normal.z} : plane.normal;
    Speeds speeds;
    double top = -std::numeric_limits<double>::infinity(), bottom = -top;
    for (const Index i : sides[0]) {
      top = std::max(top, height(n, in.positions[static_cast<std::size_t>(i)]));
      speeds.first.push_back(height(n, in.displacement[static_cast<std::size_t>(i)]));
    }
    for (const Index i : sides[1]) {
      bottom = std::min(bottom, height(n, in.positions[static_cast<std::size_t>(i)]));
      speeds.second.push_back(-height(n, in.displacement[static_cast<std::size_t>(i)]));
    }
    const double whole = 2 * double{in.bounds_relaxation} * (bottom - top), s = share_of_first(speeds);
    plane.offset = second ? (1 - s) * whole - bottom : top + s * whole;
  });
}

double largest(const std::vector<double>& all) { return std::max(0.0, *std::ranges::max_element(all)); }

std::vector<Fault> division_faults() {
  return {
      divided_otherwise("negative approach not clamped",
                        [](const Speeds& w) {
                          const double a = *std::ranges::max_element(w.first), b = *std::ranges::max_element(w.second);
                          return a + b != 0 ? std::clamp(a / (a + b), least_division, 1 - least_division) : 0.5;
                        }),
      divided_otherwise("all room to one side where the other does not approach",
                        [](const Speeds& w) {
                          const double a = largest(w.first), b = largest(w.second);
                          return a + b > 0 ? a / (a + b) : 0.5;
                        }),
  };
}

/// Imitates a limit of the number of planes at each vertex: removes the last plane of each vertex that has
/// planes_of_vertex planes. The planes of the same pair at other vertices stay.
void asymmetric_cap(const PlaneIn&, Rows& rows) {
  for (auto& row : rows)
    if (row.size() == planes_of_vertex) row.pop_back();
}

std::vector<Fault> plane_by_plane() {
  return {
      plane_fault("each side rounds its own normal",
                  [](const PlaneIn& in, Index v, VertexPlane& plane) {
                    if (is_second(in, plane.pair, v)) plane.normal.x = std::nextafter(plane.normal.x, 2.0f);
                  }),
      plane_fault("offsets in single precision",
                  [](const PlaneIn&, Index, VertexPlane& plane) { plane.offset = static_cast<float>(plane.offset); }),
      plane_fault("one offset in the middle of a pair, which both sides may reach",
                  [](const PlaneIn& in, Index v, VertexPlane& plane) {
                    // The vertices of each side may approach by γ_p g, where g is the pair's gap. The fault allows g/2,
                    // up to the middle.
                    const auto& x = in.positions[static_cast<std::size_t>(v)];
                    const Vec3f& n = plane.normal;
                    const double room = plane.offset - (double{n.x} * x.x + double{n.y} * x.y + double{n.z} * x.z);
                    plane.offset += room * (0.5 / double{in.bounds_relaxation} - 1) * (1 + 0x1p-20);
                  }),
      plane_fault("no room: each side stays where it is",
                  [](const PlaneIn& in, Index v, VertexPlane& plane) {
                    const auto& x = in.positions[static_cast<std::size_t>(v)];
                    const Vec3f& n = plane.normal;
                    const double height = double{n.x} * x.x + double{n.y} * x.y + double{n.z} * x.z;
                    plane.offset = std::min(plane.offset, height + 0x1p-45 * std::abs(height));
                  }),
      plane_fault("a wrong slack: planes that their vertex does not keep by an ulp",
                  [](const PlaneIn& in, Index v, VertexPlane& plane) {
                    const auto& x = in.positions[static_cast<std::size_t>(v)];
                    const Vec3f& n = plane.normal;
                    const double height = double{n.x} * x.x + double{n.y} * x.y + double{n.z} * x.z;
                    plane.offset = std::min(plane.offset, height - 0x1p-50 * std::abs(height));
                  }),
  };
}

std::vector<Fault> row_by_row() {
  return {
      row_fault("a cap that one side of a pair keeps for itself", asymmetric_cap),
      row_fault("the second side bears no plane",
                [](const PlaneIn& in, Rows& rows) {
                  for (std::size_t v = 0; v < rows.size(); ++v)
                    std::erase_if(rows[v], [&](const VertexPlane& plane) {
                      return is_second(in, plane.pair, static_cast<Index>(v));
                    });
                }),
      row_fault("planes in the order in which threads found them",
                [](const PlaneIn&, Rows& rows) {
                  for (auto& row : rows) std::ranges::reverse(row);
                }),
      row_fault("a row handed to the next vertex",
                [](const PlaneIn&, Rows& rows) {
                  if (rows.size() > 1) std::swap(rows[0], rows[1]);
                }),
  };
}

std::vector<Fault> ball_by_ball() {
  const auto share_of_reach = [](const PlaneIn& in) { return in.bounds_relaxation * in.query_radius; };
  return {
      ball_fault("a pair without a separator left free",
                 [share_of_reach](const PlaneIn& in, PlaneOut& out) {
                   for (float& b : out.bound)
                     if (b < std::numeric_limits<float>::max()) b = std::nextafter(share_of_reach(in), 0.0f);
                 }),
      ball_fault("a ball one ulp too large",
                 [](const PlaneIn&, PlaneOut& out) {
                   for (float& b : out.bound) b = std::nextafter(b, std::numeric_limits<float>::infinity());
                 }),
      ball_fault("planes dropped, their balls kept", [](const PlaneIn&, PlaneOut& out) { out.planes = {}; }),
      ball_fault("balls of nothing", [](const PlaneIn&, PlaneOut& out) { std::ranges::fill(out.bound, 0.0f); }),
      ball_fault("vertices inside solids bounded",
                 [share_of_reach](const PlaneIn& in, PlaneOut& out) {
                   for (float& b : out.bound) b = std::min(b, share_of_reach(in));
                 }),
  };
}

/// Returns the paper's bounds, without planes: each vertex has the ball of its nearest pair.
std::vector<float> balls_of_all_pairs(const PlaneIn& in, const Authority& authority) {
  const DetectIn asked{in.topology, in.exclusions, in.positions, in.query_radius, in.query_radius};
  const DetectVertexFacetOut near = authority.detect_vertex_facet(asked).exact;
  const std::vector<float> edges = authority.detect_edge_edge(asked).exact.d_min_edge;
  return authority.bound({in.topology, near.d_min_vertex, edges, near.d_min_triangle, in.bounds_relaxation})
      .exact.bound;
}

/// Returns a fault that has the paper's bounds and no planes.
Fault balls_alone() {
  return {"plane: balls in place of planes", Stage::plane, [](Contestant& contestant, const Authority& authority) {
            contestant.plane = [authority](const PlaneIn& in) {
              return PlaneOut{{}, balls_of_all_pairs(in, authority)};
            };
          }};
}

/// Returns a fault whose bounds are as small as without planes, so that the planes are useless.
Fault balls_beside_planes() {
  return {"plane: balls of all pairs beside the planes", Stage::plane,
          [](Contestant& contestant, const Authority& authority) {
            contestant.plane = [right = contestant.plane, authority](const PlaneIn& in) {
              PlaneOut out = right(in);
              const std::vector<float> balls = balls_of_all_pairs(in, authority);
              for (std::size_t v = 0; v < balls.size(); ++v) out.bound[v] = std::min(out.bound[v], balls[v]);
              return out;
            };
          }};
}

/// Returns a fault that treats fixed vertices as free: they get planes, and vertices opposite them may use only γ_p of
/// the gap.
Fault fixed_as_free() {
  return {"plane: fixed vertices taken for free ones", Stage::plane, [](Contestant& contestant, const Authority&) {
            contestant.plane = [right = contestant.plane](const PlaneIn& in) {
              const std::vector<std::uint8_t> none(in.positions.size(), 0);
              PlaneIn other = in;
              other.is_fixed = none;
              PlaneOut out = right(other);
              Rows rows = rows_of(out);
              for (std::size_t v = 0; v < rows.size(); ++v)
                if (in.is_fixed[v] != 0) rows[v].clear();
              out.planes = planes_of(rows);
              return out;
            };
          }};
}

}  // namespace

std::vector<Fault> plane_faults() {
  std::vector<Fault> all = plane_by_plane();
  for (auto* faults : {row_by_row, ball_by_ball, division_faults})
    for (Fault& fault : faults()) all.push_back(std::move(fault));
  all.push_back(balls_alone());
  all.push_back(fixed_as_free());
  all.push_back(balls_beside_planes());
  return all;
}

}  // namespace ogc::tests

#include "experiments/program/audits/rounding_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "experiments/program/output.hpp"

namespace ogc::experiments {

namespace {

using compare::Index;
using compare::Intersection;
using compare::Vec3;

Vec3 minus(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 along(const Vec3& a, double s, const Vec3& e) { return {a.x + s * e.x, a.y + s * e.y, a.z + s * e.z}; }
double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

double to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 e = minus(b, a);
  const double squared = dot(e, e), s = squared > 0 ? std::clamp(dot(minus(p, a), e) / squared, 0.0, 1.0) : 0;
  return length(minus(p, along(a, s, e)));
}

/// Returns the distance of two segments. It is the least distance from an end point to the other segment or, if both
/// closest points lie inside the segments, the distance of the lines.
double of_segments(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double ends = std::min({to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)});
  const Vec3 e = minus(b, a), f = minus(d, c), n = cross(e, f), r = minus(c, a);
  const double squared = dot(n, n);
  if (!(squared > 0)) return ends;
  const double s = dot(cross(r, f), n) / squared, t = dot(cross(r, e), n) / squared;
  if (!(s > 0 && s < 1 && t > 0 && t < 1)) return ends;
  return std::min(ends, std::abs(dot(r, n)) / std::sqrt(squared));
}

double to_triangle(const Vec3& p, const std::array<Vec3, 3>& t) {
  double nearest = std::min({to_segment(p, t[0], t[1]), to_segment(p, t[1], t[2]), to_segment(p, t[2], t[0])});
  const Vec3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  bool is_over = dot(n, n) > 0;
  for (std::size_t k = 0; k < 3; ++k)
    is_over = is_over && dot(cross(minus(t[(k + 1) % 3], t[k]), minus(p, t[k])), n) > 0;
  return is_over ? std::min(nearest, std::abs(dot(minus(p, t[0]), n)) / length(n)) : nearest;
}

/// Returns how far one vertex must move at least until the edge no longer meets the triangle. Either an end of the edge
/// moves back through the triangle, or the edge passes an edge of the triangle. Vertices that edge and triangle share
/// do not move. Double precision suffices, because its relative error of 1e-16 is below the digits of any text.
double depth(const Intersection& pair, const compare::Topology& topology, std::span<const Vec3> positions) {
  if (pair.kind != compare::IntersectionKind::edge_triangle) return 0;
  const compare::Edge& edge = topology.edges[static_cast<std::size_t>(pair.first)];
  const compare::Triangle& corners = topology.triangles[static_cast<std::size_t>(pair.second)];
  const auto at = [&](Index v) -> const Vec3& { return positions[static_cast<std::size_t>(v)]; };
  const auto is_corner = [&](Index v) { return std::ranges::find(corners, v) != corners.end(); };
  double least = std::numeric_limits<double>::infinity();
  for (const Index v : edge)
    if (!is_corner(v)) least = std::min(least, to_triangle(at(v), {at(corners[0]), at(corners[1]), at(corners[2])}));
  for (std::size_t k = 0; k < 3; ++k) {
    const Index from = corners[k], to = corners[(k + 1) % 3];
    if (from == edge[0] || from == edge[1] || to == edge[0] || to == edge[1]) continue;
    least = std::min(least, of_segments(at(edge[0]), at(edge[1]), at(from), at(to)));
  }
  return least;
}

}  // namespace

std::optional<RoundingDoubt> rounding_doubt(const std::optional<compare::PrintedDigits>& printed,
                                            const compare::AuditResult& result,
                                            const compare::SmallestDistances& distances,
                                            const compare::Topology& topology, std::span<const Vec3> positions) {
  if (!printed) return std::nullopt;
  const double reach = units_of_a_distance * printed->unit;
  RoundingDoubt doubt{*printed, result.intersections.size(), 0,
                      std::min(distances.vertex_triangle, distances.edge_edge)};
  for (const Intersection& pair : result.intersections) doubt.doubtful += depth(pair, topology, positions) <= reach;
  const bool is_open = result.count == 0 ? doubt.smallest <= reach : doubt.doubtful > 0;
  return is_open ? std::optional(doubt) : std::nullopt;
}

std::string describe(const RoundingDoubt& doubt, const std::string& name) {
  const compare::PrintedDigits& printed = doubt.printed;
  const std::string digits = name + " prints its coordinates with " + std::to_string(printed.digits) +
                             (printed.are_decimals ? " decimals" : " digits") + ", the last of which stands for " +
                             number(printed.unit) + " m: ";
  const std::string found = doubt.listed > 0 ? std::to_string(doubt.doubtful) + " of its " +
                                                   counted(doubt.listed, "listed intersection") +
                                                   (doubt.doubtful == 1 ? " is" : " are") +
                                                   " no deeper than this rounding, which may have made them"
                                             : "its smallest distance, " + number(doubt.smallest) +
                                                   " m, is less than this rounding can change";
  return digits + found + "; write 17 digits, or a binary format";
}

nlohmann::ordered_json to_json(const RoundingDoubt& doubt) {
  const compare::PrintedDigits& printed = doubt.printed;
  return {{printed.are_decimals ? "decimals" : "digits", printed.digits},
          {"unit", printed.unit},
          {"listed_intersections", doubt.listed},
          {"doubtful_intersections", doubt.doubtful}};
}

}  // namespace ogc::experiments

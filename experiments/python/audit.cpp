// The module `_audit`: exact audits of anybody's frames, by CGAL's kernel and GMP, which are under the LGPL.
#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include <nanobind/stl/string.h>

#include "compare/oracle/audit.hpp"
#include "compare/oracle/meetings.hpp"
#include "compare/oracle/smallest_distances.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/mesh.hpp"
#include "experiments/python/arrays.hpp"

namespace ogc::python {
namespace {

using compare::Index, compare::Vec3;

/// The findings about all frames; columns are read by NumPy where they lie.
struct AuditReport {
  compare::Topology topology;
  std::vector<Index> groups;
  std::vector<std::array<std::int64_t, 4>> intersecting;  // frame, kind, first, second
  std::vector<std::int64_t> counts;
  std::vector<double> vertex_triangle, edge_edge;
  std::vector<std::array<std::int64_t, 4>> meetings;  // frame before the motion, kind, first, second
  std::vector<double> meeting_times;
  std::vector<std::int64_t> meeting_counts;
  bool asks_motion = false;

  bool is_clean() const {
    const auto is_zero = [](std::int64_t count) { return count == 0; };
    return std::ranges::all_of(counts, is_zero) && std::ranges::all_of(meeting_counts, is_zero);
  }
};

/// Gives one frame after the other, widened without loss.
class Frames {
 public:
  explicit Frames(nb::handle frames) {
    array_ = checked(frames, {"frames", "float32", "(F, V, 3)", 3, 3, Place::host, "float64"});
    if (is_double(array_))
      doubles_ = static_cast<const Vec3*>(static_cast<const void*>(array_.data()));
    else
      singles_ = static_cast<const compare::Vec3f*>(static_cast<const void*>(array_.data()));
  }
  std::size_t count() const { return array_.shape(0); }
  std::size_t vertex_count() const { return array_.shape(1); }
  std::vector<Vec3> operator[](std::size_t frame) const {
    std::vector<Vec3> positions;
    positions.reserve(vertex_count());
    const std::size_t begin = frame * vertex_count(), end = begin + vertex_count();
    for (std::size_t i = begin; i < end; ++i)
      positions.push_back(doubles_ != nullptr ? doubles_[i] : Vec3{singles_[i].x, singles_[i].y, singles_[i].z});
    return positions;
  }

 private:
  Array array_;
  const Vec3* doubles_ = nullptr;
  const compare::Vec3f* singles_ = nullptr;
};

template <std::size_t N>
void check(std::span<const std::array<Index, N>> primitives, std::size_t vertex_count, const std::string& name) {
  for (std::size_t i = 0; i < primitives.size(); ++i)
    for (std::size_t k = 0; k < N; ++k) {
      const Index v = primitives[i][k];
      if (v < 0 || compare::at(v) >= vertex_count || v == primitives[i][(k + 1) % N])
        throw compare::InputError(name + ": row " + std::to_string(i) + " names vertex " + std::to_string(v) +
                                  (v >= 0 && compare::at(v) < vertex_count
                                       ? " twice"
                                       : ", but frames have " + std::to_string(vertex_count) + " vertices"));
    }
}

void audit_state(AuditReport& report, std::size_t frame, const std::vector<Vec3>& positions, std::size_t limit) {
  const compare::AuditResult found = compare::audit(report.topology, positions, report.groups, {limit});
  report.counts.push_back(static_cast<std::int64_t>(found.count));
  for (const compare::Intersection& pair : found.intersections)
    report.intersecting.push_back(
        {static_cast<std::int64_t>(frame), static_cast<std::int64_t>(pair.kind), pair.first, pair.second});
  const compare::SmallestDistances nearest = compare::smallest_distances(report.topology, positions, report.groups);
  report.vertex_triangle.push_back(nearest.vertex_triangle);
  report.edge_edge.push_back(nearest.edge_edge);
}

void audit_motion(AuditReport& report, std::size_t frame, const std::vector<Vec3>& from, const std::vector<Vec3>& to,
                  std::size_t limit) {
  const compare::MeetingsResult met = compare::meetings(report.topology, from, to, report.groups, limit);
  report.meeting_counts.push_back(static_cast<std::int64_t>(met.count));
  for (const compare::Meeting& meeting : met.meetings) {
    report.meetings.push_back(
        {static_cast<std::int64_t>(frame), static_cast<std::int64_t>(meeting.kind), meeting.first, meeting.second});
    report.meeting_times.push_back(meeting.time);
  }
}

AuditReport audit(nb::handle frames, nb::handle faces, bool motion, nb::handle edges, nb::handle groups,
                  std::size_t limit) {
  const Frames given_frames(frames);
  const auto triangles = given_triangles(faces, "faces");
  Given<compare::Edge> given_edges;
  Given<Index> given_groups;
  if (!edges.is_none()) given_edges = given<compare::Edge>(edges, {"edges", "int32", "(E, 2)", 2, 2});
  if (!groups.is_none()) given_groups = given<Index>(groups, {"groups", "int32", "(V,)", 1});
  if (!groups.is_none() && given_groups.items.size() != given_frames.vertex_count())
    throw compare::InputError("groups: " + std::to_string(given_groups.items.size()) + " came for " +
                              std::to_string(given_frames.vertex_count()) + " vertices");
  check(triangles.items, given_frames.vertex_count(), "faces");
  check(given_edges.items, given_frames.vertex_count(), "edges");
  const nb::gil_scoped_release release;
  AuditReport report;
  report.topology = compare::build_topology(static_cast<Index>(given_frames.vertex_count()), triangles.items,
                                            given_edges.items);
  report.groups.assign(given_groups.items.begin(), given_groups.items.end());
  report.asks_motion = motion;
  std::vector<Vec3> last;
  for (std::size_t frame = 0; frame < given_frames.count(); ++frame) {
    std::vector<Vec3> positions = given_frames[frame];
    audit_state(report, frame, positions, limit);
    if (motion && frame > 0) audit_motion(report, frame - 1, last, positions, limit);
    last = std::move(positions);
    const nb::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  }
  return report;
}

/// Returns the listed intersections and meetings in words, one line each.
std::string describe(const AuditReport& report) {
  std::string text;
  for (const auto& [frame, kind, first, second] : report.intersecting)
    text += "frame " + std::to_string(frame) + ": " +
            compare::describe(
                {static_cast<compare::IntersectionKind>(kind), static_cast<Index>(first), static_cast<Index>(second)},
                report.topology) +
            "\n";
  for (std::size_t i = 0; i < report.meetings.size(); ++i) {
    const auto& [frame, kind, first, second] = report.meetings[i];
    text += "after frame " + std::to_string(frame) + ": " +
            compare::describe({static_cast<compare::MeetingKind>(kind), static_cast<Index>(first),
                               static_cast<Index>(second), report.meeting_times[i]},
                              report.topology) +
            "\n";
  }
  return text;
}

template <auto field, std::size_t columns, class Signature>
void bind_column(nb::class_<AuditReport>& bound, const char* name, const Signature& signature, const char* doc) {
  bound.def_prop_ro(
      name,
      [](nb::handle self) {
        const auto& rows = nb::cast<AuditReport&>(self).*field;
        using Row = typename std::remove_cvref_t<decltype(rows)>::value_type;
        if constexpr (columns == 1)
          return lent<Row, 1>(rows.data(), rows.size(), self);
        else
          return lent<typename Row::value_type, columns>(rows.data(), rows.size(), self);
      },
      signature, doc);
}

void bind_report(nb::module_& module) {
  nb::class_<AuditReport> bound(module, "AuditReport",
                                "What an exact audit found. Read-only arrays, which lie in this object.");
  bind_column<&AuditReport::intersecting, 4>(
      bound, "intersecting", nb::sig("def intersecting(self) -> " OGC_LENT("int64", "(None, 4)")),
      "int64 (n, 4): frame, kind, and the numbers of the two primitives. kind 0: an edge and a triangle; 1: a vertex "
      "and a triangle; 2: two edges. Edges are rows of `edges`. At most `limit` a frame; counts has all.");
  bind_column<&AuditReport::counts, 1>(bound, "counts", nb::sig("def counts(self) -> " OGC_LENT("int64", "(None,)")),
                                       "int64 (F,): number of intersections in each frame");
  bind_column<&AuditReport::vertex_triangle, 1>(
      bound, "distance_vertex_triangle",
      nb::sig("def distance_vertex_triangle(self) -> " OGC_LENT("float64", "(None,)")),
      "float64 (F,): smallest distance of a vertex and a triangle, rounded down; infinite without a pair [m]");
  bind_column<&AuditReport::edge_edge, 1>(
      bound, "distance_edge_edge", nb::sig("def distance_edge_edge(self) -> " OGC_LENT("float64", "(None,)")),
      "float64 (F,): smallest distance of two edges, rounded down; infinite without a pair [m]");
  bind_column<&AuditReport::meetings, 4>(
      bound, "meetings", nb::sig("def meetings(self) -> " OGC_LENT("int64", "(None, 4)")),
      "int64 (m, 4): pairs that share a point on the straight way from a frame to the next: frame, kind (0: vertex and "
      "triangle, 1: two edges), and their numbers. Empty without motion=True.");
  bind_column<&AuditReport::meeting_times, 1>(
      bound, "meeting_times", nb::sig("def meeting_times(self) -> " OGC_LENT("float64", "(None,)")),
      "float64 (m,): time of the first common point, from 0 at the frame to 1 at the next, rounded down");
  bind_column<&AuditReport::meeting_counts, 1>(
      bound, "meeting_counts", nb::sig("def meeting_counts(self) -> " OGC_LENT("int64", "(None,)")),
      "int64 (F − 1,): number of meetings between each frame and the next; empty without motion=True");
  bound
      .def_prop_ro(
          "edges",
          [](nb::handle self) {
            const auto& rows = nb::cast<AuditReport&>(self).topology.edges;
            return lent<Index, 2>(rows.data(), rows.size(), self);
          },
          nb::sig("def edges(self) -> " OGC_LENT("int32", "(None, 2)")), "int32 (E, 2): all edges, by number")
      .def_prop_ro("clean", &AuditReport::is_clean,
                   "whether no frame intersects itself and, with motion=True, nothing met between frames")
      .def_ro("motion", &AuditReport::asks_motion, "whether the motion between frames was audited")
      .def("describe", &describe, "Returns the listed findings in words, one line each.")
      .def("__repr__", [](const AuditReport& report) {
        const auto sum = [](const std::vector<std::int64_t>& counts) {
          return std::to_string(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}));
        };
        return "AuditReport of " + std::to_string(report.counts.size()) + " frames: " + sum(report.counts) +
               " intersections" +
               (report.asks_motion ? ", " + sum(report.meeting_counts) + " meetings between frames" : "");
      });
}

}  // namespace
}  // namespace ogc::python

NB_MODULE(_audit, module) {
  using namespace ogc::python;
  module.doc() = "Exact audits of the OGC Testbed. Use the package ogc_testbed, which has all of its names.";
  translate_errors();
  bind_report(module);
  module.def(
      "audit", &audit, nb::arg("frames").none(), nb::arg("faces").none(), nb::arg("motion") = false,
      nb::arg("edges") = nb::none(), nb::arg("groups") = nb::none(), nb::arg("limit") = 1000,
      nb::sig("def audit(frames: " OGC_GIVEN("float32", "(None, None, 3)") ", faces: " OGC_GIVEN(
          "int32", "(None, 3)") ", motion: bool = False, edges: " OGC_GIVEN("int32", "(None, 2)") " | None = None, "
                                                                                                  "groups: " OGC_GIVEN(
                                                                                                      "int32",
                                                                                                      "(None,)") " |"
                                                                                                                 " N"
                                                                                                                 "on"
                                                                                                                 "e "
                                                                                                                 "= "
                                                                                                                 "No"
                                                                                                                 "ne"
                                                                                                                 ", "
                                                                                                                 "li"
                                                                                                                 "mi"
                                                                                                                 "t:"
                                                                                                                 " i"
                                                                                                                 "nt"
                                                                                                                 " ="
                                                                                                                 " 1"
                                                                                                                 "00"
                                                                                                                 "0)"
                                                                                                                 " -"
                                                                                                                 "> "
                                                                                                                 "Au"
                                                                                                                 "di"
                                                                                                                 "tR"
                                                                                                                 "ep"
                                                                                                                 "or"
                                                                                                                 "t"),
      "Audits the frames of any solver exactly: no answer depends on rounding or on the number of threads.\n\n"
      "frames: float32 or float64 (F, V, 3), the numbers as they are [m]. faces: int32 (T, 3). motion: also "
      "prove the\n"
      "straight way of every vertex from each frame to the next. edges: int32 (E, 2), edges of no triangle. "
      "groups:\n"
      "int32 (V,), pairs whose vertices all have the same number ≥ 0 are left out. Touching counts (method.md "
      "§5.5).\n\n"
      "TypeError: another dtype, shape or order. ValueError: an index out of range, a position that is not "
      "finite.");
}

// Tests collapsed triangles as segments, and collapsed segments as points, because CGAL's intersection tests do not
// allow them.
#include "reference/ipc/intersections.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Segment_3.h>
#include <CGAL/Triangle_3.h>
#include <CGAL/intersections.h>

#include <algorithm>

#include "reference/ipc/broad_phase.hpp"

namespace ogc::reference {
namespace {

using compare::Index;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;

Point point(const Triple<double>& x) { return {x[0], x[1], x[2]}; }

bool segments_meet(const Segment& a, const Segment& b) {
  if (a.is_degenerate()) return b.has_on(a.source());
  if (b.is_degenerate()) return a.has_on(b.source());
  return CGAL::do_intersect(a, b);
}

bool meet(const Segment& segment, const std::array<Point, 3>& corner) {
  if (CGAL::collinear(corner[0], corner[1], corner[2])) {
    for (std::size_t k = 0; k < 3; ++k)
      if (segments_meet(segment, {corner[k], corner[(k + 1) % 3]})) return true;
    return false;
  }
  const Kernel::Triangle_3 triangle(corner[0], corner[1], corner[2]);
  return segment.is_degenerate() ? triangle.has_on(segment.source()) : CGAL::do_intersect(segment, triangle);
}

}  // namespace

std::string describe(const compare::Topology& topology, const EdgeThroughTriangle& meeting,
                     const compare::ElementNames& names) {
  return names.edge(topology.edges[static_cast<std::size_t>(meeting.edge)]) + " and " +
         names.triangle(meeting.triangle, topology.triangles[static_cast<std::size_t>(meeting.triangle)]);
}

std::vector<EdgeThroughTriangle> intersections(const PairMesh& mesh, const State& x) {
  const compare::Topology& topology = mesh.topology;
  const BoxTree triangles(swept_boxes(topology.triangles, x, x, 0));
  const auto at = [&](Index v) { return point(x[static_cast<std::size_t>(v)]); };
  return found_by<EdgeThroughTriangle>(topology.edges.size(), [&](Index edge, std::vector<EdgeThroughTriangle>& found) {
    const compare::Edge& e = topology.edges[static_cast<std::size_t>(edge)];
    triangles.query(swept_box(e, x, x, 0), [&](Index triangle) {
      const compare::Triangle& t = topology.triangles[static_cast<std::size_t>(triangle)];
      if (is_pair(mesh.exclusions, e, t) && meet({at(e[0]), at(e[1])}, {at(t[0]), at(t[1]), at(t[2])}))
        found.push_back({edge, triangle});
    });
  });
}

}  // namespace ogc::reference

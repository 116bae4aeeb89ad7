#include "compare/judge/engine/sweep_question.hpp"

#include <algorithm>
#include <cmath>

#include "compare/judge/engine/exact_sum.hpp"
#include "compare/judge/engine/volume_question.hpp"
#include "compare/stages/bound.hpp"

namespace ogc::compare {

SweepQuestion::SweepQuestion(const SweepCase& test, const Authority& authority)
    : topology_(build_topology(*test.scene)) {
  const Settings& settings = test.scene->settings;
  const Exclusions left_out = exclusions(*test.scene);
  const DetectIn detect{&topology_, left_out, test.previous, static_cast<float>(settings.contact_radius),
                        test.query_radius};
  vertex_facet_ = authority.detect_vertex_facet(detect).exact;
  edge_edge_ = authority.detect_edge_edge(detect).exact;
  rest_ = authority.rest_state({test.scene.get(), &topology_}).exact;
  bound_ = authority
               .bound({&topology_, vertex_facet_.d_min_vertex, edge_edge_.d_min_edge, vertex_facet_.d_min_triangle,
                       static_cast<float>(settings.bounds_relaxation)})
               .exact.bound;
  for (std::size_t v = 0; v < bound_.size(); ++v) {
    bound_[v] = std::min(bound_[v], test.largest_bound[v]);
    old_.push_back(within_bound(test.old[v], test.previous[v], bound_[v]));
  }
  const VolumeQuestion volumes(*test.scene, topology_);
  if (volumes.has_any()) volumes_ = volumes.exact(volumes.at(test.previous), authority);
  in_ = {test.scene.get(),   &topology_,  &rest_,        test.colour, old_,
         test.start,         test.target, test.previous, bound_,      vertex_facet_.contacts,
         edge_edge_.contacts};
  in_.volumes = volumes_;
  in_.segment_colour = test.segment_colour;
  in_.orientation = test.orientation;
  in_.orientation_start = test.orientation_start;
}

Vec3f within_bound(const Vec3f& wish, const Vec3f& previous, float bound) {
  if (obeys_bound(wish, previous, bound)) return wish;
  const Vec3 step{double{wish.x} - previous.x, double{wish.y} - previous.y, double{wish.z} - previous.z};
  const double share = bound / std::hypot(step.x, step.y, step.z);
  Vec3f x{static_cast<float>(previous.x + share * step.x), static_cast<float>(previous.y + share * step.y),
          static_cast<float>(previous.z + share * step.z)};
  while (!obeys_bound(x, previous, bound))
    x = {std::nextafter(x.x, previous.x), std::nextafter(x.y, previous.y), std::nextafter(x.z, previous.z)};
  return x;
}

}  // namespace ogc::compare

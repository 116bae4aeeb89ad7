// Offers the fast path's volume kernels as a plug-in. Right answers prove that the structures of the C interface
// contain all that is needed. The environment variable OGC_BROKEN makes the answers wrong.
#include <algorithm>

#include "compare/stages/volume_depth.hpp"
#include "compare/stages/volume_force.hpp"
#include "tests/experiments/plugins/ours.hpp"

OGC_PLUGIN("our volumes", OGC_HOST_MEMORY)

namespace {

using namespace ogc;
using namespace ogc::compare;
using namespace ogc::tests;

template <std::size_t n>
void copy(const ogc_vec3 (&from)[n], std::array<Vec3f, n>& to) {
  std::transform(from, from + n, to.begin(), point);
}

Topology topology_of(const ogc_topology& t) {
  std::vector<Triangle> triangles;
  for (Index k = 0; k < t.triangle_count; ++k)
    triangles.push_back({t.triangles[k][0], t.triangles[k][1], t.triangles[k][2]});
  return build_topology(t.vertex_count, triangles, {});
}

}  // namespace

int ogc_volume_depth(const ogc_volume_depth_in* in, ogc_volume_depth_out* out) {
  const Topology topology = topology_of(in->topology);
  std::vector<Vec3f> positions, points;
  std::transform(in->positions, in->positions + topology.vertex_count, std::back_inserter(positions), point);
  std::transform(in->points, in->points + in->n, std::back_inserter(points), point);
  std::vector<VolumeContact> contacts =
      ours().volume_depth({&topology, positions, in->contact_radius, points}).contacts;
  std::ranges::reverse(contacts);  // any order is legal
  out->count = static_cast<std::int64_t>(contacts.size());
  if (out->count > out->capacity) return 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const VolumeContact& c = contacts[i];
    const std::int32_t inside = breaks("never inside") ? 0 : c.inside;
    out->contacts[i] = {c.point, inside, c.triangle, static_cast<std::int32_t>(c.face.kind), c.face.index};
    out->numbers[i] = {
        {c.weights[0], c.weights[1], c.weights[2]}, {c.direction.x, c.direction.y, c.direction.z}, c.depth};
  }
  if (breaks("face of no kind") && !contacts.empty()) out->contacts[0].kind = 3;
  return 0;
}

int ogc_volume_force(const ogc_volume_force_in* in, ogc_force_out* out) {
  VolumeForceIn question;
  for (int64_t i = 0; i < in->n; ++i) {
    const ogc_volume_force_case& c = in->cases[i];
    VolumeForceCase asked;
    asked.own = c.own;
    copy(c.vertex, asked.vertex), copy(c.start, asked.start);
    std::copy(c.weights, c.weights + 3, asked.weights.begin());
    std::copy(c.direction, c.direction + 3, asked.direction.begin());
    asked.contact_radius = c.contact_radius, asked.stiffness = c.stiffness;
    asked.friction = breaks("no friction") ? 0 : c.friction, asked.slip_limit = c.slip_limit;
    question.cases.push_back(asked);
  }
  const ForceOut answer = ours().volume_force(question);
  for (std::size_t i = 0; i < answer.force.size(); ++i) {
    out->force[i] = {answer.force[i].x, answer.force[i].y, answer.force[i].z};
    std::ranges::copy(answer.block[i], out->block[i]);
  }
  return 0;
}

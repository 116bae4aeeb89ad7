// Plants faults of forces on stencils: relative errors of 0.1 % and 0.01 %, and faults that few cases reveal.

#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

/// Replaces the force of contacts between two points by a force along the whole relative motion, without removing the
/// motion's normal part.
void keep_normal_motion(const FrictionForceCase& c, Vec3f& force, const std::array<float, 6>& block) {
  if (c.contact.sides != ContactSides::point_point) return;
  const float strength = (block[0] + block[3] + block[5]) / 2, sign = c.contact.own == 0 ? -strength : strength;
  const auto &x = c.contact.vertex, &s = c.start;
  force = {sign * (x[0].x - s[0].x - x[1].x + s[1].x), sign * (x[0].y - s[0].y - x[1].y + s[1].y),
           sign * (x[0].z - s[0].z - x[1].z + s[1].z)};
}

/// Returns whether the gap of a stitch is 0 in single precision.
bool is_closed_by_rounding(const SpringCase& c) {
  const auto& [x, a, b] = c.vertex;
  const auto apart = [&](float Vec3f::*axis) { return x.*axis - a.*axis - c.ratio * (b.*axis - a.*axis); };
  return c.ratio > 0 && apart(&Vec3f::x) == 0 && apart(&Vec3f::y) == 0 && apart(&Vec3f::z) == 0;
}

}  // namespace

std::vector<Fault> force_faults() {
  using Block = std::array<float, 6>;
  return {cases_asked_wrongly("contact_force: radius 0.01 % too large", &Contestant::contact_force,
                              [](ContactForceCase& c) { c.contact_radius *= 1.0001f; }),
          forces_spoiled("friction_force: motion along the normal not removed", &Contestant::friction_force,
                         keep_normal_motion),
          forces_short_of(0.001f, "friction_force: force 0.1 % too small", &Contestant::friction_force),
          forces_short_of(0.001f, "membrane: force 0.1 % too small", &Contestant::membrane),
          forces_short_of(0.001f, "bending: force 0.1 % too small", &Contestant::bending),
          forces_short_of(0.001f, "spring: force 0.1 % too small", &Contestant::spring),
          forces_spoiled("spring: no stiffness across a stretched spring", &Contestant::spring,
                         [](const SpringCase& c, Vec3f&, Block& block) {
                           if (c.vertex[0].y == c.vertex[1].y && c.vertex[0].z == c.vertex[1].z)
                             block[3] = block[5] = 0;
                         }),
          forces_spoiled("spring: no block where rounding closes a stitch with a rest length", &Contestant::spring,
                         [](const SpringCase& c, Vec3f&, Block& block) {
                           if (c.rest_length > 0 && is_closed_by_rounding(c)) block = {};
                         }),
          forces_short_of(0.001f, "tetrahedron: force 0.1 % too small", &Contestant::tetrahedron)};
}

}  // namespace ogc::tests

// Plants faults of rods: small relative errors, errors of single entries, and errors of a whole step with frames.
#include <cmath>

#include "compare/stages/step.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

void conjugate(Quaternion& q) {
  for (std::size_t k = 0; k < 3; ++k) q[k] = -q[k];
}

double size(const std::array<double, 4>& q) { return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]); }

/// Returns the orientation towards which a neighbour pulls: q_f p̄ if it is ahead, q_f p if it is behind.
std::array<double, 4> asked_for(const RodNeighbour& f, bool is_ahead) {
  Quaternion p = f.rest;
  if (is_ahead) conjugate(p);
  const std::array<double, 4> a{f.now[0], f.now[1], f.now[2], f.now[3]}, b{p[0], p[1], p[2], p[3]};
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2],
          a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

/// Sets the old q between the orientations towards which the neighbours pull, so that no sign s is −1.
void never_flipped(OrientationCase& c) {
  std::array<double, 4> between{};
  for (const bool is_ahead : {false, true}) {
    const RodNeighbour& f = is_ahead ? c.ahead : c.behind;
    if (!(f.weight > 0)) continue;
    const std::array<double, 4> t = asked_for(f, is_ahead);
    for (std::size_t k = 0; k < 4; ++k) between[k] += t[k];
  }
  const double length = size(between);
  if (!(length > 1e-3)) return;
  for (std::size_t k = 0; k < 4; ++k) c.orientation[k] = static_cast<float>(between[k] / length);
}

/// Multiplies q by a rotation of 0.01 degrees about an axis.
void turn_slightly(Quaternion& q) {
  const double s = std::sin(8.7e-5), w = std::cos(8.7e-5);
  const std::array<double, 4> a{q[0], q[1], q[2], q[3]};
  q = {static_cast<float>(w * a[0] + s * a[1]), static_cast<float>(w * a[1] - s * a[0]),
       static_cast<float>(w * a[2] + s * a[3]), static_cast<float>(w * a[3] - s * a[2])};
}

Fault of_answer(const std::string& name, void (*spoil)(Quaternion&)) {
  return spoiled("orientation: " + name, &Contestant::orientation, [spoil](const OrientationIn&, OrientationOut& out) {
    for (Quaternion& q : out.orientation) spoil(q);
  });
}

/// Marks a fault that only scenes with rods reveal.
Fault of_rods(Fault fault) {
  fault.generator = "rods";
  return fault;
}

Fault of_rest(const std::string& name, void (*spoil)(const Scene&, RestStateOut&)) {
  return of_rods(spoiled("rest_state: " + name, &Contestant::rest_state,
                         [spoil](const RestStateIn& in, RestStateOut& out) { spoil(*in.scene, out); }));
}

Fault of_step(const std::string& name, void (*spoil)(StepOut&)) {
  return of_rods(spoiled("step: " + name, &Contestant::step, [spoil](const StepIn&, StepOut& out) { spoil(out); }));
}

}  // namespace

std::vector<Fault> rod_faults() {
  return {forces_short_of(0.0001f, "rod: force 0.01 % too small", &Contestant::rod),
          forces_spoiled("rod: block of the stretch alone: a diagonal entry is lost", &Contestant::rod,
                         [](const RodCase&, Vec3f&, std::array<float, 6>& b) { b[5] = 0; }),
          cases_asked_wrongly("orientation: signs never flipped", &Contestant::orientation, never_flipped),
          of_answer("not of unit length",
                    [](Quaternion& q) {
                      for (float& x : q) x *= 1 + 0x1p-20f;
                    }),
          of_answer("turned by 0.01 degrees about the director", turn_slightly),
          of_rest("half the mass of rods",
                  [](const Scene& scene, RestStateOut& out) {
                    for (const Body& body : scene.bodies)
                      for (Index v = body.first_vertex; body.material.rod && v < body.first_vertex + body.vertex_count;
                           ++v)
                        out.mass[static_cast<std::size_t>(v)] *= 0.5f;
                  }),
          of_rest("weights of segments 1 % too large",
                  [](const Scene&, RestStateOut& out) {
                    for (RestSegment& s : out.segments)
                      for (float& w : s.weight) w *= 1.01f;
                  }),
          of_rest("three segments at a vertex bend",
                  [](const Scene&, RestStateOut& out) {
                    for (std::size_t e = 1; e < out.segments.size(); ++e)
                      if (out.segments[e].neighbour[0] < 0) out.segments[e].neighbour[0] = static_cast<Index>(e - 1);
                  }),
          of_step("frames are not turned at the start", [](StepOut& out) { out.turned = out.orientation_start; }),
          of_step("two neighbours share a colour",
                  [](StepOut& out) {
                    for (Index& c : out.segment_colour) c = c < 0 ? c : 0;
                  }),
          of_step("the last frames are not kept", [](StepOut& out) { out.orientation = out.turned; })};
}

}  // namespace ogc::tests

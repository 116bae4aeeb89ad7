// Plants faults of rods: small relative errors, errors of single entries, and errors of a whole step with frames.
#include <cmath>

#include "compare/stages/step.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

/// Rotates an orientation by 0.01 degrees about its director: multiplies it by the quaternion w + s k.
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
          of_answer("not of unit length",
                    [](Quaternion& q) {
                      for (float& x : q) x *= 1 + 0x1p-20f;
                    }),
          of_answer("turned by 0.01 degrees about the director", turn_slightly),
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

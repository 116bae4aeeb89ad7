// Faults of rods in rest_state, initial_guess, sweep and step.
#include <cmath>
#include <utility>

#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

Fault of_rest(const std::string& name, const std::function<void(const Scene&, RestStateOut&)>& spoil) {
  return {"rest_state: " + name, Stage::rest_state,
          [spoil](Contestant& contestant, const Authority&) {
            contestant.rest_state = [right = contestant.rest_state, spoil](const RestStateIn& in) {
              RestStateOut out = right(in);
              spoil(*in.scene, out);
              return out;
            };
          },
          "rods"};
}

void conjugate(Quaternion& q) {
  for (std::size_t k = 0; k < 3; ++k) q[k] = -q[k];
}

Fault of_turn(const std::string& name, const std::function<void(TurnCase&)>& change) {
  return {"initial_guess: " + name, Stage::initial_guess,
          [change](Contestant& contestant, const Authority&) {
            contestant.initial_guess = [right = contestant.initial_guess, change](const InitialGuessIn& in) {
              InitialGuessIn other = in;
              for (TurnCase& c : other.turns) change(c);
              return right(other);
            };
          },
          "turn"};
}

/// What a spoiled sweep reads; the spans are those of the copies.
struct Read {
  SweepIn in;
  Scene scene;
  RestStateOut rest;
  std::vector<Index> segment_colour;
  std::vector<Quaternion> orientation_start;

  explicit Read(const SweepIn& from)
      : in(from),
        scene(*from.scene),
        rest(*from.rest),
        segment_colour(from.segment_colour.begin(), from.segment_colour.end()),
        orientation_start(from.orientation_start.begin(), from.orientation_start.end()) {
    in.scene = &scene, in.rest = &rest;
    in.segment_colour = segment_colour, in.orientation_start = orientation_start;
  }
};

Fault of_sweep(const std::string& name, const std::function<void(Read&)>& change) {
  return {"sweep: " + name, Stage::sweep,
          [change](Contestant& contestant, const Authority&) {
            contestant.sweep = [right = contestant.sweep, change](const SweepIn& in) {
              Read read(in);
              change(read);
              return right(read.in);
            };
          },
          "rods"};
}

Fault of_step(const std::string& name, const std::function<void(StepOut&)>& spoil) {
  return {"step: " + name, Stage::step,
          [spoil](Contestant& contestant, const Authority&) {
            contestant.step = [right = contestant.step, spoil](const StepIn& in) {
              StepOut out = right(in);
              spoil(out);
              return out;
            };
          },
          "rods"};
}

}  // namespace

std::vector<Fault> rod_step_faults() {
  return {of_rest("rest rotation of a segment transposed",
                  [](const Scene&, RestStateOut& out) {
                    for (RestSegment& s : out.segments)
                      for (Quaternion& p : s.relative) conjugate(p);
                  }),
          of_rest("half the mass of rods",
                  [](const Scene& scene, RestStateOut& out) {
                    for (const Body& body : scene.bodies)
                      for (Index v = body.first_vertex; body.material.rod && v < body.first_vertex + body.vertex_count;
                           ++v)
                        out.mass[static_cast<std::size_t>(v)] *= 0.5f;
                  }),
          of_rest("bending over the length of one segment",
                  [](const Scene&, RestStateOut& out) {
                    for (RestSegment& s : out.segments)
                      for (float& w : s.weight) w *= 1.01f;
                  }),
          of_rest("three segments at a vertex bend",
                  [](const Scene&, RestStateOut& out) {
                    for (std::size_t e = 1; e < out.segments.size(); ++e)
                      if (out.segments[e].neighbour[0] < 0) out.segments[e].neighbour[0] = static_cast<Index>(e - 1);
                  }),
          of_turn("frames do not turn", [](TurnCase& c) { c.now = c.before; }),
          of_turn("frames turn back", [](TurnCase& c) { std::swap(c.before, c.now); }),
          of_turn("the frame's own half of the turn: the conjugate", [](TurnCase& c) { conjugate(c.orientation); }),
          of_sweep("neighbours' quaternions of the same sweep are not read",
                   [](Read& read) {
                     for (Index& c : read.segment_colour) c = c < 0 ? c : 0;
                   }),
          of_sweep("rods do not bend",
                   [](Read& read) {
                     for (RestSegment& s : read.rest.segments) s.weight = {};
                   }),
          of_sweep("rods stretch half as stiffly",
                   [](Read& read) {
                     for (Body& body : read.scene.bodies)
                       if (body.material.rod) body.material.rod->stretch *= 0.5;
                   }),
          of_sweep("rods are not damped",
                   [](Read& read) {
                     for (Body& body : read.scene.bodies)
                       if (body.material.rod) body.material.rod->damping = 0;
                   }),
          of_step("frames are not turned at the start", [](StepOut& out) { out.turned = out.orientation_start; }),
          of_step("two neighbours share a colour",
                  [](StepOut& out) {
                    for (Index& c : out.segment_colour) c = c < 0 ? c : 0;
                  }),
          of_step("the last frames are not kept", [](StepOut& out) { out.orientation = out.turned; })};
}

}  // namespace ogc::tests

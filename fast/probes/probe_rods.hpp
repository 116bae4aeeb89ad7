// Lets the judge test rods: force and block of an end of a segment, and the orientation of a segment, each case alone.
#pragma once

#include <vector>

#include "compare/stages/orientation.hpp"
#include "compare/stages/rod.hpp"
#include "fast/kernels/models/damping.hpp"
#include "fast/kernels/models/orientation.hpp"
#include "fast/kernels/models/rod.hpp"
#include "fast/probes/probe_forces.hpp"
#include "fast/stages/kinds/segment.hpp"

namespace ogc::fast {

/// Computes force and block of one end of a segment. Runs once for each case.
struct ProbeRod {
  const SegmentRest* segment;                   ///< by case; its ends are 2 i and 2 i + 1
  const int* own;                               ///< by case: the end that is solved for
  const compare::DampingForm* form;             ///< by case
  const Vec *vertex, *start;                    ///< by case: two ends [m]
  const Quat *orientation, *orientation_start;  ///< by case
  ForceArrays out;                              ///< by case, written

  OGC_HD void operator()(int i) const {
    const SegmentRest rest = segment[i];
    const bool by_vertex = !damps_strain(form[i]);
    const float damping = by_vertex ? 0.0f : rest.damping;
    const Vec apart = vertex[2 * i + 1] - vertex[2 * i], before = start[2 * i + 1] - start[2 * i];
    ForceAndBlock sum, whole;
    add_rod(rest, damping, own[i], apart, orientation[i],
            rod_rest_direction(rest, damping, orientation_start[i], before), sum);
    if (by_vertex) {
      const int v = 2 * i + own[i];
      add_damped_by_vertex(sum, rest.damping, vertex[v] - start[v], whole);
    }
    out.store(i, by_vertex ? whole : sum);
  }
};

/// Answers the stage `rod`.
template <class Backend>
compare::ForceOut probe_rod(Backend& backend, const compare::RodIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ForceOut out;
  const int n = static_cast<int>(in.cases.size());
  std::vector<SegmentRest> segment;
  std::vector<int> own;
  std::vector<compare::DampingForm> form;
  std::vector<Quat> orientation, orientation_start;
  for (int i = 0; i < n; ++i) {
    const compare::RodCase& c = in.cases[static_cast<std::size_t>(i)];
    segment.push_back({{2 * i, 2 * i + 1}, c.rest_length, c.stretch, c.damping});
    own.push_back(c.own);
    form.push_back(c.damping_form);
    orientation.push_back(quat(c.orientation));
    orientation_start.push_back(quat(c.orientation_start));
  }
  backend.for_each(n, ProbeRod{.segment = memory.template in<SegmentRest>(segment),
                               .own = memory.template in<int>(own),
                               .form = memory.template in<compare::DampingForm>(form),
                               .vertex = memory.template in<Vec>(points_of(in.cases, &compare::RodCase::vertex)),
                               .start = memory.template in<Vec>(points_of(in.cases, &compare::RodCase::start)),
                               .orientation = memory.template in<Quat>(orientation),
                               .orientation_start = memory.template in<Quat>(orientation_start),
                               .out = force_arrays(memory, out, in.cases.size())});
  memory.fetch();
  return out;
}

/// Holds the data of a neighbour that a segment's update reads.
struct SeenNeighbour {
  NeighbourRest rest;
  Quat now, start;  ///< quaternion of the neighbour: now, and at the start of the step
};

/// Computes the orientation of a segment between its neighbours. Runs once for each case.
struct ProbeOrientation {
  const SegmentRest* segment;                   ///< by case; its ends are 2 i and 2 i + 1
  const SeenNeighbour* neighbour;               ///< by case: behind, ahead
  const Vec *vertex, *start;                    ///< by case: two ends [m]
  const Quat *orientation, *orientation_start;  ///< by case
  Quat* out;                                    ///< by case, written

  OGC_HD void operator()(int i) const {
    const SegmentRest rest = segment[i];
    const Quat old = orientation[i], own_start = orientation_start[i];
    Quat b{0.0f, 0.0f, 0.0f, 0.0f};
    for (int k = 0; k < 2; ++k) {
      const SeenNeighbour seen = neighbour[2 * i + k];
      add_neighbour(seen.rest, k == 1, rest.damping, seen.now, seen.start, own_start, old, b);
    }
    const Vec before = start[2 * i + 1] - start[2 * i];
    out[i] = rod_orientation(rest.stretch, vertex[2 * i + 1] - vertex[2 * i],
                             rod_rest_direction(rest, rest.damping, own_start, before), b, old);
  }
};

/// Answers the stage `orientation`.
template <class Backend>
compare::OrientationOut probe_orientation(Backend& backend, const compare::OrientationIn& in) {
  ProbeMemory<Backend> memory(backend);
  const int n = static_cast<int>(in.cases.size());
  std::vector<SegmentRest> segment;
  std::vector<SeenNeighbour> neighbour;
  std::vector<Quat> orientation, orientation_start, found;
  for (int i = 0; i < n; ++i) {
    const compare::OrientationCase& c = in.cases[static_cast<std::size_t>(i)];
    segment.push_back({{2 * i, 2 * i + 1}, c.rest_length, c.stretch, c.damping});
    for (const compare::RodNeighbour& f : {c.behind, c.ahead})
      neighbour.push_back({{f.weight, quat(f.rest)}, quat(f.now), quat(f.start)});
    orientation.push_back(quat(c.orientation));
    orientation_start.push_back(quat(c.orientation_start));
  }
  backend.for_each(
      n, ProbeOrientation{.segment = memory.template in<SegmentRest>(segment),
                          .neighbour = memory.template in<SeenNeighbour>(neighbour),
                          .vertex = memory.template in<Vec>(points_of(in.cases, &compare::OrientationCase::vertex)),
                          .start = memory.template in<Vec>(points_of(in.cases, &compare::OrientationCase::start)),
                          .orientation = memory.template in<Quat>(orientation),
                          .orientation_start = memory.template in<Quat>(orientation_start),
                          .out = memory.template out<Quat>(found, in.cases.size())});
  memory.fetch();
  compare::OrientationOut out;
  for (const Quat& q : found) out.orientation.push_back({q.x, q.y, q.z, q.w});
  return out;
}

}  // namespace ogc::fast

// Lets the judge test planes: a detection whose bounds are planes, and truncation by balls and half-spaces.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/stages/plane.hpp"
#include "compare/stages/truncate.hpp"
#include "fast/kernels/held.hpp"
#include "fast/probes/download.hpp"
#include "fast/probes/probe_memory.hpp"

namespace ogc::fast {

/// Answers the stage `plane`. `list_capacity`: number of contacts for which the lists have room at first; 0: estimated
/// from the size of the mesh.
template <class Backend>
compare::PlaneOut probe_plane(Backend& backend, const compare::PlaneIn& in, int list_capacity = 0) {
  const auto bounds = in.displacement.empty() ? compare::Bounds::planes : compare::Bounds::dat;
  Detection<Backend> detection(backend, *in.topology, in.exclusions, list_capacity, bounds,
                               {in.is_fixed.begin(), in.is_fixed.end()});
  ProbeMemory<Backend> memory(backend);
  const std::vector<compare::Vec3f> displacement(in.displacement.begin(), in.displacement.end());
  if (!displacement.empty()) detection.divide_planes_by(memory.template in<Vec>(displacement));
  const Vec* positions = memory.template in<Vec>(std::vector<compare::Vec3f>(in.positions.begin(), in.positions.end()));
  const float* query_radius = memory.template in<float>(std::vector<float>{in.query_radius});
  detection.rebuild(positions);
  do {
    // Which pairs are contacts does not matter here, so r is set to the query radius.
    detection.detect(positions, in.query_radius, query_radius, in.bounds_relaxation);
    backend.synchronize();
  } while (detection.grow());
  return {detection.download_planes(), download_items(backend, detection.view().bound, in.positions.size())};
}

/// Truncates a proposal to its region. Runs once for each case.
struct ProbeRegion {
  FeasibleRegions balls;    ///< by case
  const HalfSpace* planes;  ///< of all cases
  const int* offsets;       ///< by case, and the end
  const Vec* current;       ///< by case [m], in its region
  const Symmetric3* block;  ///< by case, for free vertices [N/m]
  const std::uint8_t* is_prescribed;
  const Vec* position;  ///< proposals by case [m]
  Vec* result;          ///< by case [m], written
  std::uint8_t* cut;    ///< by case: 1 if the proposal was changed, written

  OGC_HD void operator()(int i) const {
    const FeasibleRegion region{balls.ball(i), planes + offsets[i], offsets[i + 1] - offsets[i]};
    // H is positive definite. If rounding makes a pivot too small, BlockMetric returns n, the shortest move into a
    // half-space.
    const Truncated kept = is_prescribed[i] != 0 ? held_on_path(region, current[i], position[i])
                                                 : held(region, current[i], position[i], BlockMetric{block[i], 1.0F});
    result[i] = kept.position;
    cut[i] = kept.cut;
  }
};

template <class Backend>
compare::TruncateOut probe_regions(Backend& backend, const compare::TruncateIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::TruncateOut out;
  const std::size_t n = in.position.size();
  const compare::HalfSpacesIn& all = in.half_spaces;
  const ProbeRegion probe{
      .balls = {memory.template in<Vec>(in.previous), memory.template in<float>(in.bound)},
      .planes = memory.template in<HalfSpace>(all.items),
      .offsets = memory.template in<int>(all.offsets),
      .current = memory.template in<Vec>(all.current),
      .block = memory.template in<Symmetric3>(all.block),
      .is_prescribed = memory.template in<std::uint8_t>(all.is_prescribed),
      .position = memory.template in<Vec>(in.position),
      .result = memory.template out<Vec>(out.position, n),
      .cut = memory.template out<std::uint8_t>(out.cut, n),
  };
  backend.for_each(static_cast<int>(n), probe);
  memory.fetch();
  return out;
}

}  // namespace ogc::fast

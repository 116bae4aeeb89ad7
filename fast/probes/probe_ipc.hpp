// The judge's way in to the kernels of an IPC solver: times of impact and barriers, each case alone.
#pragma once

#include "compare/stages/barrier.hpp"
#include "compare/stages/ccd.hpp"
#include "fast/kernels/ipc/barrier.hpp"
#include "fast/kernels/ipc/ccd.hpp"
#include "fast/probes/probe_memory.hpp"

namespace ogc::fast {

/// Each motion alone.
struct ProbeCcd {
  const MovingFaces* faces;  ///< by case
  float* time;               ///< by case, written

  OGC_HD void operator()(int i) const { time[i] = impact_time(faces[i]); }
};

/// The stage `ccd`.
template <class Backend>
compare::CcdOut probe_ccd(Backend& backend, const compare::CcdIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::CcdOut out;
  const std::size_t n = in.cases.size();
  backend.for_each(static_cast<int>(n), ProbeCcd{.faces = memory.template in<MovingFaces>(in.cases),
                                                 .time = memory.template out<float>(out.time, n)});
  memory.fetch();
  return out;
}

/// As compare::BarrierCase stores it.
struct BarrierAt {
  float squared_distance, activation_distance, thickness;  ///< D [m²], d̂, ξ [m]
};

/// Each distance alone.
struct ProbeBarrier {
  const BarrierAt* at;                ///< by case
  float *energy, *slope, *curvature;  ///< by case, written

  OGC_HD void operator()(int i) const {
    const BarrierValue b = ipc_barrier(at[i].squared_distance, at[i].activation_distance, at[i].thickness);
    energy[i] = b.energy;
    slope[i] = b.slope;
    curvature[i] = b.curvature;
  }
};

/// The stage `barrier`.
template <class Backend>
compare::BarrierOut probe_barrier(Backend& backend, const compare::BarrierIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::BarrierOut out;
  const std::size_t n = in.cases.size();
  backend.for_each(static_cast<int>(n), ProbeBarrier{.at = memory.template in<BarrierAt>(in.cases),
                                                     .energy = memory.template out<float>(out.energy, n),
                                                     .slope = memory.template out<float>(out.slope, n),
                                                     .curvature = memory.template out<float>(out.curvature, n)});
  memory.fetch();
  return out;
}

}  // namespace ogc::fast

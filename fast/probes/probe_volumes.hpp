// The judge's way in to contacts with volumes: each case alone, by the functions that the sweep uses.
#pragma once

#include <vector>

#include "compare/stages/volume_force.hpp"
#include "fast/kernels/volume_force.hpp"
#include "fast/probes/probe_forces.hpp"

namespace ogc::fast {

/// Each contact with a volume alone.
struct ProbeVolumeForce {
  const VolumeContact* contact;              ///< by case
  const Vec *vertex, *start;                 ///< by case: the point and three corners [m]
  const int* own;                            ///< by case: the role asked about
  const float *contact_radius, *slip_limit;  ///< by case: r, ε_v h [m]
  ForceArrays out;                           ///< by case, written

  OGC_HD void operator()(int i) const {
    ForceAndBlock sum;
    add_volume_contact(contact[i], vertex + 4 * i, start + 4 * i, own[i], contact_radius[i], slip_limit[i], sum);
    out.store(i, sum);
  }
};

/// The stage `volume_force`.
template <class Backend>
compare::ForceOut probe_volume_force(Backend& backend, const compare::VolumeForceIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ForceOut out;
  std::vector<VolumeContact> contacts;
  std::vector<int> own;
  std::vector<float> contact_radius, slip_limit;
  for (const compare::VolumeForceCase& c : in.cases) {
    const auto& [w0, w1, w2] = c.weights;
    contacts.push_back({{w0, w1, w2}, {c.direction[0], c.direction[1], c.direction[2]}, c.stiffness, c.friction});
    own.push_back(c.own);
    contact_radius.push_back(c.contact_radius);
    slip_limit.push_back(c.slip_limit);
  }
  const std::size_t n = in.cases.size();
  backend.for_each(static_cast<int>(n),
                   ProbeVolumeForce{.contact = memory.template in<VolumeContact>(contacts),
                                    .vertex = memory.template in<Vec>(
                                        points_of(in.cases, &compare::VolumeForceCase::vertex)),
                                    .start = memory.template in<Vec>(
                                        points_of(in.cases, &compare::VolumeForceCase::start)),
                                    .own = memory.template in<int>(own),
                                    .contact_radius = memory.template in<float>(contact_radius),
                                    .slip_limit = memory.template in<float>(slip_limit),
                                    .out = force_arrays(memory, out, n)});
  memory.fetch();
  return out;
}

}  // namespace ogc::fast

// Contacts with volumes in the sum over the stencils of a vertex. A driven volume stands still while a step is solved,
// so each free vertex feels its own contacts alone.
#pragma once

#include "fast/kernels/metrics.hpp"
#include "fast/kernels/sweep_solids.hpp"
#include "fast/kernels/volume_force.hpp"

namespace ogc::fast {

/// A contact of a free vertex, which is the point: the vertices of the triangle, which are prescribed or fixed, and
/// what the detection froze.
struct alignas(16) VolumeIncidence {
  int corner[3] = {0, 0, 0};  ///< numbers in the mesh
  VolumeContact contact;
};

/// Contact k of a vertex.
struct LoadVolumeContact {
  const VolumeIncidence* first;  ///< of the vertex's row

  OGC_HD VolumeIncidence operator()(int k) const { return first[k]; }
};
/// Adds a contact.
struct AddVolumeContact {
  const SweepView& view;
  Vec own, own_start;  ///< x and xᵗ of the vertex [m]

  /// Corners are read as vertices of no colour are: where the sweep writes.
  OGC_HD void operator()(const VolumeIncidence& incidence, ForceAndBlock& sum) const {
    Vec x[4] = {own}, start[4] = {own_start};
    for (int k = 0; k < 3; ++k) {
      x[k + 1] = view.read(~incidence.corner[k]);
      start[k + 1] = view.start[incidence.corner[k]];
    }
    add_volume_contact(incidence.contact, x, start, 0, view.contact_radius, view.friction_limit, sum);
  }
};

/// The contacts of a vertex as a part of its sum.
OGC_HD inline Part<LoadVolumeContact, AddVolumeContact> volume_part(const SweepView& view, int slot, int v,
                                                                    const Vec& own) {
  const VolumeStream& volumes = view.volumes;
  return part(volumes.counts[slot], LoadVolumeContact{volumes.contacts + slot * volumes.capacity},
              AddVolumeContact{view, own, view.start[v]});
}

/// From this share of r on a vertex is deep inside a volume (compare/volumes.md, The step).
inline constexpr float deep_share = 0.5F;

/// Whether x, of the vertex of a slot, lies deep inside a volume by what one of its contacts froze: φ < −r/2. Corners
/// stand still while others are solved.
OGC_HD inline bool lies_deep_in_volume(const SweepView& view, int slot, const Vec& x) {
  const VolumeStream& volumes = view.volumes;
  if (volumes.counts == nullptr) return false;
  const float deep = -deep_share * view.contact_radius;
  for (int k = 0; k < volumes.counts[slot]; ++k) {
    const VolumeIncidence& incidence = volumes.contacts[slot * volumes.capacity + k];
    Vec at[4] = {x};
    for (int i = 0; i < 3; ++i) at[i + 1] = view.read(~incidence.corner[i]);
    if (dot(incidence.contact.normal, volume_separation(incidence.contact, at)) < deep) return true;
  }
  return false;
}

/// A sum over the stencils of a vertex that may have contacts with volumes.
struct KnowsVolumes {
  /// As lies_deep_in_volume.
  OGC_HD static bool lies_deep(const SweepView& view, int slot, const Vec& x) {
    return lies_deep_in_volume(view, slot, x);
  }
};

/// As GatherEveryModel, with volumes as a part between springs and contacts.
struct GatherVolumes : KnowsVolumes {
  static constexpr int parts = GatherEveryModel::parts + 1;  ///< of the sum

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    const OwnVertex at{own, own - view.start[vertex.vertex]};
    return every_model_sum(view, slot, vertex, at, team, volume_part(view, slot, vertex.vertex, own));
  }
};

/// As GatherEverything, with volumes as a part between tetrahedra and contacts.
struct GatherEverythingAndVolumes : KnowsVolumes {
  static constexpr int parts = GatherEverything::parts + 1;  ///< of the sum

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    const OwnVertex at{own, own - view.start[vertex.vertex]};
    const AddAnyTetrahedron add{view, view.solids[vertex.body], view.models[vertex.body], at};
    return every_model_sum(view, slot, vertex, at, team, tetrahedron_part(view, slot, add),
                           volume_part(view, slot, vertex.vertex, own));
  }
};

/// Energy of the contacts of a slot, in double.
struct VolumeTerm {
  VolumeStream volumes;
  const SweepVertex* vertices;  ///< by slot
  const Vec* position;          ///< by vertex [m]
  float contact_radius;         ///< r [m]

  OGC_HD void operator()(int slot, double* sum) const {
    for (int k = 0; k < volumes.counts[slot]; ++k) {
      const VolumeIncidence& incidence = volumes.contacts[slot * volumes.capacity + k];
      const Vec x[4] = {position[vertices[slot].vertex], position[incidence.corner[0]], position[incidence.corner[1]],
                        position[incidence.corner[2]]};
      const double depth = static_cast<double>(contact_radius) -
                           dot(incidence.contact.normal, volume_separation(incidence.contact, x));
      if (depth > 0) sum[sum_vertex_facet] += 0.5 * incidence.contact.stiffness * depth * depth;
    }
  }
};

}  // namespace ogc::fast

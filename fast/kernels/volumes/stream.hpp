// Adds contacts with volumes to the sum over the stencils of a vertex: as the point, and, if volumes are free, as a
// corner of a triangle that others press. A driven volume stands still while a step is solved.
#pragma once

#include "compare/stages/volume_depth.hpp"
#include "fast/kernels/metrics.hpp"
#include "fast/kernels/sweep_view.hpp"
#include "fast/kernels/team.hpp"
#include "fast/kernels/volume_force.hpp"

namespace ogc::fast {

/// A contact: the point, the vertices of the triangle, and what the detection froze.
struct alignas(16) VolumeIncidence {
  int corner[3] = {0, 0, 0};  ///< numbers in the mesh
  VolumeContact contact;
  int point = 0;  ///< number in the mesh

  /// Returns the vertex of a role: the point (0), a corner (1, 2, 3).
  OGC_HD int vertex(int role) const { return role == 0 ? point : corner[role - 1]; }
};

/// A contact as one of its vertices sees it.
struct SeenVolumeContact {
  VolumeContact contact;
  int index[4];  ///< by role, encoded as in sweep_view.hpp
  int own = 0;   ///< the vertex' own role
  int together;  ///< as in add_volume_contact
};

/// Returns a contact as the vertex of role `own` sees it. If all volumes are driven `colour` is null: corners have no
/// colour then.
OGC_HD inline SeenVolumeContact seen_from(const VolumeIncidence& incidence, int own, const int* colour) {
  SeenVolumeContact seen;
  seen.contact = incidence.contact;
  seen.own = own;
  seen.together = 0;
  const int own_colour = colour != nullptr ? colour[incidence.vertex(own)] : 0;
  for (int k = 0; k < 4; ++k) {
    const int v = incidence.vertex(k), its_colour = colour != nullptr ? colour[v] : -1;
    seen.index[k] = its_colour < own_colour ? ~v : v;
    if (k != own && its_colour == own_colour) seen.together |= 1 << k;
  }
  return seen;
}

/// Loads contact k of a vertex: first those in which it is the point, then those in which it is a corner.
struct LoadVolumeContact {
  VolumeStream volumes;
  int slot, points;  ///< `points`: number of the former

  OGC_HD SeenVolumeContact operator()(int k) const {
    if (k < points) return seen_from(volumes.contacts[slot * volumes.capacity + k], 0, volumes.colour);
    const int code = volumes.corner_codes[slot * volumes.corner_capacity + k - points];
    return seen_from(volumes.contacts[code >> 2], code & 3, volumes.colour);
  }
};
/// Adds a contact.
struct AddVolumeContact {
  const SweepShared& view;
  Vec own, own_start;  ///< x and xᵗ of the vertex [m]

  OGC_HD void operator()(const SeenVolumeContact& seen, ForceAndBlock& sum) const {
    Vec x[4], start[4];
    for (int k = 0; k < 4; ++k) {
      x[k] = k == seen.own ? own : view.read(seen.index[k]);
      start[k] = k == seen.own ? own_start : view.start[decoded(seen.index[k])];
    }
    add_volume_contact(seen.contact, x, start, seen.own, view.contact_radius, view.friction_limit, sum, seen.together);
  }
};

/// The contacts with volumes of a scene, which may have none.
struct VolumeContacts {
  template <class All>
  static constexpr unsigned gives = asks_volumes | asks_any_model;

  OGC_HD static Part<LoadVolumeContact, AddVolumeContact> part_of(const SweepShared& view, int slot,
                                                                  const SweepVertex& vertex, const OwnVertex& own) {
    const VolumeStream& volumes = view.volumes;
    const int points = volumes.counts != nullptr ? volumes.counts[slot] : 0,
              corners = volumes.corner_counts != nullptr ? volumes.corner_counts[slot] : 0;
    return {points + corners, {volumes, slot, points}, {view, own.position, view.start[vertex.vertex]}};
  }
};

/// A vertex is deep inside a volume from this share of r on (compare/volumes.md, The step).
inline constexpr float deep_share = 0.5F;

/// Returns whether a contact's point lies deep inside a volume by what the contact froze: φ < −r/2. `x`: by role [m].
OGC_HD inline bool is_deep(const VolumeContact& contact, const Vec* x, float contact_radius) {
  return dot(contact.normal, volume_separation(contact, x)) < -deep_share * contact_radius;
}

/// Whether x, of the vertex of a slot, lies deep inside a driven volume, whose corners stand still while others are
/// solved. Where volumes are free, CountDeepInside asks after the iteration.
OGC_HD inline bool lies_deep_in_volume(const SweepShared& view, int slot, const Vec& x) {
  const VolumeStream& volumes = view.volumes;
  if (volumes.counts == nullptr || volumes.colour != nullptr) return false;
  for (int k = 0; k < volumes.counts[slot]; ++k) {
    const VolumeIncidence& incidence = volumes.contacts[slot * volumes.capacity + k];
    Vec at[4] = {x};
    for (int i = 0; i < 3; ++i) at[i + 1] = view.read(~incidence.corner[i]);
    if (is_deep(incidence.contact, at, view.contact_radius)) return true;
  }
  return false;
}

/// Holds the positions of a contact's vertices by role.
struct VolumePositions {
  Vec x[4];  ///< [m]

  OGC_HD VolumePositions(const VolumeIncidence& incidence, const Vec* position) {
    for (int k = 0; k < 4; ++k) x[k] = position[incidence.vertex(k)];
  }
};

/// Counts vertices deep inside free volumes after an iteration. Index over rows.
struct CountDeepInside {
  VolumeStream volumes;
  const Vec* position;   ///< by vertex [m]
  float contact_radius;  ///< r [m]
  const int* turn;       ///< as in SweepView
  int iteration;
  StepControl* control;  ///< counts are added there

  OGC_HD void operator()(int row) const {
    if (turn != nullptr && *turn != iteration) return;
    for (int k = 0; k < volumes.counts[row]; ++k) {
      const VolumeIncidence& incidence = volumes.contacts[row * volumes.capacity + k];
      const VolumePositions at(incidence, position);
      if (is_deep(incidence.contact, at.x, contact_radius)) return control->count_deep_inside();
    }
  }
};

/// Adds the energy of the contacts of a row, in double.
struct VolumeTerm {
  VolumeStream volumes;
  const Vec* position;   ///< by vertex [m]
  float contact_radius;  ///< r [m]

  OGC_HD void operator()(int row, double* sum) const {
    for (int k = 0; k < volumes.counts[row]; ++k) {
      const VolumeIncidence& incidence = volumes.contacts[row * volumes.capacity + k];
      const VolumePositions at(incidence, position);
      const double depth = static_cast<double>(contact_radius) -
                           dot(incidence.contact.normal, volume_separation(incidence.contact, at.x));
      if (depth > 0) sum[sum_vertex_facet] += 0.5 * incidence.contact.stiffness * depth * depth;
    }
  }
};

}  // namespace ogc::fast

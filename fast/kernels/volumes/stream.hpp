// Adds contacts with volumes to the sum over the stencils of a vertex. The vertex may be the point of a contact. If
// volumes are free, it may also be a corner of a touched triangle. A driven volume does not move while a step is
// solved.
#pragma once

#include "compare/stages/volume_depth.hpp"
#include "fast/kernels/metrics.hpp"
#include "fast/kernels/sweep_view.hpp"
#include "fast/kernels/team.hpp"
#include "fast/kernels/volume_force.hpp"

namespace ogc::fast {

/// Holds the vertices of a contact (the point and a triangle's corners), and the data that do not change until the next
/// detection.
struct alignas(16) VolumeIncidence {
  int corner[3] = {0, 0, 0};  ///< vertices of the triangle
  VolumeContact contact;
  int point = 0;  ///< vertex that touches the triangle

  /// Returns the vertex with a role: the point (0) or a corner of the triangle (1, 2, 3).
  OGC_HD int vertex(int role) const { return role == 0 ? point : corner[role - 1]; }
};

/// Holds a contact as one of its vertices sees it.
struct SeenVolumeContact {
  VolumeContact contact;
  int index[4];  ///< vertices by role, encoded as in sweep_view.hpp
  int own = 0;   ///< role of the vertex
  int together;  ///< bit k: the vertex of role k has the same colour
};

/// Returns a contact for the update of its vertex with role `own`. `colour` is null if all volumes are driven: then all
/// vertices but `own` are read at their new positions.
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

/// Loads contact k of a vertex. The vertex is the point of the first `points` contacts, and a corner in the other
/// contacts.
struct LoadVolumeContact {
  VolumeStream volumes;
  int slot, points;

  OGC_HD SeenVolumeContact operator()(int k) const {
    if (k < points) return seen_from(volumes.contacts[slot * volumes.capacity + k], 0, volumes.colour);
    const int code = volumes.corner_codes[slot * volumes.corner_capacity + k - points];
    return seen_from(volumes.contacts[code >> 2], code & 3, volumes.colour);
  }
};
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

/// Makes the part of a vertex's sum that adds contacts with volumes; empty if the scene has no volumes.
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

/// A vertex is deep inside a volume if its depth exceeds this share of r (compare/volumes.md, The step).
inline constexpr float deep_share = 0.5F;

/// Returns whether the point of a frozen contact lies deep inside a volume: φ < −r/2. `x`: by role [m].
OGC_HD inline bool is_deep(const VolumeContact& contact, const Vec* x, float contact_radius) {
  return dot(contact.normal, volume_separation(contact, x)) < -deep_share * contact_radius;
}

/// Returns whether x, the position of the slot's vertex, lies deep inside a driven volume, whose corners do not move.
/// Returns false if volumes are free: then CountDeepInside tests the vertices after the iteration.
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

/// Counts vertices deep inside free volumes after an iteration. Runs once for each row.
struct CountDeepInside {
  VolumeStream volumes;
  const Vec* position;   ///< by vertex [m]
  float contact_radius;  ///< r [m]
  const int* turn;       ///< as in SweepShared
  int iteration;
  StepControl* control;  ///< on the backend; counts are added

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

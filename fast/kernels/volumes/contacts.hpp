// Finds contacts with volumes at each detection; they are frozen until the next one (§3.9, method.md §9). An asker is a
// vertex that is tested against volumes. Each asker has a row. The first rows belong to the slots of the sweep (asker
// −1 if the slot's vertex is not tested), the others to prescribed vertices.
//
//   AskVolumes          for each row and each part of triangles: finds whether the vertex is inside, nearer than r, or
//                       far. Stores this answer with the nearest facet, where the next search begins. For `far` it may
//                       also store a ball of far points: a vertex in it is not tested until the volumes move
//   ListVolumeContacts  for each row: lists its contacts, part by part, in a row of fixed length. If a row is too
//                       short, the step is repeated with longer rows (fast/stages/lists.hpp)
//   FillCorners         for each row, if volumes are free: adds its contacts to the rows of their triangles' corners
//   SortCorners         for each slot: sorts its row of corners, so that the order of filling has no effect
#pragma once

#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/volume_depth.hpp"
#include "fast/kernels/volumes/solids.hpp"
#include "fast/kernels/volumes/stream.hpp"

namespace ogc::fast {

/// Packs the nearest facet of a part and the VolumeSide of a point into one integer, the *answer*: facet · 4 + side.
OGC_HD inline int answer_of(const NearestFacet& nearest) { return nearest.facet << 2 | static_cast<int>(nearest.side); }
/// Returns the facet and the side that answer_of packed.
OGC_HD inline NearestFacet nearest_in(int answer) { return {answer >> 2, static_cast<VolumeSide>(answer & 3)}; }

/// Copies positions into aligned vectors, for queries of free volumes. Runs once for each vertex.
struct PlaceVolumes {
  const Vec* position;  ///< x at the detection, by vertex [m]
  PaddedVec* padded;    ///< written

  OGC_HD void operator()(int v) const { padded[v] = PaddedVec(position[v]); }
};

/// Discards all known balls of far points (ClearBall), because driven volumes have moved. Runs once for each pair of a
/// part and a row.
struct ForgetClearBalls {
  ClearBall* clear;  ///< by pair of part and row, as in AskVolumes

  OGC_HD void operator()(int i) const { clear[i].radius = ClearBall::unasked; }
};

/// Finds on which side of a part each asker lies, for all parts that consist of triangles. Runs once for each pair of a
/// part and a row, part after part, so that neighbouring threads search the same tree.
struct AskVolumes {
  VolumeView volume;  ///< with refitted trees
  const int* askers;  ///< by row: the vertex, or −1
  int rows;
  const Vec* position;         ///< x at the detection, by vertex [m]
  const StepControl* control;  ///< if it is not active nothing is searched
  /// by pair of part and row (index part · rows + row): answer of the last detection, or an answer with any facet of
  /// the part; replaced by the new answer
  int* answers;
  /// by pair of part and row: ball of far points; null if volumes are free, because they move in every iteration
  ClearBall* clear;

  OGC_HD void operator()(int i) const {
    if (control->active == 0) return;
    const int part = i / rows, v = askers[i - part * rows];
    if (v < 0 || volume.parts[part].is_solid()) return;
    // Seeks a ball only at the second test, because many steps test a vertex only once. If there is no ball, later
    // tests seek none.
    const ClearBall old = clear != nullptr ? clear[i] : ClearBall{};
    if (old.holds(position[v])) return;
    const bool seeks = old.radius != ClearBall::unasked && old.radius != ClearBall::refused;
    ClearBall ball{{}, ClearBall::asked};
    const VolumeQuestion question(volume, position[v]);
    answers[i] = answer_of(question.nearest_of(part, answers[i] >> 2, seeks ? &ball : nullptr));
    if (clear != nullptr && old.radius != ClearBall::refused) clear[i] = ball;
  }
};

/// Lists each asker's contacts. A facet without area has no direction and gives no contact. `has_solids`: some parts
/// consist of tetrahedra. A search of such a part uses no earlier answer, so that a run that continues from a stored
/// state gets the same bits. Runs once for each row.
template <bool has_solids>
struct ListVolumeContacts {
  VolumeView volume;
  const int* askers;  ///< as in AskVolumes
  int rows;
  const Vec* position;         ///< x at the detection, by vertex [m]
  const StepControl* control;  ///< if it is not active the old rows stay
  const int* answers;          ///< by pair of part and row, from AskVolumes
  ContactTables tables;        ///< k and μ by pair of bodies
  int capacity;                ///< contacts that fit in a row
  int* counts;                 ///< by row, at most `capacity`, written
  VolumeIncidence* stream;     ///< row by row, written
  FoundVolumeContact* found;   ///< the contacts of `stream` before conversion, written
  int* unresolved;             ///< by row: number of sheets without a way (solids.hpp); written if there are solids
  int* longest;                ///< raised to the number of contacts of the longest row
  int* overflow;               ///< set if a row has more contacts than `capacity`

  OGC_HD void operator()(int row) const {
    if (control->active == 0) return;
    const int v = askers[row];
    int count = 0, lost = 0;
    if (v >= 0) {
      const auto add = [&](const FoundVolumeContact& contact) {
        if (!is_finite(contact.direction)) return;
        if (count < capacity) put(row * capacity + count, v, contact);
        ++count;
      };
      const VolumeQuestion question(volume, position[v]);
      for (int part = 0; part < volume.part_count; ++part) {
        if constexpr (has_solids) {
          if (volume.parts[part].is_solid()) {
            lost += SolidQuestion(volume, position[v], v).visit_contacts(part, -1, add).unresolved;
            continue;
          }
        }
        question.visit_contacts(part, nearest_in(answers[part * rows + row]), add);
      }
    }
    counts[row] = count < capacity ? count : capacity;
    if constexpr (has_solids) unresolved[row] = lost;
    if (count <= capacity) return;
    atomic_max(longest, count);
    atomic_max(overflow, 1);
  }

 private:
  OGC_HD void put(int place, int v, const FoundVolumeContact& contact) const {
    const Facet& facet = volume.surface.facets[contact.triangle];
    const ContactIncidence material = meeting(tables, v, facet.corner[0]);
    VolumeIncidence incidence;
    for (int k = 0; k < 3; ++k) {
      incidence.corner[k] = facet.corner[k];
      incidence.contact.weights[k] = contact.weights[k];
    }
    incidence.point = v;
    incidence.contact.normal = contact.direction;
    incidence.contact.stiffness = material.stiffness;
    incidence.contact.friction = material.friction;
    stream[place] = incidence;
    found[place] = contact;
  }
};

/// Holds for each slot the contacts in which the slot's vertex is a corner of the triangle.
struct CornerRows {
  const int* slot_of;  ///< by vertex; −1: not free
  int capacity;        ///< contacts that fit in a row
  int* counts;         ///< by slot
  int* codes;          ///< row by row, packed as VolumeStream::corner_codes
};

/// Empties the rows of corners before FillCorners. Runs once for each slot.
struct ForgetCorners {
  const StepControl* control;  ///< if it is not active the old rows stay
  CornerRows corners;

  OGC_HD void operator()(int slot) const {
    if (control->active != 0) corners.counts[slot] = 0;
  }
};

/// Adds each contact to the rows of those corners of its triangle that are free and have a weight other than 0. Runs
/// once for each row.
struct FillCorners {
  const StepControl* control;       ///< as in ForgetCorners
  const int* counts;                ///< by row, from ListVolumeContacts
  const VolumeIncidence* contacts;  ///< row by row, from ListVolumeContacts
  int capacity;                     ///< contacts that fit in a row of `contacts`
  CornerRows corners;

  OGC_HD void operator()(int row) const {
    if (control->active == 0) return;
    for (int place = row * capacity; place < row * capacity + counts[row]; ++place) {
      const VolumeIncidence& incidence = contacts[place];
      for (int role = 1; role < 4; ++role) {
        const int slot = corners.slot_of[incidence.vertex(role)];
        if (slot < 0 || incidence.contact.weight(role) == 0) continue;
        const int k = atomic_add(&corners.counts[slot], 1);
        if (k < corners.capacity) corners.codes[slot * corners.capacity + k] = place << 2 | role;
      }
    }
  }
};

/// Sorts the rows of corners. Runs once for each slot.
struct SortCorners {
  const StepControl* control;  ///< as in ForgetCorners
  CornerRows corners;
  int* longest;   ///< raised to the number of contacts of the longest row
  int* overflow;  ///< set if a row has more contacts than the capacity

  OGC_HD void operator()(int slot) const {
    if (control->active == 0) return;
    int count = corners.counts[slot];
    if (count > corners.capacity) {
      atomic_max(longest, count);
      atomic_max(overflow, 1);
      count = corners.counts[slot] = corners.capacity;
    }
    int* codes = corners.codes + slot * corners.capacity;
    for (int k = 1; k < count; ++k) {
      const int code = codes[k];
      int to = k;
      for (; to > 0 && codes[to - 1] > code; --to) codes[to] = codes[to - 1];
      codes[to] = code;
    }
  }
};

/// Adds a row's contacts, depth and unresolved sheets to the counts that the step reports. Runs once for each row, at
/// the end of a step.
struct CountVolumeContacts {
  const int* counts;                ///< by row
  const FoundVolumeContact* found;  ///< row by row
  const int* unresolved;            ///< by row; null if there are no solids
  int capacity;                     ///< of a row
  float contact_radius;             ///< r [m]
  StepControl* control;             ///< on the backend; counts are added

  OGC_HD void operator()(int row) const {
    if (unresolved != nullptr && unresolved[row] > 0) atomic_add(&control->depth_unresolved, unresolved[row]);
    if (counts[row] == 0) return;
    float deepest = -1;
    for (int k = 0; k < counts[row]; ++k) {
      const FoundVolumeContact& contact = found[row * capacity + k];
      if (contact.inside) deepest = larger(deepest, larger(contact.depth - contact_radius, 0.0f));
    }
    atomic_add(&control->volume_contacts, counts[row]);
    if (deepest < 0) return;
    atomic_add(&control->vertices_inside, 1);
    atomic_max(&control->deepest, float_bits(deepest));
  }
};

}  // namespace ogc::fast

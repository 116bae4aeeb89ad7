// Contacts of free vertices with volumes, found with each detection and frozen until the next (§3.9, method.md §9).
//
//   AskVolumes     each vertex and each part: is it inside, nearer than r, or neither? The answer is kept beside the
//                  facet that is nearest, where the next search begins
//   ListContacts   each vertex: its contacts, part by part, in a row of fixed length; where that is too short the step
//                  is repeated with longer ones (fast/stages/lists.hpp)
#pragma once

#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/volume_depth.hpp"
#include "fast/kernels/volumes/stream.hpp"

namespace ogc::fast {

/// The nearest facet of a part to a vertex and the answer, in one number: facet · 4 + VolumeSide.
OGC_HD inline int answer_of(const NearestFacet& nearest) { return nearest.facet << 2 | static_cast<int>(nearest.side); }
/// The reverse.
OGC_HD inline NearestFacet nearest_in(int answer) { return {answer >> 2, static_cast<VolumeSide>(answer & 3)}; }

/// for_each over slots, part after part: neighbours search the same tree.
struct AskVolumes {
  VolumeView volume;            ///< its trees refitted
  const SweepVertex* vertices;  ///< by slot
  int slots;
  const Vec* position;         ///< of the detection, by vertex [m]
  const StepControl* control;  ///< where it is not active nothing is asked
  int* answers;                ///< by item: of the detection before, or any facet of the part; replaced

  OGC_HD void operator()(int i) const {
    if (control->active == 0) return;
    const int part = i / slots, v = vertices[i - part * slots].vertex;
    answers[i] = answer_of(VolumeQuestion(volume, position[v]).nearest_of(part, answers[i] >> 2));
  }
};

/// for_each over slots. A facet without area has no direction, and gives no contact.
struct ListVolumeContacts {
  VolumeView volume;
  const SweepVertex* vertices;  ///< by slot
  int slots;
  const Vec* position;         ///< as in AskVolumes
  const StepControl* control;  ///< likewise: the old rows stay
  const int* answers;          ///< of AskVolumes
  ContactTables tables;        ///< k and μ of the bodies that meet
  int capacity;                ///< contacts that fit in a row
  int* counts;                 ///< by slot, written: at most `capacity`
  VolumeIncidence* stream;     ///< row by row, written
  FoundVolumeContact* found;   ///< beside `stream`, written
  int* longest;                ///< raised to the length that a row needs
  int* overflow;               ///< set where that is too much

  OGC_HD void operator()(int slot) const {
    if (control->active == 0) return;
    const int v = vertices[slot].vertex;
    const VolumeQuestion question(volume, position[v]);
    int count = 0;
    for (int part = 0; part < volume.part_count; ++part) {
      question.visit_contacts(part, nearest_in(answers[part * slots + slot]), [&](const FoundVolumeContact& contact) {
        if (!is_finite(contact.direction)) return;
        if (count < capacity) put(slot * capacity + count, v, contact);
        ++count;
      });
    }
    counts[slot] = count < capacity ? count : capacity;
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
    incidence.contact.normal = contact.direction;
    incidence.contact.stiffness = material.stiffness;
    incidence.contact.friction = material.friction;
    stream[place] = incidence;
    found[place] = contact;
  }
};

/// for_each over slots, at the end of a step: what its row says of volumes.
struct CountVolumeContacts {
  const int* counts;                ///< by slot
  const FoundVolumeContact* found;  ///< row by row
  int capacity;                     ///< of a row
  float contact_radius;             ///< r [m]
  StepControl* control;             ///< counted there

  OGC_HD void operator()(int slot) const {
    if (counts[slot] == 0) return;
    float deepest = -1;
    for (int k = 0; k < counts[slot]; ++k) {
      const FoundVolumeContact& contact = found[slot * capacity + k];
      if (contact.inside) deepest = larger(deepest, larger(contact.depth - contact_radius, 0.0f));
    }
    atomic_add(&control->volume_contacts, counts[slot]);
    if (deepest < 0) return;
    atomic_add(&control->vertices_inside, 1);
    atomic_max(&control->deepest, float_bits(deepest));
  }
};

}  // namespace ogc::fast

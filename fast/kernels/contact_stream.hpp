// Converts the records of a detection into the stream that the sweep reads. Each incidence gets the encoded indices of
// its vertices, its friction, and its stiffness with the mollifier of this detection. This happens once for each
// detection, so that the sweep needs no tables.
#pragma once

#include <cstdint>

#include "fast/contact_view.hpp"
#include "fast/kernels/closest_points.hpp"
#include "fast/kernels/control.hpp"
#include "fast/kernels/metrics.hpp"
#include "fast/kernels/sweep_view.hpp"

namespace ogc::fast {

/// Holds the data of contacts that the records do not hold.
struct ContactTables {
  const int* body = nullptr;                   ///< by vertex
  const ContactMaterial* materials = nullptr;  ///< for bodies a and b at a · body_count + b
  int body_count = 0;                          ///< bodies; 0 if `materials` has one row, indexed by body b alone
  const float* rest_squared = nullptr;  ///< ‖ē‖² by edge [m²]; 0 for an edge without triangles, which has no mollifier
  const Vec* previous = nullptr;        ///< X_prev by vertex, for e_k [m]
};

/// Returns a contact whose k_c [N/m] and μ come from the bodies of two vertices (method.md §4.5). No other member is
/// set.
OGC_HD inline ContactIncidence meeting(const ContactTables& tables, int first, int second) {
  const ContactMaterial material = tables.materials[tables.body[first] * tables.body_count + tables.body[second]];
  ContactIncidence contact;
  contact.stiffness = material.stiffness;
  contact.friction = material.friction;
  return contact;
}

/// Sets the kind of a contact, and its vertices a, b, c, d in the order of contact_force.hpp.
OGC_HD inline void set_slots(ContactIncidence& contact, ContactKind kind, int a, int b, int c, int d) {
  contact.kind = kind;
  contact.index[0] = a;
  contact.index[1] = b;
  contact.index[2] = c;
  contact.index[3] = d;
}

/// Sets kind and vertices of a contact from a vertex–facet record. The vertex indices are not encoded.
OGC_HD inline void set_slots(ContactIncidence& contact, const VertexFacetRecord& record) {
  const int v = record.vertex;
  const int* corner = record.corner;
  if (corner[1] < 0)
    set_slots(contact, ContactKind::point_point, v, v, corner[0], v);
  else if (corner[2] < 0)
    set_slots(contact, ContactKind::point_segment, v, v, corner[0], corner[1]);
  else
    set_slots(contact, ContactKind::point_triangle, v, corner[0], corner[1], corner[2]);
}

/// Returns the contact of a vertex–facet record. Its vertex indices are not encoded, and `own` is 0.
OGC_HD inline ContactIncidence contact_of(const ContactTables& tables, const VertexFacetRecord& record) {
  ContactIncidence contact = meeting(tables, record.vertex, record.corner[0]);
  set_slots(contact, record);
  return contact;
}

/// Returns the factor e_k of the stiffness of two edge interiors. It is the mollifier if both edges have triangles, and
/// 1 if only one has. If neither has, it is overlap_share for nearly parallel edges that overlap, otherwise 1.
OGC_HD inline float energy_share(const ContactTables& tables, const EdgeEdgeRecord& record) {
  const Vec* x = tables.previous;
  const Ends p{x[record.first[0]], x[record.first[1]]}, q{x[record.second[0]], x[record.second[1]]};
  const Vec first = p.b - p.a, second = q.b - q.a;
  const float rest_first = tables.rest_squared[record.first_edge],
              rest_second = tables.rest_squared[record.second_edge];
  if (rest_first > 0 && rest_second > 0) return mollifier(first, second, rest_first, rest_second);
  if (rest_first > 0 || rest_second > 0) return 1.0f;
  const auto is_shared = [p, q] { return is_overlapping_parallel(p, q); };
  return called(is_shared) ? overlap_share(first, second, q.a - p.a, q.b - p.a) : 1.0f;
}

/// Sets kind and vertices of a contact from an edge–edge record. The vertex indices are not encoded.
OGC_HD inline void set_slots(ContactIncidence& contact, const EdgeEdgeRecord& record) {
  const int* p = record.first;
  const int* q = record.second;
  if (q[1] < 0)
    set_slots(contact, ContactKind::point_point, p[0], p[0], q[0], p[0]);
  else if (p[1] < 0)
    set_slots(contact, ContactKind::point_segment, p[0], p[0], q[0], q[1]);
  else
    set_slots(contact, ContactKind::segment_segment, p[0], p[1], q[0], q[1]);
}

/// Returns the contact of an edge–edge record. Its vertex indices are not encoded, and `own` is 0. The stiffness of two
/// edge interiors includes e_k.
OGC_HD inline ContactIncidence contact_of(const ContactTables& tables, const EdgeEdgeRecord& record) {
  ContactIncidence contact = meeting(tables, record.first[0], record.second[0]);
  set_slots(contact, record);
  if (contact.kind == ContactKind::segment_segment) contact.stiffness *= energy_share(tables, record);
  return contact;
}

/// Returns which of the four vertices of a ContactIncidence a contact of this kind has: bit k is set for vertex k.
OGC_HD inline int slots_of(ContactKind kind) {
  return kind == ContactKind::point_point ? 0b0101 : kind == ContactKind::point_segment ? 0b1101 : 0b1111;
}

/// Returns the index of a vertex in ContactIncidence, given its role in the record (contact_view.hpp). The index is the
/// role, with one exception: if the facet is an edge or a vertex, its vertices begin at index 2.
OGC_HD inline std::uint8_t slot_of_role(bool edge_edge, ContactKind kind, int role) {
  const bool shifted = !edge_edge && role > 0 && kind != ContactKind::point_triangle;
  return static_cast<std::uint8_t>(shifted ? role + 1 : role);
}

/// Writes each free vertex's rows of the contact stream. Runs once for each slot.
struct CopyContactRows {
  RowNumbers numbers;            ///< of the detection
  const int* incidence_offsets;  ///< by row, numbers.count() + 1
  const int* overflow;           ///< not 0: nothing is written; null: rows are always written
  const SweepVertex* vertices;   ///< by slot
  ContactRow* rows;              ///< by slot, written; a row is where the vertex's row of incidences is

  OGC_HD void operator()(int slot) const {
    if (overflow != nullptr && *overflow != 0) return;
    const int v = vertices[slot].vertex;
    rows[slot] = {row(numbers(v, false)), row(numbers(v, true))};
  }

 private:
  OGC_HD Row row(int number) const {
    const int begin = incidence_offsets[number];
    return {begin, incidence_offsets[number + 1] - begin};
  }
};

/// Converts one incidence: writes the contact, as its vertex sees it, to the stream. The argument `place` is the index
/// of both the incidence and the contact. A caller may pass the incidence and its record; otherwise they are read.
struct ResolveContact {
  ContactView view;  ///< records of the detection
  ContactTables tables;
  const int* colour;         ///< by vertex; −1: not free
  ContactIncidence* stream;  ///< by index of the incidence in view.incidences, written

  /// The record of an incidence: of a vertex–facet or an edge–edge contact.
  union Record {
    VertexFacetRecord vertex_facet;
    EdgeEdgeRecord edge_edge;
  };

  /// Reads the record of an incidence.
  OGC_HD Record record(Incidence incidence) const {
    Record record;
    if (is_edge_edge(incidence))
      record.edge_edge = view.edge_edge[number(incidence)];
    else
      record.vertex_facet = view.vertex_facet[number(incidence)];
    return record;
  }
  OGC_HD void operator()(int place) const {
    const Incidence incidence = view.incidences[place];
    (*this)(place, incidence, record(incidence));
  }
  OGC_HD void operator()(int place, Incidence incidence, const Record& record) const {
    const bool edge_edge = is_edge_edge(incidence);
    ContactIncidence contact = edge_edge ? contact_of(tables, record.edge_edge)
                                         : contact_of(tables, record.vertex_facet);
    contact.own = slot_of_role(edge_edge, contact.kind, static_cast<int>(incidence.code & 3u));
    const int own = colour[contact.index[contact.own]];
    for (int k = 0; k < 4; ++k) {
      int& index = contact.index[k];
      const bool is_other = k != contact.own && (slots_of(contact.kind) >> k & 1) != 0;
      if (is_other && colour[index] == own) contact.together |= static_cast<std::uint8_t>(1 << k);
      if (colour[index] < own) index = ~index;
    }
    stream[place] = contact;
  }

 private:
  OGC_HD static bool is_edge_edge(Incidence incidence) { return incidence.code >> 31 != 0; }
  OGC_HD static std::uint32_t number(Incidence incidence) { return (incidence.code & 0x7fffffffu) >> 2; }
};

/// Returns the energy [J] of a contact. Its vertex indices are not encoded, and its stiffness includes e_k.
OGC_HD inline double contact_energy(const ContactIncidence& contact, const Vec* position,
                                    const AnyActivation& activation, float contact_radius) {
  Vec x[4];
  for (int k = 0; k < 4; ++k) x[k] = position[contact.index[k]];
  const ContactShape shape = contact_shape(weighted_sum(contact_weights(contact.kind, x), x), contact_radius);
  if (!shape.acts) return 0;
  return activation.energy(activation_distance(shape.distance, contact_radius), contact_radius, contact.stiffness);
}

/// Adds the energies of the vertex–facet contacts. Runs once for each of their records.
struct VertexFacetTerm {
  ContactView view;
  ContactTables tables;  ///< of the last detection, which gives e_k
  const Vec* position;   ///< by vertex [m]
  AnyActivation activation;
  float contact_radius;  ///< r [m]

  OGC_HD void operator()(int i, double* sum) const {
    sum[sum_vertex_facet] += contact_energy(contact_of(tables, view.vertex_facet[i]), position, activation,
                                            contact_radius);
  }
};

/// Adds the energies of the edge–edge contacts. Runs once for each of their records.
struct EdgeEdgeTerm {
  ContactView view;
  ContactTables tables;  ///< of the last detection, which gives e_k
  const Vec* position;   ///< by vertex [m]
  AnyActivation activation;
  float contact_radius;  ///< r [m]

  OGC_HD void operator()(int i, double* sum) const {
    sum[sum_edge_edge] += contact_energy(contact_of(tables, view.edge_edge[i]), position, activation, contact_radius);
  }
};

}  // namespace ogc::fast

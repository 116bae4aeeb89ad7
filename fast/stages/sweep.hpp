// The sweep (Alg. 4): streams of stencils in the order in which the sweep reads them, made once on the host; the
// contact stream, made after each detection on the device; and the launches of one iteration. Every sum has the width
// W, the one thing beside the input that may change a bit.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "compare/problem/volumes.hpp"
#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/sweep/sums.hpp"
#include "fast/kernels/sweep/update_segment.hpp"
#include "fast/kernels/sweep/update_vertex.hpp"
#include "fast/kernels/volumes/stream.hpp"
#include "fast/stages/backend.hpp"
#include "fast/stages/colouring.hpp"
#include "fast/stages/rest_state.hpp"
#include "fast/stages/rod_streams.hpp"

namespace ogc::fast {

/// W by number of vertices where Settings::lanes is 0: the same on every backend, because W decides bits. Small meshes
/// cannot fill a device otherwise. `curves`: nothing but rods, whose vertices have two segments and few contacts each.
inline int default_lanes(std::size_t vertices, bool curves = false) {
  if (curves) return 2;
  return vertices <= 20000 ? 16 : (vertices <= 300000 ? 8 : 4);
}

/// The streams on the host, slot by slot in the order of the colouring.
struct SweepStreams {
  std::vector<SweepVertex> vertices;             ///< by slot
  std::vector<MembraneIncidence> membrane;       ///< row by row, in the order of slots
  std::vector<HingeIncidence> hinges;            ///< likewise
  std::vector<IsometricStencil> isometric;       ///< beside `hinges`; empty where no body bends isometrically
  std::vector<SpringIncidence> springs;          ///< row by row, as spring_rows says
  std::vector<SpringRow> spring_rows;            ///< by slot; empty where there is no spring
  std::vector<TetrahedronIncidence> tetrahedra;  ///< row by row, as tetrahedron_rows says
  std::vector<TetrahedronGradients> gradients;   ///< beside `tetrahedra`; empty where no body damps
  std::vector<TetrahedronRow> tetrahedron_rows;  ///< by slot; empty where there is no tetrahedron
};

namespace detail {

/// As a neighbour with this colour is read while `own` is solved.
inline int encoded(int vertex, const std::vector<int>& colour, int own_colour) {
  return colour[static_cast<std::size_t>(vertex)] < own_colour ? ~vertex : vertex;
}

/// A triangle as its corner sees it.
inline MembraneIncidence membrane_incidence(const RestState& rest, int triangle, int corner,
                                            const std::vector<int>& colour) {
  const TriangleRest& shape = rest.triangles[static_cast<std::size_t>(triangle)];
  const int b = (corner + 1) % 3, c = (corner + 2) % 3, own = colour[static_cast<std::size_t>(shape.corner[corner])];
  MembraneIncidence incidence;
  incidence.index[0] = encoded(shape.corner[b], colour, own);
  incidence.index[1] = encoded(shape.corner[c], colour, own);
  incidence.triangle = triangle;
  incidence.stencil = {
      {shape.gradient[b][0], shape.gradient[b][1]}, {shape.gradient[c][0], shape.gradient[c][1]}, shape.area};
  return incidence;
}

/// The other vertices of a hinge as a vertex of this role lists them. Role 0, 1: an end of the edge; 2, 3: an opposite
/// vertex. Exchanging both pairs at once keeps the angle (fast/kernels/models/discrete_hinge.hpp).
inline constexpr int hinge_others[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {1, 0, 2}};

/// A hinge as its vertex of this role sees it.
inline HingeIncidence hinge_incidence(const RestState& rest, int hinge, int role, const std::vector<int>& colour) {
  const HingeRest& shape = rest.hinges[static_cast<std::size_t>(hinge)];
  const int own = colour[static_cast<std::size_t>(shape.vertex[role])];
  HingeIncidence incidence;
  for (int k = 0; k < 3; ++k) incidence.index[k] = encoded(shape.vertex[hinge_others[role][k]], colour, own);
  incidence.hinge = role < 2 ? hinge : ~hinge;
  incidence.stencil = {shape.stiffness, shape.angle};
  return incidence;
}

/// Weights in the order of the hinge's incidence; that of x0 is made of the stored ones and rounded once.
inline IsometricStencil isometric_stencil(const HingeWeights& rest, int role) {
  const float* w = rest.weight;
  const float all[4] = {
      static_cast<float>(-static_cast<double>(w[0]) - static_cast<double>(w[1]) - static_cast<double>(w[2])), w[0],
      w[1], w[2]};
  IsometricStencil stencil;
  stencil.own = all[role];
  for (int k = 0; k < 3; ++k) stencil.other[k] = all[hinge_others[role][k]];
  return stencil;
}

/// A spring as this end of it sees it.
inline SpringIncidence spring_incidence(const SpringRest& spring, int end, const std::vector<int>& colour) {
  const int own = colour[static_cast<std::size_t>(spring.end[end])];
  return {
      {encoded(spring.end[0], colour, own), encoded(spring.end[1], colour, own), encoded(spring.end[2], colour, own)},
      end,
      spring};
}

/// The other corners as each corner lists them: those of the opposite face, in the order of a positive volume.
inline constexpr int tetrahedron_others[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
/// Number of a pair of corners among the weights.
inline constexpr int tetrahedron_pair[4][4] = {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}};

/// A tetrahedron seen from a corner.
inline TetrahedronIncidence tetrahedron_incidence(const RestState& rest, int tetrahedron, int corner,
                                                  const std::vector<int>& colour) {
  const TetrahedronRest& shape = rest.tetrahedra[static_cast<std::size_t>(tetrahedron)];
  const int own = colour[static_cast<std::size_t>(shape.corner[corner])];
  TetrahedronIncidence incidence;
  for (int k = 0; k < 3; ++k) {
    const int other = tetrahedron_others[corner][k];
    incidence.index[k] = encoded(shape.corner[other], colour, own);
    incidence.stencil.weight[k] = shape.weight[tetrahedron_pair[corner][other]];
  }
  incidence.stencil.inverse = shape.inverse;
  incidence.tetrahedron = tetrahedron;
  return incidence;
}

/// Gradients as a corner sees them. ∇N₀ is made of the stored ones and rounded once.
inline TetrahedronGradients tetrahedron_gradients(const TetrahedronRest& shape, int corner) {
  const auto gradient = [&](int k, int axis) {
    if (k > 0) return shape.gradient[k - 1][axis];
    return static_cast<float>(-static_cast<double>(shape.gradient[0][axis]) - shape.gradient[1][axis] -
                              shape.gradient[2][axis]);
  };
  TetrahedronGradients seen;
  for (int k = 0; k < 3; ++k) {
    const int other = tetrahedron_others[corner][k];
    seen.other[k] = {gradient(other, 0), gradient(other, 1), gradient(other, 2)};
  }
  seen.volume = shape.volume;
  return seen;
}

/// (element, role) of each vertex, by element; −1 for a vertex: the element lacks this role.
template <class Element, class Vertices>
std::vector<std::vector<std::pair<int, int>>> incidences(std::size_t vertex_count, const std::vector<Element>& elements,
                                                         Vertices vertices, int roles) {
  std::vector<std::vector<std::pair<int, int>>> rows(vertex_count);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (int role = 0; role < roles; ++role) {
      const int v = vertices(elements[i])[role];
      if (v >= 0) rows[static_cast<std::size_t>(v)].emplace_back(static_cast<int>(i), role);
    }
  }
  return rows;
}

}  // namespace detail

/// Whether a body's tetrahedra damp.
inline bool damps(const SolidMaterial& material) { return material.damping > 0; }

/// The tetrahedra of all slots, where there are any.
inline void add_tetrahedra(const RestState& rest, const Colouring& colouring, SweepStreams& streams) {
  if (rest.tetrahedra.empty()) return;
  const auto around = detail::incidences(
      rest.mass.size(), rest.tetrahedra, [](const TetrahedronRest& t) { return t.corner; }, 4);
  const bool damped = std::any_of(rest.solids.begin(), rest.solids.end(), damps);
  for (const int v : colouring.order) {
    const auto& own = around[static_cast<std::size_t>(v)];
    streams.tetrahedron_rows.push_back({static_cast<int>(streams.tetrahedra.size()), static_cast<int>(own.size())});
    for (const auto& [tetrahedron, corner] : own) {
      streams.tetrahedra.push_back(detail::tetrahedron_incidence(rest, tetrahedron, corner, colouring.colour));
      if (damped)
        streams.gradients.push_back(
            detail::tetrahedron_gradients(rest.tetrahedra[static_cast<std::size_t>(tetrahedron)], corner));
    }
  }
}

/// `step` is h [s].
inline SweepStreams build_streams(const RestState& rest, const Colouring& colouring, double step) {
  const auto triangles = detail::incidences(
      rest.mass.size(), rest.triangles, [](const TriangleRest& t) { return t.corner; }, 3);
  const auto hinges = detail::incidences(
      rest.mass.size(), rest.hinges, [](const HingeRest& hinge) { return hinge.vertex; }, 4);
  const auto with_roles = [](const SpringRest& s) {
    return std::vector<int>{s.end[0], s.end[1], end_count(s) == 3 ? s.end[2] : -1};
  };
  const auto springs = detail::incidences(rest.mass.size(), rest.springs, with_roles, 3);
  SweepStreams streams;
  add_tetrahedra(rest, colouring, streams);
  for (const int v : colouring.order) {
    const auto i = static_cast<std::size_t>(v);
    SweepVertex vertex;
    vertex.vertex = v;
    vertex.body = rest.body[i];
    vertex.inertia = static_cast<float>(static_cast<double>(rest.mass[i]) / (step * step));
    vertex.membrane_begin = static_cast<int>(streams.membrane.size());
    vertex.membrane_count = static_cast<int>(triangles[i].size());
    vertex.hinge_begin = static_cast<int>(streams.hinges.size());
    vertex.hinge_count = static_cast<int>(hinges[i].size());
    for (const auto& [triangle, corner] : triangles[i])
      streams.membrane.push_back(detail::membrane_incidence(rest, triangle, corner, colouring.colour));
    for (const auto& [hinge, role] : hinges[i]) {
      streams.hinges.push_back(detail::hinge_incidence(rest, hinge, role, colouring.colour));
      if (!rest.weights.empty())
        streams.isometric.push_back(detail::isometric_stencil(rest.weights[static_cast<std::size_t>(hinge)], role));
    }
    if (!rest.springs.empty())
      streams.spring_rows.push_back({static_cast<int>(streams.springs.size()), static_cast<int>(springs[i].size())});
    for (const auto& [spring, end] : springs[i])
      streams.springs.push_back(
          detail::spring_incidence(rest.springs[static_cast<std::size_t>(spring)], end, colouring.colour));
    streams.vertices.push_back(vertex);
  }
  return streams;
}

/// ‖ē‖² by edge, 0 of an edge without triangles.
inline std::vector<float> rest_squared_with_triangles(const compare::Topology& topology, const RestState& rest) {
  std::vector<float> squared = rest.edge_length_squared;
  for (std::size_t e = 0; e < squared.size(); ++e) {
    if (topology.edge_triangles[e].empty()) squared[e] = 0;
  }
  return squared;
}

/// What a scene asks of the sum over the stencils of a vertex (sums.hpp).
inline unsigned asked_of_sum(const RestState& rest, const compare::Scene& scene) {
  const auto if_any = [](const auto& elements, unsigned bit) { return elements.empty() ? 0u : bit; };
  const bool usual_models = std::all_of(rest.models.begin(), rest.models.end(), [](const SurfaceModels& models) {
    return has_default_membrane(models) && has_default_bending(models);
  });
  return if_any(rest.triangles, asks_triangles) | if_any(rest.hinges, asks_hinges) |
         if_any(rest.springs, asks_springs) | if_any(rest.tetrahedra, asks_tetrahedra) |
         if_any(rest.rods, asks_segments) | (compare::has_volumes(scene) ? asks_volumes : 0u) |
         (usual_models ? 0u : asks_any_model) | (rest.activation == ContactActivation::ogc ? 0u : asks_any_activation);
}

/// Launches a team of `lanes` team lanes for each of `count` vertices of a colour.
template <class Backend, class Sum>
void update_vertices(Backend& backend, int lanes, int count, const UpdateVertex<Sum>& kernel, Start start);
/// Launches a team for each slot. The width is fixed, because no position depends on these sums.
template <class Backend>
void measure_vertices(Backend& backend, int slots, const MeasureVertex<GatherAll>& kernel);

/// The resident streams and their launches. `complete` gives a view what belongs to the sweep; positions, bounds and
/// control of an iteration are the caller's.
template <class Backend>
class Sweep {
 public:
  /// Of a scene; `backend` and nothing else must outlive it. `segments`: colours of the segments of its rods.
  Sweep(Backend& backend, const RestState& rest, const Colouring& colouring, const compare::Topology& topology,
        const compare::Scene& scene, const Colouring& segments = {})
      : backend_(backend),
        colour_begin_(colouring.begin),
        colours_(colouring.count),
        vertex_count_(static_cast<int>(rest.mass.size())),
        lanes_(scene.settings.lanes > 0
                   ? static_cast<int>(scene.settings.lanes)
                   : default_lanes(rest.mass.size(),
                                   !rest.rods.empty() && rest.triangles.empty() && rest.tetrahedra.empty())),
        sum_(Sums::first_that_gives(asked_of_sum(rest, scene))),
        activation_(rest.activation),
        rods_(rest, colouring, segments, scene.settings) {
    const SweepStreams streams = build_streams(rest, colouring, scene.settings.time_step);
    upload(vertices_, streams.vertices);
    upload(membrane_, streams.membrane);
    upload(hinges_, streams.hinges);
    upload(colour_, colouring.colour);
    upload(body_, rest.body);
    upload(materials_, rest.materials);
    upload(models_, rest.models);
    upload(isometric_, streams.isometric);
    upload(springs_, streams.springs);
    upload(spring_rows_, streams.spring_rows);
    upload(solids_, rest.solids);
    upload(tetrahedra_, streams.tetrahedra);
    upload(gradients_, streams.gradients);
    upload(tetrahedron_rows_, streams.tetrahedron_rows);
    upload(contact_materials_, rest.contact);
    upload(rest_squared_, rest_squared_with_triangles(topology, rest));
    contact_rows_.resize(streams.vertices.size());
    contact_rows_.fill_zero();
    const int bodies = static_cast<int>(rest.materials.size());
    tables_ = {body_.data(), contact_materials_.data(), bodies, rest_squared_.data(), nullptr};
    for (std::size_t v = 0; v < rest.mobility.size(); ++v) {
      // a driven volume is at its targets already
      if (rest.mobility[v] == Mobility::prescribed && !is_of_volume(scene, rest.body[v]))
        prescribed_host_.push_back(static_cast<int>(v));
    }
    upload(prescribed_, prescribed_host_);
  }

  int colours() const { return colours_; }  ///< launches of an iteration, beside that of the prescribed vertices
  /// W, the width of the sums.
  int lanes() const { return lanes_; }
  /// By body; on the backend.
  const SurfaceMaterial* materials() const { return materials_.data(); }
  /// Likewise.
  const SurfaceModels* models() const { return models_.data(); }
  const SolidMaterial* solids() const { return solids_.data(); }
  ContactActivation activation() const { return activation_; }
  const int* colour() const { return colour_.data(); }  ///< by vertex; −1: not free. On the backend

  /// What a record does not say itself; `previous`: X_prev, the positions of the last detection.
  ContactTables tables(const Vec* previous) const {
    ContactTables tables = tables_;
    tables.previous = previous;
    return tables;
  }

  /// Room for so many contacts of a detection, and their incidences. Host only, outside a step.
  void reserve_contacts(int contacts) { contacts_.resize(4 * static_cast<std::size_t>(contacts)); }

  /// Free vertices: items of a launch over contact_rows.
  int slots() const { return static_cast<int>(vertices_.size()); }
  /// The stream of the last detection: a vertex's contacts are where its row of incidences is; on the backend.
  const ContactIncidence* contacts() const { return contacts_.data(); }
  /// By slot; on the backend.
  const SweepVertex* vertices() const { return vertices_.data(); }
  /// What makes the rows of the stream after a detection. Where *overflow is not 0 the old stream stays, which is
  /// whole.
  template <class Item>
  CopyContactRows<Item> contact_rows(const int* incidence_offsets, const Item* incidences, const int* overflow) {
    return {incidence_offsets, incidences, overflow, vertices_.data(), contact_rows_.data()};
  }
  /// What writes the stream, as each incidence gets its place; `previous`: the positions of the detection.
  ResolveContact resolve_contact(const ContactView& view, const Vec* previous) {
    return {view, tables(previous), colour_.data(), contacts_.data()};
  }

  /// The stream of contacts that are there already.
  void resolve_contacts(const ContactView& view, const Vec* previous) {
    backend_.for_both(slots(), contact_rows(view.incidence_offsets, view.incidences, nullptr),
                      view.incidence_offsets + vertex_count_, static_cast<int>(contacts_.size()),
                      resolve_contact(view, previous));
  }

  /// The streams of this sweep in a view; positions, targets and control are the caller's.
  void complete(SweepView& view) const {
    view.vertices = vertices_.data();
    view.membrane = membrane_.data();
    view.hinges = hinges_.data();
    view.contact_rows = contact_rows_.data();
    view.contacts = contacts_.data();
    view.materials = materials_.data();
    view.models = models_.data();
    view.isometric = isometric_.data();
    view.springs = springs_.data();
    view.spring_rows = spring_rows_.data();
    view.activation = activation_;
    view.tetrahedron_rows = tetrahedron_rows_.data();
    view.tetrahedra = tetrahedra_.data();
    view.gradients = gradients_.data();
    view.solids = solids_.data();
    rods_.complete(view.rods);
  }

  /// One iteration: prescribed vertices, segments and then vertices colour by colour; each position is truncated before
  /// it is written, each cut counted. `start`: overlapping where the launch before writes nothing that a sweep reads
  /// but StepControl::turn.
  void iterate(const SweepView& view, Start start = Start::after_previous) {
    const int prescribed = static_cast<int>(prescribed_host_.size());
    // It writes only what a colour reads after its sum, so the first colour may overlap it.
    backend_.for_each(prescribed, UpdatePrescribed{view, prescribed_.data()});
    rods_.enqueue(backend_, view, prescribed == 0);
    const bool is_before = prescribed > 0 || rods_.colours() > 0;
    for (int c = 0; c < colours_; ++c) {
      const auto k = static_cast<std::size_t>(c);
      const int count = colour_begin_[k + 1] - colour_begin_[k];
      const bool is_first = c == 0 && !is_before, asks_late = is_first && start == Start::overlapping;
      const Start own_start = is_first ? start : Start::overlapping;
      Sums::with(sum_, [&](auto sum) {
        update_vertices(backend_, lanes_, count, UpdateVertex<decltype(sum)>{view, colour_begin_[k], asks_late},
                        own_start);
      });
    }
  }

  /// The force on each free vertex, into `left`; as MeasureVertex.
  void measure(const SweepView& view, LeftForce* left, bool is_end) const {
    measure_vertices(backend_, slots(), MeasureVertex<GatherAll>{view, left, is_end});
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;
  using Sums = typename Backend::Sums;

  static bool is_of_volume(const compare::Scene& scene, int body) {
    return scene.bodies[static_cast<std::size_t>(body)].is_volume();
  }

  template <class T>
  static void upload(Buffer<T>& buffer, const std::vector<T>& items) {
    buffer.upload(items.data(), items.size());
  }

  Backend& backend_;
  std::vector<int> colour_begin_, prescribed_host_;
  int colours_, vertex_count_, lanes_;
  int sum_;  ///< number in Sums
  ContactActivation activation_;
  RodSweep<Backend> rods_;
  Buffer<SweepVertex> vertices_;
  Buffer<MembraneIncidence> membrane_;
  Buffer<HingeIncidence> hinges_;
  Buffer<ContactIncidence> contacts_;
  Buffer<ContactRow> contact_rows_;
  Buffer<int> colour_, body_, prescribed_;
  Buffer<SurfaceMaterial> materials_;
  Buffer<SurfaceModels> models_;
  Buffer<IsometricStencil> isometric_;
  Buffer<SpringIncidence> springs_;
  Buffer<SpringRow> spring_rows_;
  Buffer<TetrahedronIncidence> tetrahedra_;
  Buffer<TetrahedronGradients> gradients_;
  Buffer<TetrahedronRow> tetrahedron_rows_;
  Buffer<SolidMaterial> solids_;
  Buffer<ContactMaterial> contact_materials_;
  Buffer<float> rest_squared_;
  ContactTables tables_;
};

}  // namespace ogc::fast

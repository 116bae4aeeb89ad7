// Launches iterations of the sweep (Alg. 4). Holds the streams of elements (streams.hpp), made once on the host, and
// the contact stream, made after each detection on the device. Every sum has the width W. Besides the scene, only W can
// change a bit of the results.
#pragma once

#include <vector>

#include "compare/problem/volumes.hpp"
#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/sweep/sums.hpp"
#include "fast/kernels/sweep/update_segment.hpp"
#include "fast/kernels/sweep/update_vertex.hpp"
#include "fast/kernels/volumes/stream.hpp"
#include "fast/stages/backend.hpp"
#include "fast/stages/colouring.hpp"
#include "fast/stages/parts.hpp"
#include "fast/stages/rest_state.hpp"
#include "fast/stages/rod_streams.hpp"
#include "fast/stages/streams.hpp"

namespace ogc::fast {

/// Returns the default W, for Settings::lanes = 0. It is the same on every backend, because W changes bits. Small
/// meshes need more lanes to fill a device. `curves`: the scene has only rods, whose vertices have two segments and few
/// contacts each.
inline int default_lanes(std::size_t vertices, bool curves = false) {
  if (curves) return 2;
  return vertices <= 20000 ? 16 : (vertices <= 300000 ? 8 : 4);
}

/// Returns ‖ē‖² by edge; 0 for an edge without triangles.
inline std::vector<float> rest_squared_with_triangles(const compare::Topology& topology, const RestState& rest) {
  std::vector<float> squared = rest.edge_length_squared;
  for (std::size_t e = 0; e < squared.size(); ++e) {
    if (topology.edge_triangles[e].empty()) squared[e] = 0;
  }
  return squared;
}

/// The kinds of elements that a scene has, one bit each (kinds/kinds.hpp).
template <class... All>
unsigned kinds_of(KindList<All...> list, const RestState& rest) {
  return ((at_rest<All>(rest).elements().empty() ? 0u : list.template bit<All>) | ...);
}
/// Returns the kinds that form curves, one bit each. Their vertices have few elements.
template <class... All>
constexpr unsigned curves(KindList<All...> list) {
  return ((All::is_curve ? list.template bit<All> : 0u) | ...);
}

/// Returns W for a scene: its setting, or the default.
inline int lanes_of(const RestState& rest, const compare::Scene& scene) {
  if (scene.settings.lanes > 0) return static_cast<int>(scene.settings.lanes);
  const unsigned kinds = kinds_of(Kinds{}, rest);
  const bool has_only_curves = (kinds & Kinds::bit<SegmentKind>) != 0 && (kinds & ~curves(Kinds{})) == 0;
  return default_lanes(rest.mass.size(), has_only_curves);
}

/// Returns whether the sweep moves a prescribed vertex to its target. Vertices of driven volumes are there already.
inline bool is_moved_to_target(const RestState& rest, const compare::Scene& scene, std::size_t v) {
  return rest.mobility[v] == Mobility::prescribed && !scene.bodies[as_index(rest.body[v])].is_volume();
}

/// Returns the features that a scene needs in the sum over a vertex's stencils, one bit each (sums.hpp).
inline unsigned asked_of_sum(const RestState& rest, const compare::Scene& scene) {
  unsigned models_asked = 0;
  for (const SurfaceModels& models : rest.models)
    models_asked |= (has_default_membrane(models) ? 0u : asks_any_stretch) |
                    (has_default_bending(models) ? 0u : asks_any_bending);
  return kinds_of(Kinds{}, rest) | (compare::has_volumes(scene) ? asks_volumes : 0u) | models_asked |
         (rest.activation == ContactActivation::ogc ? 0u : asks_any_activation);
}

/// Updates vertices of a colour, each by a team of `lanes` team lanes.
template <class Backend, class Sum>
void update_vertices(Backend& backend, int lanes, Teams teams, const UpdateVertex<Sum>& kernel, Start start);
/// Measures the force on the vertex of each slot; one team sums the force of one slot. The number of lanes is fixed,
/// because no position depends on these sums.
template <class Backend>
void measure_vertices(Backend& backend, int slots, const MeasureVertex<GatherAll>& kernel);

/// Holds the resident streams and launches the sweep. `complete` fills in the sweep's part of a view; the caller sets
/// an iteration's positions, bounds and control.
template <class Backend>
class Sweep {
 public:
  /// Makes the sweep of a scene; only `backend` must outlive it. `segments`: colours of the rods' segments.
  Sweep(Backend& backend, const RestState& rest, const Colouring& colouring, const compare::Topology& topology,
        const compare::Scene& scene, const Colouring& segments = {})
      : backend_(backend),
        colour_begin_(colouring.begin),
        colours_(colouring.count),
        lanes_(lanes_of(rest, scene)),
        sum_(Sums::first_that_gives(asked_of_sum(rest, scene))),
        activation_(rest.activation),
        streams_(rest, colouring, scene.settings.time_step),
        rods_(rest, colouring, segments, scene.settings) {
    upload(colour_, colouring.colour);
    upload(row_places_, row_places_of(colouring));
    upload(body_, rest.body);
    upload(materials_, rest.materials);
    upload(models_, rest.models);
    upload(contact_materials_, rest.contact);
    upload(rest_squared_, rest_squared_with_triangles(topology, rest));
    contact_rows_.resize(static_cast<std::size_t>(slots()));
    contact_rows_.fill_zero();
    const int bodies = static_cast<int>(rest.materials.size());
    tables_ = {body_.data(), contact_materials_.data(), bodies, rest_squared_.data(), nullptr};
    for (std::size_t v = 0; v < rest.mobility.size(); ++v)
      if (is_moved_to_target(rest, scene, v)) prescribed_host_.push_back(static_cast<int>(v));
    upload(prescribed_, prescribed_host_);
  }

  int colours() const { return colours_; }  ///< launches of an iteration, without the launch for prescribed vertices
  /// Returns W, the width of the sums.
  int lanes() const { return lanes_; }
  ContactActivation activation() const { return activation_; }
  const int* colour() const { return colour_.data(); }  ///< by vertex; −1: not free; on the backend

  /// Returns the data of contacts that the detection's records do not hold: materials, rest lengths, X_prev.
  /// `previous`: X_prev, the positions of the last detection.
  ContactTables tables(const Vec* previous) const {
    ContactTables tables = tables_;
    tables.previous = previous;
    return tables;
  }

  /// Makes room for the contacts of a detection, and for their incidences. Host only, outside a step.
  void reserve_contacts(int contacts) { contacts_.resize(4 * static_cast<std::size_t>(contacts)); }

  /// Returns the number of free vertices; contact_rows() runs once for each.
  int slots() const { return streams_.slots(); }
  /// Returns the contact stream of the last detection, on the backend. Contacts have the indices of their incidences.
  const ContactIncidence* contacts() const { return contacts_.data(); }
  /// Returns the free vertices by slot, on the backend.
  const SweepVertex* vertices() const { return streams_.vertices(); }
  /// Returns RowNumbers::place for detections whose contacts this sweep reads, on the backend: the vertices by slot,
  /// then the others.
  const int* row_places() const { return row_places_.data(); }
  /// Returns the functor that makes the rows of the contact stream after a detection. If *overflow is not 0, the
  /// functor keeps the old stream, which is complete.
  CopyContactRows contact_rows(const ContactView& view, const int* overflow) {
    return {view.rows, view.incidence_offsets, overflow, vertices(), contact_rows_.data()};
  }
  /// Returns the functor that writes each contact at the index of its incidence in the contact stream. `previous`: the
  /// positions of the detection.
  ResolveContact resolve_contact(const ContactView& view, const Vec* previous) {
    return {view, tables(previous), colour_.data(), contacts_.data()};
  }

  /// Makes the contact stream from the contacts of `view`.
  void resolve_contacts(const ContactView& view, const Vec* previous) {
    backend_.for_both(slots(), contact_rows(view, nullptr), view.incidence_offsets + view.rows.count(),
                      static_cast<int>(contacts_.size()), resolve_contact(view, previous));
  }

  /// Computes the elements' state at xᵗ (Kind::Start), which damping reads. `start`: xᵗ, on the backend.
  void begin(const Vec* start) { streams_.begin(backend_, start); }
  /// Returns the elements at `position` (on the backend).
  AllElements<Kinds> elements(const Vec* position) const {
    return streams_.elements(materials_.data(), models_.data(), position);
  }

  /// Puts the streams into a view; the caller sets positions, targets and control.
  void complete(SweepView& view) const {
    streams_.complete(view);
    view.contact_rows = contact_rows_.data();
    view.contacts = contacts_.data();
    view.materials = materials_.data();
    view.models = models_.data();
    view.activation = activation_;
    rods_.complete(view.rods);
  }

  /// Runs one iteration: prescribed vertices, segments, then vertices, colour by colour. Each position is truncated
  /// before it is written, and each cut is counted. Pass `overlapping` only if the sweep reads nothing that the
  /// previous launch writes, except StepControl::turn.
  void iterate(const SweepView& view, Start start = Start::after_previous) {
    const int prescribed = static_cast<int>(prescribed_host_.size());
    // The first colour may begin before UpdatePrescribed ends. Only the colour's sums read the positions that
    // UpdatePrescribed writes, and a sum first waits for the previous launch.
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

  /// Does the work of iterate for the own vertices of one of several parts. `padded`: as in StepState.
  void iterate(const SweepView& view, Parts<Backend>& parts, const PaddedVec* padded) {
    const Range own = parts.vertices();
    backend_.for_each(static_cast<int>(prescribed_host_.size()),
                      UpdatePrescribed{view, prescribed_.data(), own.begin, own.end});
    for (int c = 0; c < colours_; ++c) {
      const auto k = static_cast<std::size_t>(c);
      const Range slots = parts.slots(c);
      Sums::with(sum_, [&](auto sum) {
        update_vertices(backend_, lanes_, {slots.count(), colour_begin_[k + 1] - colour_begin_[k]},
                        UpdateVertex<decltype(sum)>{view, slots.begin, false},
                        c == 0 ? Start::after_previous : Start::overlapping);
      });
      parts.share_colour(view, padded, c);
    }
  }

  /// Writes the force on each free vertex into `left` (see MeasureVertex).
  void measure(const SweepView& view, LeftForce* left, bool is_end) const {
    measure_vertices(backend_, slots(), MeasureVertex<GatherAll>{view, left, is_end});
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;
  using Sums = typename Backend::Sums;

  template <class T>
  static void upload(Buffer<T>& buffer, const std::vector<T>& items) {
    buffer.upload(items.data(), items.size());
  }

  Backend& backend_;
  std::vector<int> colour_begin_, prescribed_host_;
  int colours_, lanes_;
  int sum_;  ///< number in Sums
  ContactActivation activation_;
  Streams<Backend, Kinds> streams_;
  RodSweep<Backend> rods_;
  Buffer<ContactIncidence> contacts_;
  Buffer<ContactRow> contact_rows_;
  Buffer<int> colour_, body_, prescribed_, row_places_;
  Buffer<SurfaceMaterial> materials_;
  Buffer<SurfaceModels> models_;
  Buffer<ContactMaterial> contact_materials_;
  Buffer<float> rest_squared_;
  ContactTables tables_;
};

}  // namespace ogc::fast

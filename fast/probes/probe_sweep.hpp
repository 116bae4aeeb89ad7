// Lets the judge test the sweep: runs one iteration of the resident Sweep with the rest state, colouring and contacts
// of a case. FillIncidences and RankIncidences of the detection fill and order the incidences, so the sums have the
// same order as in a step.
#pragma once

#include <span>
#include <vector>

#include "compare/stages/sweep.hpp"
#include "fast/kernels/lists.hpp"
#include "fast/kernels/rods/turn.hpp"
#include "fast/probes/probe_memory.hpp"
#include "fast/probes/sweep_records.hpp"
#include "fast/stages/step.hpp"
#include "fast/stages/sweep.hpp"
#include "fast/stages/volumes.hpp"

namespace ogc::fast {

/// Holds contact records and their incidences on the backend.
template <class Backend>
class ProbeContacts {
 public:
  /// `places`: RowNumbers::place, on the backend.
  ProbeContacts(Backend& backend, const ContactRecords& records, const int* places, int vertex_count)
      : backend_(backend), count_(records.offsets.back()), rows_{places, vertex_count} {
    const auto facets = static_cast<int>(records.vertex_facet.size()),
               edges = static_cast<int>(records.edge_edge.size());
    const int counts[2] = {facets, facets + edges};
    counts_.upload(counts, 2);
    overflow_.resize(1);
    overflow_.fill_zero();
    vertex_facet_.upload(records.vertex_facet.data(), records.vertex_facet.size());
    edge_edge_.upload(records.edge_edge.data(), records.edge_edge.size());
    offsets_.upload(records.offsets.data(), records.offsets.size());
    filled_.resize(static_cast<std::size_t>(rows_.count()));
    filled_.fill_zero();
    loose_.resize(static_cast<std::size_t>(count_)), incidences_.resize(static_cast<std::size_t>(count_));
    fill(facets, edges);
  }

  /// Returns a capacity that suffices for the contacts: the number of incidences. Each contact has at least two
  /// incidences.
  int capacity() const { return count_; }
  /// Returns the number of contacts, on the backend.
  const int* count() const { return counts_.data() + 1; }

  /// Returns the contacts as a detection's ContactView.
  ContactView view() const {
    ContactView view;
    view.vertex_facet = vertex_facet_.data();
    view.edge_edge = edge_edge_.data();
    view.vertex_facet_count = counts_.data();
    view.rows = rows_;
    view.incidence_offsets = offsets_.data();
    view.incidences = incidences_.data();
    return view;
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  /// Sets only the lists that the last two kernels of a detection read, and runs these kernels.
  void fill(int facets, int edges) {
    ListsView lists;
    lists.overflow = overflow_.data();
    lists.vertex_facet = vertex_facet_.data();
    lists.edge_edge = edge_edge_.data();
    lists.rows = rows_;
    lists.incidence_offsets = offsets_.data();
    lists.incidence_filled = filled_.data();
    lists.loose = loose_.data();
    lists.incidences = incidences_.data();
    backend_.for_each(facets + edges, FillIncidences{lists, facets});
    backend_.for_each(count_, RankIncidences{lists});
  }

  Backend& backend_;
  int count_;
  RowNumbers rows_;
  Buffer<int> counts_, overflow_, offsets_, filled_;  ///< `overflow_`: one flag, which is 0
  Buffer<VertexFacetRecord> vertex_facet_;
  Buffer<EdgeEdgeRecord> edge_edge_;
  Buffer<LooseIncidence> loose_;
  Buffer<Incidence> incidences_;
};

/// Holds the quaternions of a case, and the vectors c of rod_rest_direction at the start of a step.
template <class Backend>
class ProbeRods {
 public:
  ProbeRods(Backend& backend, const compare::SweepIn& in, const RestState& rest) : count_(in.orientation.size()) {
    if (count_ == 0) return;
    const std::vector<Quat> now = quats(in.orientation), before = quats(in.orientation_start);
    orientation_.upload(now.data(), now.size());
    start_.upload(before.data(), before.size());
    if (at_rest<SegmentKind>(rest).by_body(rest).empty() || !damps_strain(in.scene->settings.damping)) return;
    typename Backend::template Buffer<SegmentRest> segments;
    segments.upload(rest.rods.segments.data(), count_);
    typename Backend::template Buffer<Vec> positions;
    positions.upload(reinterpret_cast<const Vec*>(in.start.data()), in.start.size());
    direction_.resize(count_);
    backend.for_each(static_cast<int>(count_),
                     SetDirection{segments.data(), positions.data(), start_.data(), direction_.data()});
    backend.synchronize();
  }

  /// Puts the quaternions and the vectors c of rod_rest_direction into the sweep's view.
  void complete(RodStream& rods) {
    rods.orientation = orientation_.data();
    rods.orientation_start = start_.data();
    rods.direction = direction_.data();
  }
  /// Returns the present orientations.
  std::vector<compare::Quaternion> orientations() const {
    std::vector<Quat> now(count_);
    if (count_ > 0) orientation_.download(now.data(), count_);
    return quaternions(now);
  }

 private:
  std::size_t count_;
  typename Backend::template Buffer<Quat> orientation_, start_;
  typename Backend::template Buffer<Vec> direction_;
};

/// Runs one iteration of the resident sweep.
template <class Backend>
compare::SweepOut probe_sweep(Backend& backend, const compare::SweepIn& in) {
  ProbeMemory<Backend> memory(backend);
  const auto whole = [](std::span<const compare::Vec3f> x) { return std::vector<compare::Vec3f>(x.begin(), x.end()); };
  const auto vectors = [&](std::span<const compare::Vec3f> x) { return memory.template in<Vec>(whole(x)); };
  const RestState rest = rest_state_of({in.scene, in.topology}, *in.rest);
  const StepSettings settings = step_settings(*in.scene, in.old.size(), false);
  const Colouring colouring = colouring_of(in.colour);
  ProbeRods<Backend> rods(backend, in, rest);
  Sweep<Backend> sweep(backend, rest, colouring, *in.topology, *in.scene, colouring_of(in.segment_colour));
  const AskerRows rows = asker_rows(*in.scene, *in.topology, colouring.order);
  Volumes<Backend> volumes({}, volume_parts(*in.scene, *in.topology), {}, rows, sweep.slots(), sweep.colour());
  StepControl control;
  control.active = 1;
  typename Backend::template Buffer<StepControl> control_buffer;
  control_buffer.upload(&control, 1);
  typename Backend::template Buffer<Vec> position;
  position.upload(reinterpret_cast<const Vec*>(in.old.data()), in.old.size());

  SweepView view;
  view.start = {memory.padded(whole(in.start))};
  view.target = vectors(in.target);
  const Vec* previous = vectors(in.previous);
  view.regions = {previous, memory.template in<float>(std::vector<float>(in.bound.begin(), in.bound.end()))};
  view.old = memory.padded(whole(in.old), 2);
  view.to_fresh = static_cast<int>(in.old.size());
  view.position = position.data();
  view.control = control_buffer.data();
  view.contact_radius = settings.contact_radius;
  view.friction_limit = settings.friction_limit;
  sweep.begin(vectors(in.start));
  const ProbeContacts<Backend> contacts(backend, contact_records(in, row_places_of(colouring)), sweep.row_places(),
                                        static_cast<int>(in.old.size()));
  sweep.reserve_contacts(contacts.capacity());
  sweep.resolve_contacts(contacts.view(), previous);
  sweep.complete(view);
  rods.complete(view.rods);
  if (volumes.is_used()) {
    volumes.put(volume_rows(in, rest, rows));
    view.volumes = volumes.stream();
  }
  sweep.iterate(view);

  backend.synchronize();
  compare::SweepOut out;
  out.position.resize(in.old.size());
  position.download(reinterpret_cast<Vec*>(out.position.data()), out.position.size());
  control_buffer.download(&control, 1);
  out.cut = control.cut;
  out.orientation = rods.orientations();
  return out;
}

}  // namespace ogc::fast

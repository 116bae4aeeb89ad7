// Holds the memory of the growing lists and launches their kernels. If a detection finds no room, it sets the overflow
// flag and stores the size that it needs. The host then grows the lists and repeats the step. So no contact is lost,
// and nothing waits for the host in between. Growth is rarely noticed so late: a detection before the first step counts
// what it needs (ResidentSimulation), and `make_room` grows lists that are nearly full after a step.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "compare/problem/error.hpp"
#include "fast/kernels/bound.hpp"
#include "fast/kernels/collect_contacts.hpp"
#include "fast/kernels/lists.hpp"

namespace ogc::fast {

/// Holds the lists of one surface: noted pairs, contacts and incidences.
template <class Backend>
class Lists {
 public:
  /// `capacity` > 0: number of contacts for which the lists have room at first.
  Lists(const SurfaceView& surface, int capacity)
      : surface_(surface), buckets_(2 * surface.vertex_count + surface.edge_count) {
    const auto buckets = static_cast<std::size_t>(buckets_), vertices = static_cast<std::size_t>(surface.vertex_count);
    status_.resize(1);
    status_.fill_zero();
    for (Buffer<int>* counts : {&record_counts_, &record_filled_}) counts->resize(buckets);
    for (Buffer<int>* counts : {&incidence_counts_, &incidence_filled_}) counts->resize(2 * vertices);
    record_offsets_.resize(buckets + 1), incidence_offsets_.resize(2 * vertices + 1);
    resize(std::min(capacity, ListRoom::largest), within_limit(least_noted + 4 * std::int64_t{capacity}));
  }

  /// Sets RowNumbers::place, on the backend; null: rows are in the order of vertices. Call it before the first
  /// detection.
  void number_rows(const int* places) { places_ = places; }
  /// Leaves the rows of all but the own vertices of a part empty, and notes who reads these.
  void keep_own_rows(const Readers& readers) { readers_ = readers; }

  /// Returns the lists as kernels see them.
  ListsView view() {
    ListStatus* status = status_.data();
    return {.noted = noted_.data(),
            .noted_capacity = noted_capacity_,
            .noted_count = &status->noted,
            .table = table_.data(),
            .slot_mask = static_cast<std::uint32_t>(table_.size() - 1),
            .entered = entered_.data(),
            .bucketed = bucketed_.data(),
            .capacity = capacity_,
            .contact_count = &status->contacts,
            .without_slot = &status->without_slot,
            .overflow = &status->overflow,
            .buckets = buckets_,
            .record_counts = record_counts_.data(),
            .record_offsets = record_offsets_.data(),
            .record_filled = record_filled_.data(),
            .edge_edge_count = &status->edge_edge,
            .vertex_facet = vertex_facet_.data(),
            .vertex_facet_face = vertex_facet_face_.data(),
            .edge_edge = edge_edge_.data(),
            .rows = {places_, surface_.vertex_count},
            .incidence_counts = incidence_counts_.data(),
            .incidence_offsets = incidence_offsets_.data(),
            .incidence_filled = incidence_filled_.data(),
            .loose = loose_.data(),
            .incidences = incidences_.data(),
            .readers = readers_};
  }

  /// Returns the number of vertex–facet records, on the backend.
  const int* vertex_facet_count() const { return record_offsets_.data() + surface_.vertex_count; }
  /// Returns the number of edge–edge records, on the backend.
  const int* edge_edge_count() const { return &status_.data()->edge_edge; }
  /// Returns a flag on the backend that is not 0 once a list was too small.
  const int* overflow() const { return &status_.data()->overflow; }
  /// Returns the number of contacts for which the lists have room.
  int capacity() const { return capacity_; }
  /// Returns the number of noted pairs for which the lists have room.
  int noted_capacity() const { return noted_capacity_; }

  /// Enters the contacts of the pairs that both searches noted. The launch also computes `bounds`, which need no list,
  /// for vertices 0 … `bounded` − 1. `distances`: see CollectContacts.
  void collect_contacts(Backend& backend, PaddedVecs positions, float contact_radius, int bounded,
                        const ConservativeBound& bounds, const float* distances) {
    const ListsView lists = view();
    backend.for_both(bounded, bounds, lists.noted_count, noted_capacity_,
                     collect(positions, contact_radius, distances));
  }

  /// Makes records and incidences of the contacts. `launches` runs the last launch (see Detection::detect).
  template <class Launches>
  void assemble(Backend& backend, const Launches& launches) {
    const ListsView lists = view();
    backend.exclusive_scans({lists.record_counts, lists.record_offsets, buckets_},
                            {lists.incidence_counts, lists.incidence_offsets, lists.rows.count()});
    backend.for_both(1, CheckCapacity{lists}, lists.contact_count, capacity_,
                     FillBuckets{lists, surface_.vertex_count});
    backend.for_each_counted(lists.contact_count, capacity_, WriteRecords{lists, {surface_}});
    launches.rank(backend, lists, lists.incidence_offsets + lists.rows.count(), 4 * capacity_);
  }

  /// Returns the functor that decides which noted pairs are contacts.
  CollectContacts collect(PaddedVecs positions, float contact_radius, const float* distances) {
    return {{surface_, positions, contact_radius}, {surface_, positions, contact_radius}, view(), distances};
  }

  /// Returns what tells kernels whether a list is nearly full.
  ListRoom room() const {
    const ListStatus* status = status_.data();
    return {&status->noted, &status->contacts, ListRoom::full(noted_capacity_), ListRoom::full(capacity_)};
  }

  /// Host only: if the flag is set, enlarges each list that was too small to 1.5 times the needed size, clears the flag
  /// and returns true. Lists are empty until the next detection. If pairs had no room, only their list grows: which
  /// contacts the others gave depends on the order of threads. Throws compare::ResourceError if a list would need more
  /// than ListRoom::largest items.
  bool grow() {
    const ListStatus status = downloaded();
    if (status.overflow == 0) return false;
    const bool has_all = status.noted <= noted_capacity_;
    const int contacts = status.without_slot > 0 ? std::max(status.contacts + status.without_slot, capacity_ + 1)
                                                 : status.contacts;
    grow_above(capacity_, has_all ? contacts : 0, noted_capacity_, status.noted);
    return true;
  }

  /// Host only: enlarges each list that is nearly full after a complete detection to 1.5 times its count. Returns
  /// whether one was; then lists are empty until the next detection. Throws as `grow` does.
  bool make_room() {
    const ListStatus status = downloaded();
    const int full = ListRoom::full(capacity_), full_noted = ListRoom::full(noted_capacity_);
    const bool is_short = status.overflow == 0 && (status.contacts > full || status.noted > full_noted);
    if (is_short) grow_above(full, status.contacts, full_noted, status.noted);
    return is_short;
  }

  /// Host only: sets the capacities exactly. Lists are empty until the next detection.
  void reserve(int capacity, int noted_capacity) {
    resize(capacity, noted_capacity);
    status_.fill_zero();
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  static constexpr int least_noted = 1 << 16;  // half a mebibyte

  static int within_limit(std::int64_t items) {
    return static_cast<int>(std::min<std::int64_t>(items, ListRoom::largest));
  }

  ListStatus downloaded() const {
    ListStatus status;
    status_.download(&status, 1);
    return status;
  }

  // Enlarges a list whose count exceeds `full` to 1.5 times the count, or to the limit if that is less.
  void grow_above(int full, int contacts, int full_noted, int noted) {
    if (std::max(contacts, noted) > ListRoom::largest)
      throw compare::ResourceError("a detection found " + std::to_string(noted) +
                                   " pairs of faces near each other and " + std::to_string(contacts) +
                                   " contacts, more than " + std::to_string(ListRoom::largest) +
                                   "; give a smaller contact_radius, or larger triangles");
    const auto grown = [](int capacity, int above, int count) {
      return count > above ? within_limit(count + std::int64_t{count} / 2) : capacity;
    };
    resize(grown(capacity_, full, contacts), grown(noted_capacity_, full_noted, noted));
    status_.fill_zero();
  }

  void resize(int capacity, int noted_capacity) {
    capacity_ = capacity;
    noted_capacity_ = noted_capacity;
    const auto n = static_cast<std::size_t>(capacity);
    noted_.resize(static_cast<std::size_t>(noted_capacity));
    entered_.resize(n), bucketed_.resize(n), vertex_facet_.resize(n), vertex_facet_face_.resize(n),
        edge_edge_.resize(n);
    loose_.resize(4 * n), incidences_.resize(4 * n);
    table_.resize(std::bit_ceil(2 * n));
    table_.fill_zero();  // a detection that overflowed left contacts in it
    for (Buffer<int>* counts : {&record_counts_, &record_offsets_, &record_filled_, &incidence_counts_,
                                &incidence_offsets_, &incidence_filled_}) {
      counts->fill_zero();
    }
  }

  SurfaceView surface_;
  int buckets_, capacity_, noted_capacity_;
  const int* places_ = nullptr;
  Readers readers_;
  Buffer<ListStatus> status_;
  Buffer<NotedPair> noted_;
  Buffer<ContactSlot> table_;
  Buffer<EnteredContact> entered_;
  Buffer<RawContact> bucketed_;
  Buffer<int> record_counts_, record_offsets_, record_filled_, vertex_facet_face_;
  Buffer<int> incidence_counts_, incidence_offsets_, incidence_filled_;
  Buffer<VertexFacetRecord> vertex_facet_;
  Buffer<EdgeEdgeRecord> edge_edge_;
  Buffer<LooseIncidence> loose_;
  Buffer<Incidence> incidences_;
};

}  // namespace ogc::fast

// Memory and launches of the growing lists. Capacity is a state: a detection that finds no room sets the overflow flag
// and says how much it needs; the host grows the lists and the step is repeated. Nothing is dropped, and nothing waits
// for the host in between.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "fast/kernels/collect_contacts.hpp"
#include "fast/kernels/lists.hpp"

namespace ogc::fast {

template <class Backend>
class Lists {
 public:
  /// `capacity` > 0: contacts at first.
  Lists(const SurfaceView& surface, int capacity)
      : surface_(surface), buckets_(2 * surface.vertex_count + surface.edge_count) {
    const auto buckets = static_cast<std::size_t>(buckets_), vertices = static_cast<std::size_t>(surface.vertex_count);
    status_.resize(status_count);
    status_.fill_zero();
    for (Buffer<int>* counts : {&record_counts_, &record_filled_}) counts->resize(buckets);
    for (Buffer<int>* counts : {&incidence_counts_, &incidence_filled_}) counts->resize(vertices);
    record_offsets_.resize(buckets + 1), incidence_offsets_.resize(vertices + 1);
    resize(capacity, least_noted + 4 * capacity);
  }

  ListsView view() {
    int* status = status_.data();
    const auto slot_mask = static_cast<std::uint32_t>(table_.size() - 1);
    return {noted_.data(),
            noted_capacity_,
            status + 3,
            table_.data(),
            slot_mask,
            entered_.data(),
            bucketed_.data(),
            capacity_,
            status,
            status + 4,
            status + 1,
            buckets_,
            record_counts_.data(),
            record_offsets_.data(),
            record_filled_.data(),
            status + 2,
            vertex_facet_.data(),
            vertex_facet_face_.data(),
            edge_edge_.data(),
            incidence_counts_.data(),
            incidence_offsets_.data(),
            incidence_filled_.data(),
            loose_.data(),
            incidences_.data()};
  }

  const int* vertex_facet_count() const { return record_offsets_.data() + surface_.vertex_count; }
  const int* edge_edge_count() const { return status_.data() + 2; }
  const int* overflow() const { return status_.data() + 1; }
  int capacity() const { return capacity_; }
  int noted_capacity() const { return noted_capacity_; }

  /// After both searches: noted pairs to records and incidences. Beside them, because neither needs the other:
  /// beside(i) for 0 ≤ i < beside_count with the first launch, and after(i) for 0 ≤ i < after_count with the last, when
  /// overflow(), the incidences' rows and what stands in each are known, but not the order in them; resolve as in
  /// RankIncidences. `planes`: see CollectContacts.
  template <class Beside, class After, class Resolve>
  void assemble(Backend& backend, Places positions, float contact_radius, int beside_count, const Beside& beside,
                int after_count, const After& after, const Resolve& resolve, const PairPlane* planes = nullptr) {
    const ListsView lists = view();
    backend.for_both(
        beside_count, beside, lists.noted_count, noted_capacity_,
        CollectContacts{{surface_, positions, contact_radius}, {surface_, positions, contact_radius}, lists, planes});
    backend.exclusive_scans({lists.record_counts, lists.record_offsets, buckets_},
                            {lists.incidence_counts, lists.incidence_offsets, surface_.vertex_count});
    backend.for_both(1, CheckCapacity{lists}, lists.cursor, capacity_, FillBuckets{lists, surface_.vertex_count});
    backend.for_each_counted(lists.cursor, capacity_, WriteRecords{lists, {surface_}});
    backend.for_both(after_count, after, lists.incidence_offsets + surface_.vertex_count, 4 * capacity_,
                     RankIncidences<Resolve>{lists, resolve});
  }

  /// Host only: where the flag is set, enlarges each list that was too small to what was needed and half as much again,
  /// clears the flag and returns true. Sets are empty until the next detection.
  bool grow() {
    int status[status_count];
    status_.download(status, status_count);
    if (status[1] == 0) return false;
    const int without_slot = status[4], contacts = status[0] + without_slot;
    const auto grown = [](int capacity, int count) { return count > capacity ? count + count / 2 : capacity; };
    resize(grown(capacity_, without_slot > 0 ? std::max(contacts, capacity_ + 1) : contacts),
           grown(noted_capacity_, status[3]));
    status_.fill_zero();
    return true;
  }

  /// Host only: these capacities and no other; sets are empty until the next detection.
  void reserve(int capacity, int noted_capacity) { resize(capacity, noted_capacity); }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  static constexpr int least_noted = 1 << 16;  // half a mebibyte
  static constexpr int status_count = 5;

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
  Buffer<int> status_;  ///< contacts entered, overflow, edge–edge records, noted pairs, contacts without a slot
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

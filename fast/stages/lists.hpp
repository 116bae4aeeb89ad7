// Memory and launches of the growing lists. Capacity is a state: a detection that finds no room sets the overflow flag and says how much it needs; the
// host grows the lists and the step is repeated. Nothing is dropped, and nothing waits for the host in between.
#pragma once

#include <algorithm>
#include <cstddef>

#include "fast/kernels/lists.hpp"

namespace ogc::fast {

template <class Backend>
class Lists {
 public:
  Lists(const SurfaceView& surface, int capacity) : surface_(surface), buckets_(2 * surface.vertex_count + surface.edge_count) {
    const auto buckets = static_cast<std::size_t>(buckets_), vertices = static_cast<std::size_t>(surface.vertex_count);
    status_.resize(4);
    status_.fill_zero();
    for (Buffer<int>* counts : {&raw_counts_, &raw_filled_, &record_counts_}) counts->resize(buckets);
    for (Buffer<int>* offsets : {&raw_offsets_, &record_offsets_}) offsets->resize(buckets + 1);
    for (Buffer<int>* counts : {&incidence_counts_, &incidence_filled_}) counts->resize(vertices);
    incidence_offsets_.resize(vertices + 1);
    resize(std::max(1, capacity));
  }

  ListsView view() {
    int* status = status_.data();
    return {raw_.data(),           sorted_.data(),         capacity_,          status,
            status + 1,            status + 2,             buckets_,           raw_counts_.data(),
            raw_offsets_.data(),   raw_filled_.data(),     record_counts_.data(), record_offsets_.data(),
            status + 3,            vertex_facet_.data(),   vertex_facet_face_.data(), edge_edge_.data(),
            incidence_counts_.data(), incidence_offsets_.data(), incidence_filled_.data(), incidences_.data()};
  }

  const int* vertex_facet_count() const { return record_offsets_.data() + surface_.vertex_count; }
  const int* edge_edge_count() const { return status_.data() + 3; }
  const int* overflow() const { return status_.data() + 1; }
  int capacity() const { return capacity_; }

  /// After both queries: raw contacts to records and incidences.
  void assemble(Backend& backend) {
    const ListsView lists = view();
    backend.for_each(1, CheckCapacity{lists});
    backend.exclusive_scan(lists.raw_counts, lists.raw_offsets, buckets_);
    backend.for_each_counted(lists.cursor, capacity_, FillBuckets{lists});
    backend.for_each(buckets_, SortBuckets{lists});
    backend.exclusive_scan(lists.record_counts, lists.record_offsets, buckets_);
    backend.for_each(buckets_, WriteRecords{lists, surface_});
    backend.exclusive_scan(lists.incidence_counts, lists.incidence_offsets, surface_.vertex_count);
    backend.for_each_counted(lists.record_offsets + buckets_, capacity_, FillIncidences{lists, surface_});
    backend.for_each(surface_.vertex_count, SortIncidences{lists});
  }

  /// Host only: where the flag is set, enlarges the lists to what was needed and half as much again, clears the flag and returns true. Sets are empty
  /// until the next detection.
  bool grow() {
    int status[4];
    status_.download(status, 4);
    if (status[1] == 0) return false;
    resize(status[2] + status[2] / 2);
    status_.fill_zero();
    return true;
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  void resize(int capacity) {
    capacity_ = capacity;
    const auto n = static_cast<std::size_t>(capacity);
    raw_.resize(n), sorted_.resize(n), vertex_facet_.resize(n), vertex_facet_face_.resize(n), edge_edge_.resize(n);
    incidences_.resize(4 * n);
    for (Buffer<int>* counts : {&raw_counts_, &raw_offsets_, &raw_filled_, &record_counts_, &record_offsets_, &incidence_counts_, &incidence_offsets_,
                                &incidence_filled_}) {
      counts->fill_zero();
    }
  }

  SurfaceView surface_;
  int buckets_, capacity_ = 0;
  Buffer<int> status_;  ///< cursor, overflow, needed, edge–edge records
  Buffer<RawContact> raw_, sorted_;
  Buffer<int> raw_counts_, raw_offsets_, raw_filled_, record_counts_, record_offsets_, vertex_facet_face_;
  Buffer<int> incidence_counts_, incidence_offsets_, incidence_filled_;
  Buffer<VertexFacetRecord> vertex_facet_;
  Buffer<EdgeEdgeRecord> edge_edge_;
  Buffer<Incidence> incidences_;
};

}  // namespace ogc::fast

// Runs a detection for the judge's probes and for ContactFinder, and repeats it with larger lists until all contacts
// have room. The simulation repeats whole steps instead.
#pragma once

#include <optional>
#include <span>

#include "fast/contact_sets.hpp"
#include "fast/probes/contact_columns.hpp"
#include "fast/probes/download.hpp"

namespace ogc::fast {

/// Runs the detections of one surface on one backend.
template <class Backend>
class BackendContactEngine : public ContactEngine {
 public:
  /// `topology` must outlive the engine. `capacity`: number of contacts for which the lists have room at first; 0:
  /// estimated from the size of the mesh.
  BackendContactEngine(Backend& backend, const compare::Topology& topology, const compare::ExclusionView& exclusions,
                       int capacity = 0)
      : backend_(backend), topology_(topology), detection_(backend, topology, exclusions, capacity) {}

  ContactSets find(std::span<const compare::Vec3f> positions, const ContactQuery& query) override {
    positions_.upload(reinterpret_cast<const Vec*>(positions.data()), positions.size());
    run(positions_.data(), query);
    return download_contacts(backend_, detection_, topology_);
  }

  ContactColumns find_columns(std::span<const compare::Vec3f> positions, const ContactQuery& query) override {
    positions_.upload(reinterpret_cast<const Vec*>(positions.data()), positions.size());
    run(positions_.data(), query);
    return columns();
  }

  ContactColumns find_columns_resident(const compare::Vec3f* positions, const ContactQuery& query) override {
    run(reinterpret_cast<const Vec*>(positions), query);
    return columns();
  }

  ContactView find_resident(const compare::Vec3f* positions, const ContactQuery& query) override {
    run(reinterpret_cast<const Vec*>(positions), query);
    return detection_.view();
  }

  const Detection<Backend>& detection() const { return detection_; }

 private:
  void run(const Vec* positions, const ContactQuery& query) {
    query_radius_.upload(&query.query_radius, 1);
    detection_.rebuild(positions);
    do {
      detection_.detect(positions, query.contact_radius, query_radius_.data(), query.bounds_relaxation);
      backend_.synchronize();
    } while (detection_.grow());
  }

  ContactColumns columns() {
    if (!writer_) writer_.emplace(backend_, topology_);
    return writer_->columns_of(detection_, query_radius_.data());
  }

  Backend& backend_;
  const compare::Topology& topology_;
  Detection<Backend> detection_;
  typename Backend::template Buffer<Vec> positions_;
  typename Backend::template Buffer<float> query_radius_;
  std::optional<ColumnWriter<Backend>> writer_;  // made at the first use
};

}  // namespace ogc::fast

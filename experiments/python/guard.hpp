// A guard as Python sees it.
#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "experiments/python/arrays.hpp"
#include "experiments/python/state_view.hpp"
#include "fast/guard.hpp"

namespace ogc::python {

/// A guard that several threads may call, one after the other is served.
class Guard : public StateOwner {
 public:
  Guard(const fast::Mesh& mesh, std::span<const compare::Vec3f> x, const fast::GuardOptions& options,
        fast::Backend backend)
      : backend_(backend), guard_(mesh, x, options, backend) {}

  fast::Backend backend() const { return backend_; }
  /// Returns where arrays may lie.
  Place place() const { return backend_ == fast::Backend::cuda ? Place::either : Place::host; }
  const fast::Mesh& mesh() const { return guard_.mesh(); }
  float radius() const { return guard_.options().contact_radius; }
  fast::GuardReport report() const {
    const std::lock_guard lock(reporting_);
    return report_;
  }
  void step(std::span<const compare::Vec3f> x, std::span<const compare::Vec3f> dx, std::span<compare::Vec3f> out) {
    const std::lock_guard lock(busy_);
    wait_for_readers();
    keep(guard_.step(x, dx, out));
    note_overwritten();  // a step that throws leaves the state as it was
  }
  void step_on_device(const compare::Vec3f* x, const compare::Vec3f* dx, compare::Vec3f* out) {
    const std::lock_guard lock(busy_);
    wait_for_readers();
    keep(guard_.step_resident(x, dx, out));
    note_overwritten();
  }
  void reset(std::span<const compare::Vec3f> x, bool is_on_device) {
    const std::lock_guard lock(busy_);
    wait_for_readers();
    note_overwritten();
    is_on_device ? guard_.reset_resident(x.data()) : guard_.reset(x);
  }
  void detect() {
    const std::lock_guard lock(busy_);
    guard_.detect();
  }
  /// Calls use(guard) while no other thread uses the guard.
  template <class Use>
  void lend(const Use& use) {
    const std::lock_guard lock(busy_);
    use(std::as_const(guard_));
  }
  const compare::Vec3f* lend_rows(StateField, std::uint64_t version) override {
    const std::lock_guard lock(busy_);
    expect(version);
    note_lent();
    return guard_.positions_resident();
  }
  std::vector<compare::Vec3f> copy_rows(StateField, std::uint64_t version) override {
    const std::lock_guard lock(busy_);
    expect(version);
    return guard_.positions();
  }
  int device_number() const { return guard_.device_number(); }

 private:
  void wait_for_readers() {
    if (is_lent()) guard_.wait_for_device();
  }
  void keep(const fast::GuardReport& report) {
    const std::lock_guard lock(reporting_);
    report_ = report;
  }

  fast::Backend backend_;
  fast::Guard guard_;
  fast::GuardReport report_;
  std::mutex busy_;
  mutable std::mutex reporting_;  // of its own, so that a report waits for no step
};

}  // namespace ogc::python

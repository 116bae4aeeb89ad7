// Runs a simulation that several backends divide (fast/kernels/parts.hpp): one thread for each part.
#pragma once

#include <exception>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "fast/stages/divisible.hpp"
#include "fast/stages/simulation.hpp"

namespace ogc::fast {

/// The parts of a simulation. `Make(p)` returns the backend of part p, and is called in the part's thread; `Enter(p)`
/// prepares a thread for part p.
template <class Backend, class Enter>
class PartedSimulation : public compare::Simulation, public ResidentState {
 public:
  template <class Make>
  PartedSimulation(int parts, Enter enter, const Make& make, const compare::Scene& scene,
                   const compare::SimulationOptions& options, const std::string& device, int list_capacity)
      : enter_(std::move(enter)), device_(device), parts_(static_cast<std::size_t>(parts)) {
    expect_divisible(scene);
    hall_ = std::make_shared<Hall>(parts);
    each([&](int p) {
      parts_[static_cast<std::size_t>(p)] = std::make_unique<ResidentSimulation<Backend>>(
          make(p), scene, options, device, list_capacity, hall_, p);
    });
  }
  PartedSimulation(const PartedSimulation&) = delete;
  PartedSimulation& operator=(const PartedSimulation&) = delete;

  /// All parts compute the same rows; those of the first part are returned.
  std::vector<compare::StepMetrics> advance(std::int64_t steps) override {
    std::vector<compare::StepMetrics> rows;
    each([&](int p) {
      auto own = part(p).advance(steps);
      if (p == 0) rows = std::move(own);
    });
    return rows;
  }
  compare::Snapshot snapshot() override {
    return of_first([](auto& first) { return first.snapshot(); });
  }
  void restore(const compare::Snapshot& snapshot) override {
    each([&](int p) { part(p).restore(snapshot); });
  }
  std::vector<std::string> stage_names() const override { return parts_.front()->stage_names(); }
  std::string device() const override { return device_; }

  const compare::Vec3f* positions_resident() const override { return parts_.front()->positions_resident(); }
  const compare::Vec3f* velocities_resident() const override { return parts_.front()->velocities_resident(); }
  std::vector<compare::Vec3f> positions() const override { return parts_.front()->positions(); }
  std::vector<compare::Vec3f> velocities() const override { return parts_.front()->velocities(); }
  int device_number() const override { return parts_.front()->device_number(); }
  void wait_for_device() override { parts_.front()->wait_for_device(); }

 private:
  ResidentSimulation<Backend>& part(int p) { return *parts_[static_cast<std::size_t>(p)]; }

  /// Calls f(p) for each part in a thread of its own. Throws what the first part threw that failed by itself.
  template <class F>
  void each(const F& f) {
    if (failure_ != nullptr) std::rethrow_exception(failure_);
    std::vector<std::exception_ptr> failures(parts_.size());
    std::vector<std::thread> threads;
    for (int p = 0; p < static_cast<int>(parts_.size()); ++p) {
      threads.emplace_back([&, p] {
        try {
          enter_(p);
          f(p);
        } catch (const PartFailed&) {
        } catch (...) {
          failures[static_cast<std::size_t>(p)] = std::current_exception();
          hall_->fail();
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::exception_ptr& failure : failures) {
      if (failure == nullptr) continue;
      failure_ = failure;
      std::rethrow_exception(failure);
    }
  }
  /// Returns f of the first part, in a thread of this part.
  template <class F>
  auto of_first(const F& f) {
    decltype(f(part(0))) result;
    each([&](int p) {
      if (p == 0) result = f(part(0));
    });
    return result;
  }

  Enter enter_;
  std::string device_;
  std::shared_ptr<Hall> hall_;
  std::vector<std::unique_ptr<ResidentSimulation<Backend>>> parts_;
  std::exception_ptr failure_;  ///< after it nothing goes on, because the parts no longer have the same state
};

}  // namespace ogc::fast

// Lets other code read the state of a simulation where the backend keeps it, without a copy.
#pragma once

#include <vector>

#include "compare/contestant.hpp"

namespace ogc::fast {

/// The state of a simulation that Contestant::start of a contestant of this library has started. One vector for each
/// vertex of the scene. Only one thread at a time may use it or the simulation.
///
/// Functions whose names end in `_resident` return pointers to the backend's memory (device memory for Backend::cuda).
/// The memory lives as long as the simulation. Its content is complete, so work of any stream may read it; it is valid
/// until the simulation advances or is restored, which do not wait for this work. So call `wait_for_device` before.
class ResidentState {
 public:
  virtual ~ResidentState() = default;
  /// Return positions [m] and velocities [m/s] at the end of the last step.
  virtual const compare::Vec3f* positions_resident() const = 0;
  virtual const compare::Vec3f* velocities_resident() const = 0;
  /// Return copies of them on the host.
  virtual std::vector<compare::Vec3f> positions() const = 0;
  virtual std::vector<compare::Vec3f> velocities() const = 0;
  /// Returns the number of the CUDA device with the memory; −1: it is the host's.
  virtual int device_number() const = 0;
  /// Waits for all work that the device has been given, of any stream.
  virtual void wait_for_device() = 0;
};

/// Returns the state of a simulation; it lives as long as the simulation. Throws std::invalid_argument if the
/// simulation is of another library.
ResidentState& resident_state(compare::Simulation& simulation);

}  // namespace ogc::fast

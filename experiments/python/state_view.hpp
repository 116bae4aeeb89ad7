// Rows of a state that lie where a backend computes, as Python sees them. Calls of the object that has the state
// overwrite it; a view of what is overwritten refuses to be read.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <nanobind/nanobind.h>

#include "compare/problem/vector.hpp"

namespace ogc::python {

/// What a state consists of.
enum class StateField { positions, velocities };

/// An object with a state. Its functions may be called by several threads, one after the other is served.
class StateOwner {
 public:
  virtual ~StateOwner() = default;
  /// Returns how often the state has been overwritten.
  std::uint64_t version() const { return version_; }
  /// Returns the rows of the state in the memory of the backend, for others to read. What overwrites it from now on
  /// waits for the device's work before. Throws nanobind::buffer_error if the state was overwritten since `version`.
  virtual const compare::Vec3f* lend_rows(StateField field, std::uint64_t version) = 0;
  /// Returns a copy on the host. Throws as `lend_rows` does.
  virtual std::vector<compare::Vec3f> copy_rows(StateField field, std::uint64_t version) = 0;

 protected:
  /// Throws nanobind::buffer_error if the state was overwritten since `version`.
  void expect(std::uint64_t version) const {
    if (version != version_)
      throw nanobind::buffer_error(
          "this view is of a state that a later call has overwritten; take the property anew, or keep view.cpu(), a "
          "copy");
  }
  /// Notes that others may read the state.
  void note_lent() { is_lent_ = true; }
  /// Returns whether others may read the state, so that what overwrites it must wait for the device before.
  bool is_lent() const { return is_lent_; }
  /// Notes that the state is, or will be, another one.
  void note_overwritten() { ++version_; }

 private:
  std::atomic<std::uint64_t> version_ = 0;
  bool is_lent_ = false;  // for good, because nobody tells when the last reader ends
};

/// A view of the present state of `owner`.
struct StateView {
  nanobind::object owner;  ///< keeps `state` alive
  StateOwner* state = nullptr;
  StateField field = StateField::positions;
  std::size_t count = 0;  ///< number of vertices
  int device = -1;        ///< number of the CUDA device; −1: the host
  std::uint64_t version = 0;
};

}  // namespace ogc::python

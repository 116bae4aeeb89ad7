// Where the parts of a simulation (fast/kernels/parts.hpp) meet on the host. Each part has a thread of its own.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "fast/kernels/parts.hpp"

namespace ogc::fast {

/// Tells a part that another one has failed.
struct PartFailed : std::runtime_error {
  PartFailed() : std::runtime_error("another part of the simulation has failed") {}
};

/// Lets the threads of all parts wait for each other, and holds what they tell each other in between.
class Hall {
 public:
  explicit Hall(int parts) : arrays(at(parts)), devices(at(parts)), inbox_flags(at(parts)), parts_(parts) {}

  int parts() const { return parts_; }
  /// Waits until all parts have called it. Throws PartFailed once fail() has been called.
  void meet() {
    std::unique_lock lock(mutex_);
    const std::uint64_t meeting = meetings_;
    if (++present_ == parts_) {
      present_ = 0;
      ++meetings_;
      all_here_.notify_all();
    }
    all_here_.wait(lock, [&] { return meetings_ != meeting || has_failed_; });
    if (has_failed_) throw PartFailed();
  }
  /// Sends all parts away that wait, now and later.
  void fail() {
    const std::lock_guard lock(mutex_);
    has_failed_ = true;
    all_here_.notify_all();
  }

  // A part writes its own item, and reads the others after the next meeting.
  std::vector<PartArrays> arrays;           ///< by part
  std::vector<int> devices;                 ///< by part: number of its CUDA device
  std::vector<std::uint32_t*> inbox_flags;  ///< by part: MeetingPlace::flags on its device

 private:
  static std::size_t at(int parts) { return static_cast<std::size_t>(parts); }

  std::mutex mutex_;
  std::condition_variable all_here_;
  int parts_, present_ = 0;
  std::uint64_t meetings_ = 0;
  bool has_failed_ = false;
};

}  // namespace ogc::fast

// Begins and ends a frame: sets the control, and reports it to the host.
#pragma once

#include "fast/kernels/control.hpp"

namespace ogc::fast {

/// Sets the control for the first step of a frame.
struct BeginFrame {
  StepControl* control;  ///< on the backend
  int since_sort;        ///< steps begun since the last sort of the trees

  OGC_HD void operator()(int) const {
    StepControl first;
    first.active = 1;
    first.since_sort = since_sort;
    *control = first;
  }
};

/// Copies the control to where the host reads it.
struct EndFrame {
  const StepControl* control;  ///< on the backend
  StepControl* report;         ///< on the backend, one item

  OGC_HD void operator()(int) const { *report = *control; }
};

}  // namespace ogc::fast

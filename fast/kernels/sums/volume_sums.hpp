// Adds up the sums of a step of a scene with volumes.
#pragma once

#include "fast/kernels/sums/step_sums.hpp"
#include "fast/kernels/volumes/stream.hpp"

namespace ogc::fast {

/// Sums what EnergySums sums, and the energies of contacts with volumes.
struct VolumeSums {
  EnergySums energies;
  VolumeTerm volume;
  int rows;  ///< rows of contacts with volumes

  /// Adds every `chunks`-th term, beginning with term `chunk`.
  OGC_HD void add(int chunk, int chunks, double* sums) const {
    energies.add(chunk, chunks, sums);
    add_terms(volume, rows, chunk, chunks, sums);
  }
};

}  // namespace ogc::fast

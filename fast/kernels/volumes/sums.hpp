// What a step sums up where there are volumes.
#pragma once

#include "fast/kernels/step_sums.hpp"
#include "fast/kernels/volumes/stream.hpp"

namespace ogc::fast {

/// Energies, those of contacts with volumes included.
struct VolumeSums {
  EnergySums energies;
  VolumeTerm volume;
  int rows;  ///< of its contacts

  /// Those of one chunk.
  OGC_HD void add(int chunk, int chunks, double* sums) const {
    energies.add(chunk, chunks, sums);
    add_terms(volume, rows, chunk, chunks, sums);
  }
};

}  // namespace ogc::fast

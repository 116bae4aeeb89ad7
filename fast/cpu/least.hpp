// Finds the least numbers of a row in one thread. fast/cuda/least.cuh does the same with a warp.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace ogc::fast {

/// Returns the rank + 1 least numbers of values[begin] … values[end − 1] in ascending order; infinity stands for what
/// there is not.
template <int rank>
std::array<float, rank + 1> least_of_row(const float* values, int begin, int end) {
  std::array<float, rank + 1> least;
  least.fill(std::numeric_limits<float>::infinity());
  for (int k = begin; k < end; ++k) {
    if (!(values[k] < least[rank])) continue;
    int at = rank;
    for (; at > 0 && values[k] < least[static_cast<std::size_t>(at - 1)]; --at)
      least[static_cast<std::size_t>(at)] = least[static_cast<std::size_t>(at - 1)];
    least[static_cast<std::size_t>(at)] = values[k];
  }
  return least;
}

}  // namespace ogc::fast

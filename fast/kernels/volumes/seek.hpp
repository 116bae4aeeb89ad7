// Where the search of the nearest facet of a part begins. AskVolumes searches in one thread a row and part, which takes
// as long as its first limit is wide: a facet that was nearest before a body moved is a wide one. A device finds a
// narrow one first, by searches that its warps share (fast/cuda/search.cuh). Seeds decide the time alone, and the same
// whatever the order in which facets are met.
#pragma once

#include "fast/kernels/search.hpp"
#include "fast/kernels/volume_depth.hpp"

namespace ogc::fast {

/// A facet and its distance rounded to single precision, so that the least number is the nearest facet's, of equally
/// near ones the lowest-numbered.
OGC_HD inline std::uint64_t seed_of(const Distance& distance, int facet) {
  const auto bits = static_cast<std::uint32_t>(float_bits(static_cast<float>(distance.value)));
  return static_cast<std::uint64_t>(bits) << 32 | static_cast<std::uint32_t>(facet);
}
/// The facet of a seed.
OGC_HD inline int facet_of_seed(std::uint64_t seed) { return static_cast<int>(seed & 0xffffffffU); }

/// Searches of one part of triangles, a row each; a Query of fast/kernels/search.hpp.
struct SeekNearest {
  VolumeView volume;           ///< its trees refitted
  const int* askers;           ///< by row: the vertex, or −1
  int rows;                    ///< who asks
  const Vec* position;         ///< by vertex [m]
  const StepControl* control;  ///< where it is not active nothing is sought
  const int* answers;          ///< by item, part after part: facet · 4 + side of the detection before (contacts.hpp)
  std::uint64_t* seeds;        ///< by item, written
  int part = 0;                ///< that is searched

  /// The same searches in another part.
  OGC_HD SeekNearest in_part(int number) const {
    SeekNearest other = *this;
    other.part = number;
    return other;
  }
  OGC_HD bool is_off() const { return control->active == 0 || volume.parts[part].is_solid(); }

  OGC_HD Search begin(int row) const {
    const int item = part * rows + row, v = askers[row], first = answers[item] >> 2;
    Search search;
    search.owner = row;
    search.limit = -1;  // nothing is that near
    seeds[item] = static_cast<std::uint32_t>(first);
    if (v < 0) return search;
    const Vec x = position[v];
    search.box = {x, x};
    const VolumeQuestion question(volume, x);
    if (question.is_beyond(part)) return search;
    const Distance distance = question.distance_to(first);
    seeds[item] = seed_of(distance, first);
    search.limit = limit_of(distance);
    return search;
  }
  OGC_HD bool is_pair(const Search& search, const Offer& offer) const {
    return offer.gap <= search.limit &&
           !fast::is_beyond(
               separation(search.box.lower, VolumeQuestion(volume, search.box.lower).corners(offer.primitive)),
               search.limit);
  }
  OGC_HD float meet(const Search& search, int facet, float) const {
    const Distance distance = VolumeQuestion(volume, search.box.lower).distance_to(facet);
    atomic_min(&seeds[part * rows + search.owner], seed_of(distance, facet));
    return limit_of(distance);
  }

 private:
  OGC_HD static float limit_of(const Distance& distance) {
    return gap_limit(round_up(add(distance.value, distance.slack)));
  }
};

}  // namespace ogc::fast

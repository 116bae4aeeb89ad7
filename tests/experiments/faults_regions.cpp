// Plants faults of truncation by half-spaces: mistakes of other planar filters that let a vertex leave its half-spaces,
// or restrict it without need.
#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/judge/engine/exact_sum.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

double height(const Vec3f& n, const Vec3f& x) { return double{n.x} * x.x + double{n.y} * x.y + double{n.z} * x.z; }
double size(const Vec3f& n, const Vec3f& x) {
  return std::abs(double{n.x} * x.x) + std::abs(double{n.y} * x.y) + std::abs(double{n.z} * x.z);
}

/// Returns a fault that changes the input by `change(in)` if a vertex has half-spaces.
template <class Change>
Fault region_asked(const std::string& name, Change change) {
  return asked_wrongly("truncate: " + name, &Contestant::truncate, [change](TruncateIn& in) {
    if (!in.half_spaces.offsets.empty()) change(in);
  });
}

/// Returns a fault that ignores the half-spaces for which `is_lost(in, case, number)` holds.
template <class Lost>
Fault lost_half_spaces(const std::string& name, Lost is_lost) {
  return region_asked(name, [is_lost](TruncateIn& in) {
    HalfSpacesIn kept = in.half_spaces;
    kept.items.clear();
    for (std::size_t i = 0; i < in.position.size(); ++i) {
      kept.offsets[i] = static_cast<Index>(kept.items.size());
      const auto row = in.half_spaces.of(i);
      for (std::size_t k = 0; k < row.size(); ++k)
        if (!is_lost(in, i, k)) kept.items.push_back(row[k]);
    }
    kept.offsets.back() = static_cast<Index>(kept.items.size());
    in.half_spaces = std::move(kept);
  });
}

/// Returns a fault that changes the right answer by `spoil(in, case, out)` for each vertex with half-spaces.
template <class Spoil>
Fault region_spoiled(const std::string& name, Spoil spoil) {
  return spoiled("truncate: " + name, &Contestant::truncate, [spoil](const TruncateIn& in, TruncateOut& out) {
    for (std::size_t i = 0; i < in.position.size(); ++i)
      if (!in.half_spaces.of(i).empty()) spoil(in, i, out);
  });
}

/// Returns n·x in single precision.
float single_height(const Vec3f& n, const Vec3f& x) { return n.x * x.x + n.y * x.y + n.z * x.z; }

}  // namespace

std::vector<Fault> region_faults() {
  return {
      lost_half_spaces("a vertex on its plane is released",
                       [](const TruncateIn& in, std::size_t i, std::size_t k) {
                         const HalfSpace& h = in.half_spaces.of(i)[k];
                         const Vec3f& x = in.half_spaces.current[i];
                         return height(h.normal, x) >= h.offset - 0x1p-40 * size(h.normal, x);
                       }),
      lost_half_spaces("the first half-space alone",
                       [](const TruncateIn&, std::size_t, std::size_t k) { return k > 0; }),
      lost_half_spaces("half-spaces tested in single precision",
                       [](const TruncateIn& in, std::size_t i, std::size_t k) {
                         const HalfSpace& h = in.half_spaces.of(i)[k];
                         return single_height(h.normal, in.position[i]) <= static_cast<float>(h.offset);
                       }),
      region_asked("the ball ignored beside half-spaces",
                   [](TruncateIn& in) {
                     for (std::size_t i = 0; i < in.bound.size(); ++i)
                       if (!in.half_spaces.of(i).empty()) in.bound[i] = 0x1p60f;
                   }),
      region_spoiled("slid without the final test",
                     [](const TruncateIn& in, std::size_t i, TruncateOut& out) {
                       if (out.cut[i] == 0 || in.half_spaces.of(i).size() != 1) return;
                       const auto& [n, offset] = in.half_spaces.of(i)[0];
                       const double t = (height(n, out.position[i]) - offset) / height(n, n);
                       out.position[i] = {static_cast<float>(out.position[i].x - t * n.x),
                                          static_cast<float>(out.position[i].y - t * n.y),
                                          static_cast<float>(out.position[i].z - t * n.z)};
                     }),
      region_spoiled("what is cut stays where it is",
                     [](const TruncateIn& in, std::size_t i, TruncateOut& out) {
                       if (out.cut[i] != 0) out.position[i] = in.half_spaces.current[i];
                     }),
      region_spoiled("a way along a half-space halved",
                     [](const TruncateIn& in, std::size_t i, TruncateOut& out) {
                       const Vec3f& x = in.half_spaces.current[i];
                       const auto is_on = [&](const HalfSpace& h) {
                         return height(h.normal, x) >= h.offset - 0x1p-40 * size(h.normal, x);
                       };
                       if (out.cut[i] == 0 || in.half_spaces.is_prescribed[i] == 0) return;
                       if (std::ranges::none_of(in.half_spaces.of(i), is_on)) return;
                       Vec3f& to = out.position[i];
                       to = {0.5f * (x.x + to.x), 0.5f * (x.y + to.y), 0.5f * (x.z + to.z)};
                     }),
      region_spoiled("vertices that half-spaces cut are not counted",
                     [](const TruncateIn& in, std::size_t i, TruncateOut& out) {
                       out.cut[i] = obeys_bound(in.position[i], in.previous[i], in.bound[i]) ? 0 : 1;
                     }),
  };
}

}  // namespace ogc::tests

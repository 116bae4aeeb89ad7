// Plants faults of bound and truncate: a relative error of 1 %, an error in the last bit, and wrong forms of truncate.
#include <cmath>
#include <limits>

#include "compare/stages/bound.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

template <class Spoil>
Fault truncate_fault(const std::string& name, Spoil spoil) {
  return spoiled("truncate: " + name, &Contestant::truncate, [spoil](const TruncateIn& in, TruncateOut& out) {
    for (std::size_t i = 0; i < in.position.size(); ++i) spoil(in, i, out);
  });
}

float outwards(float x, float from) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  return x == from ? x : std::nextafter(x, x > from ? infinity : -infinity);
}

}  // namespace

std::vector<Fault> scalar_faults() {
  return {
      spoiled("bound: 1 % too large", &Contestant::bound,
              [](const BoundIn&, BoundOut& out) {
                for (float& b : out.bound) b *= 1.01f;
              }),
      truncate_fault("flag inverted", [](const auto&, std::size_t i, TruncateOut& out) { out.cut[i] = !out.cut[i]; }),
      truncate_fault("one ulp too far",
                     [](const auto& in, std::size_t i, TruncateOut& out) {
                       Vec3f& x = out.position[i];
                       const Vec3f& p = in.previous[i];
                       if (out.cut[i]) x = {outwards(x.x, p.x), outwards(x.y, p.y), outwards(x.z, p.z)};
                     }),
      truncate_fault("not truncated",
                     [](const auto& in, std::size_t i, TruncateOut& out) { out.position[i] = in.position[i]; }),
      truncate_fault("stale position copied",
                     [](const auto& in, std::size_t i, TruncateOut& out) {
                       if (out.cut[i]) out.position[i] = in.previous[i];
                     }),
      truncate_fault("untouched positions recomputed", [](const auto& in, std::size_t i, TruncateOut& out) {
        Vec3f& x = out.position[i];
        if (!out.cut[i]) x.x = in.previous[i].x + (x.x - in.previous[i].x);
      })};
}

}  // namespace ogc::tests

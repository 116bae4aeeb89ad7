// Plants faults of ccd and barrier: errors in the last bit, small relative errors, and faults that few cases reveal.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

template <class Spoil>
Fault of_time(const std::string& name, Spoil spoil) {
  return spoiled("ccd: " + name, &Contestant::ccd, [spoil](const CcdIn& in, CcdOut& out) {
    for (std::size_t i = 0; i < in.cases.size(); ++i) spoil(in.cases[i], out.time[i]);
  });
}

/// Returns a fault that answers `time(impact)`, at most 1, in place of the exact time of impact rounded down.
Fault of_impact(const std::string& name, float (*time)(double)) {
  return {"ccd: " + name, Stage::ccd, [time](Contestant& contestant, const Authority& authority) {
            contestant.ccd = [ask = authority.ccd, time](const CcdIn& in) {
              CcdOut out;
              for (const double impact : ask(in).impact) out.time.push_back(std::min(time(impact), 1.0f));
              return out;
            };
          }};
}

template <class Spoil>
Fault of_barrier(const std::string& name, Spoil spoil) {
  return spoiled("barrier: " + name, &Contestant::barrier, [spoil](const BarrierIn& in, BarrierOut& out) {
    for (std::size_t i = 0; i < in.cases.size(); ++i) spoil(in.cases[i], out.energy[i], out.curvature[i]);
  });
}

bool is_beyond_support(const BarrierCase& c) {
  const double d = c.activation_distance, xi = c.thickness;
  return double{c.squared_distance} >= (d + xi) * (d + xi);
}

}  // namespace

std::vector<Fault> ipc_faults() {
  return {
      of_impact("rounded to the nearest, later in half of all cases",
                [](double impact) { return static_cast<float>(impact); }),
      of_impact("a millionth late", [](double impact) { return static_cast<float>(impact * (1 + 1e-6)); }),
      of_impact("a tenth of the time", [](double impact) { return impact < 1 ? static_cast<float>(0.1 * impact) : 1; }),
      of_time("faces that touch at the start let through",
              [](const CcdCase&, float& time) {
                if (time == 0) time = 1;
              }),
      of_time("no number where nothing moves",
              [](const CcdCase& c, float& time) {
                if (c.from == c.to) time = std::numeric_limits<float>::quiet_NaN();
              }),
      of_barrier("0.001 % too large", [](const BarrierCase&, float& b, float&) { b *= 1.00001f; }),
      of_barrier("acts beyond its end", [](const BarrierCase& c, float&, float& curvature) {
        if (is_beyond_support(c)) curvature = 1;
      })};
}

}  // namespace ogc::tests

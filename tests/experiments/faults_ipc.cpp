// Faults of ccd and barrier.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

Fault of_time(const std::string& name, const std::function<void(const CcdCase&, float&)>& spoil) {
  return {"ccd: " + name, Stage::ccd, [spoil](Contestant& contestant, const Authority&) {
            contestant.ccd = [right = contestant.ccd, spoil](const CcdIn& in) {
              CcdOut out = right(in);
              for (std::size_t i = 0; i < in.cases.size(); ++i) spoil(in.cases[i], out.time[i]);
              return out;
            };
          }};
}

Fault of_motion(const std::string& name, const std::function<void(CcdCase&)>& change) {
  return {"ccd: " + name, Stage::ccd, [change](Contestant& contestant, const Authority&) {
            contestant.ccd = [right = contestant.ccd, change](const CcdIn& in) {
              CcdIn other = in;
              for (CcdCase& c : other.cases) change(c);
              return right(other);
            };
          }};
}

/// `time(impact)` in place of the time that is rounded down.
Fault of_impact(const std::string& name, const std::function<float(double)>& time) {
  return {"ccd: " + name, Stage::ccd, [time](Contestant& contestant, const Authority& authority) {
            contestant.ccd = [ask = authority.ccd, time](const CcdIn& in) {
              CcdOut out;
              for (const double impact : ask(in).impact) out.time.push_back(std::min(time(impact), 1.0f));
              return out;
            };
          }};
}

Fault of_barrier(const std::string& name,
                 const std::function<void(const BarrierCase&, float& b, float& slope, float& curvature)>& spoil) {
  return {"barrier: " + name, Stage::barrier, [spoil](Contestant& contestant, const Authority&) {
            contestant.barrier = [right = contestant.barrier, spoil](const BarrierIn& in) {
              BarrierOut out = right(in);
              for (std::size_t i = 0; i < in.cases.size(); ++i)
                spoil(in.cases[i], out.energy[i], out.slope[i], out.curvature[i]);
              return out;
            };
          }};
}

Fault of_distance(const std::string& name, const std::function<void(BarrierCase&)>& change) {
  return {"barrier: " + name, Stage::barrier, [change](Contestant& contestant, const Authority&) {
            contestant.barrier = [right = contestant.barrier, change](const BarrierIn& in) {
              BarrierIn other = in;
              for (BarrierCase& c : other.cases) change(c);
              return right(other);
            };
          }};
}

bool is_nearly_parallel(const CcdCase& c) {
  const auto side = [&](std::size_t i, std::size_t j, auto member) {
    return double{c.from[j].*member} - double{c.from[i].*member};
  };
  const double ex = side(0, 1, &Vec3f::x), ey = side(0, 1, &Vec3f::y), ez = side(0, 1, &Vec3f::z);
  const double fx = side(2, 3, &Vec3f::x), fy = side(2, 3, &Vec3f::y), fz = side(2, 3, &Vec3f::z);
  const double x = ey * fz - ez * fy, y = ez * fx - ex * fz, z = ex * fy - ey * fx;
  return x * x + y * y + z * z <= 1e-6 * (ex * ex + ey * ey + ez * ez) * (fx * fx + fy * fy + fz * fz);
}

/// (H − g)/g where the barrier acts, else 0.
double depth_by_gap(const BarrierCase& c) {
  const double d = c.activation_distance, xi = c.thickness, gap = double{c.squared_distance} - xi * xi;
  return std::max(d * (d + 2 * xi) - gap, 0.0) / gap;
}

float rounded_down(double x) {
  const auto nearest = static_cast<float>(x);
  return nearest > x ? std::nextafter(nearest, 0.0f) : nearest;
}

}  // namespace

std::vector<Fault> ipc_faults() {
  return {
      of_impact("rounded to the nearest, later in half of all cases",
                [](double impact) { return static_cast<float>(impact); }),
      of_impact("a millionth late", [](double impact) { return static_cast<float>(impact * (1 + 1e-6)); }),
      of_impact("a tenth of the time", [](double impact) { return impact < 1 ? static_cast<float>(0.1 * impact) : 1; }),
      of_impact("faces that touch at the start let through",
                [](double impact) { return impact == 0 ? 1 : rounded_down(impact); }),
      of_time("nothing ever meets", [](const CcdCase&, float& time) { time = 1; }),
      of_time("nearly parallel edges skipped",
              [](const CcdCase& c, float& time) {
                if (c.kind == CcdKind::edge_edge && is_nearly_parallel(c)) time = 1;
              }),
      of_time("motions in a plane z = const skipped",
              [](const CcdCase& c, float& time) {
                const auto at = [&](const Vec3f& x) { return x.z == c.from[0].z; };
                if (std::ranges::all_of(c.from, at) && std::ranges::all_of(c.to, at)) time = 1;
              }),
      of_time("no number where nothing moves",
              [](const CcdCase& c, float& time) {
                if (c.from == c.to) time = std::numeric_limits<float>::quiet_NaN();
              }),
      of_motion("the second face taken to be at rest",
                [](CcdCase& c) {
                  for (std::size_t k = c.kind == CcdKind::edge_edge ? 2 : 1; k < 4; ++k) c.to[k] = c.from[k];
                }),
      of_motion("the last corner read twice",
                [](CcdCase& c) {
                  if (c.kind == CcdKind::vertex_triangle) c.from[2] = c.from[3], c.to[2] = c.to[3];
                }),
      of_barrier("slope of the other sign", [](const BarrierCase&, float&, float& slope, float&) { slope = -slope; }),
      of_barrier("curvature without its last term",
                 [](const BarrierCase& c, float&, float&, float& curvature) {
                   curvature -= static_cast<float>(depth_by_gap(c) * depth_by_gap(c));
                 }),
      of_barrier("slope without its last term",
                 [](const BarrierCase& c, float&, float& slope, float&) {
                   const double gap = double{c.squared_distance} - double{c.thickness} * c.thickness;
                   slope += static_cast<float>(depth_by_gap(c) * depth_by_gap(c) * gap);
                 }),
      of_barrier("0.001 % too large", [](const BarrierCase&, float& b, float&, float&) { b *= 1.00001f; }),
      of_barrier("slope by the distance", [](const BarrierCase& c, float&, float& slope,
                                             float&) { slope *= 2 * std::sqrt(c.squared_distance); }),
      of_barrier("acts beyond its end",
                 [](const BarrierCase& c, float&, float&, float& curvature) {
                   if (depth_by_gap(c) == 0) curvature = 1;
                 }),
      of_distance("thickness forgotten", [](BarrierCase& c) { c.thickness = 0; }),
      of_distance("d̂² for the support with a thickness",
                  [](BarrierCase& c) {
                    const float xi = c.thickness;
                    if (c.squared_distance > xi * xi) c.squared_distance -= xi * xi;
                    c.thickness = 0;
                  }),
      of_distance("distance for its square",
                  [](BarrierCase& c) {
                    const float root = std::sqrt(c.squared_distance);
                    if (root > c.thickness * c.thickness) c.squared_distance = root;
                  }),
  };
}

void add_right_ipc(Contestant& exact, const Authority& authority) {
  exact.ccd = [ask = authority.ccd](const CcdIn& in) {
    CcdOut out;
    for (const double impact : ask(in).impact) out.time.push_back(impact < 1 ? rounded_down(impact) : 1);
    return out;
  };
  exact.barrier = [ask = authority.barrier](const BarrierIn& in) {
    const BarrierTruth truth = ask(in);
    const auto single = [](const std::vector<double>& values) {
      return std::vector<float>(values.begin(), values.end());
    };
    return BarrierOut{single(truth.energy), single(truth.slope), single(truth.curvature)};
  };
}

}  // namespace ogc::tests

// Faults of bound, activation and truncate.
#include <cmath>
#include <limits>

#include "compare/judge/engine/exact_sum.hpp"
#include "reference/geometry/truncate.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

using SpoilBound = std::function<float(float)>;
using SpoilActivation = std::function<void(float d, float r, float k, std::size_t i, ActivationOut&)>;
using SpoilTruncate = std::function<void(const TruncateIn&, std::size_t, TruncateOut&)>;

Fault bound_fault(const std::string& name, const SpoilBound& spoil) {
  return {name, Stage::bound, [spoil](Contestant& contestant, const Authority&) {
            contestant.bound = [right = contestant.bound, spoil](const BoundIn& in) {
              BoundOut out = right(in);
              for (float& b : out.bound) b = spoil(b);
              return out;
            };
          }};
}

/// One of the three minima left out.
Fault unread_fault(const std::string& name, std::span<const float> BoundIn::*unread) {
  return {name, Stage::bound, [unread](Contestant& contestant, const Authority&) {
            contestant.bound = [right = contestant.bound, unread](const BoundIn& in) {
              const std::vector<float> large((in.*unread).size(), 1e30f);
              BoundIn other = in;
              other.*unread = large;
              return right(other);
            };
          }};
}

Fault activation_fault(const std::string& name, const SpoilActivation& spoil) {
  return {name, Stage::activation, [spoil](Contestant& contestant, const Authority&) {
            contestant.activation = [right = contestant.activation, spoil](const ActivationIn& in) {
              ActivationOut out = right(in);
              for (std::size_t i = 0; i < in.distance.size(); ++i)
                spoil(in.distance[i], in.contact_radius[i], in.stiffness[i], i, out);
              return out;
            };
          }};
}

Fault truncate_fault(const std::string& name, const SpoilTruncate& spoil) {
  return {name, Stage::truncate, [spoil](Contestant& contestant, const Authority&) {
            contestant.truncate = [right = contestant.truncate, spoil](const TruncateIn& in) {
              TruncateOut out = right(in);
              for (std::size_t i = 0; i < in.position.size(); ++i) spoil(in, i, out);
              return out;
            };
          }};
}

float outwards(float x, float from) { return x == from ? x : std::nextafter(x, x > from ? infinity : -infinity); }

}  // namespace

namespace {

bool obeys(const Vec3f& x, const Vec3f& p, float b) {
  ExactSum margin;
  for (const auto [a, c] : {std::array{x.x, p.x}, std::array{x.y, p.y}, std::array{x.z, p.z}}) {
    margin.add_product(a, a);
    margin.add_product(-2.0 * a, c);
    margin.add_product(c, c);
  }
  margin.add_product(-double{b}, b);
  return margin.sign() <= 0;
}

/// The exact position rounded, then stepped towards the previous one until the bound holds.
Vec3f stored(const Vec3& exact, const Vec3f& previous, float bound) {
  Vec3f x{static_cast<float>(exact.x), static_cast<float>(exact.y), static_cast<float>(exact.z)};
  while (!obeys(x, previous, bound))
    x = {std::nextafter(x.x, previous.x), std::nextafter(x.y, previous.y), std::nextafter(x.z, previous.z)};
  return x;
}

std::vector<float> rounded(const std::vector<double>& values) { return {values.begin(), values.end()}; }

}  // namespace

void add_right_scalars(Contestant& exact, const Authority& authority) {
  exact.bound = [authority](const BoundIn& in) { return authority.bound(in).exact; };
  exact.activation = [authority](const ActivationIn& in) {
    const ActivationTruth truth = authority.activation(in);
    return ActivationOut{rounded(truth.energy), rounded(truth.slope), rounded(truth.curvature)};
  };
  exact.truncate = [authority](const TruncateIn& in) {
    const TruncateTruth truth = authority.truncate(in);
    TruncateOut out{in.position, truth.cut};
    for (std::size_t i = 0; i < in.position.size(); ++i)
      if (truth.cut[i])
        out.position[i] = in.half_spaces.of(i).empty() ? stored(truth.position[i], in.previous[i], in.bound[i])
                                                       : reference::stored_in_region(truth.position[i], in, i);
    return out;
  };
}

std::vector<Fault> scalar_faults() {
  return {
      bound_fault("bound: 1 % too large", [](float b) { return 1.01f * b; }),
      bound_fault("bound: one ulp too large", [](float b) { return std::nextafter(b, infinity); }),
      bound_fault("bound: half of what is right", [](float b) { return 0.5f * b; }),
      unread_fault("bound: own edges forgotten", &BoundIn::d_min_edge),
      unread_fault("bound: own triangles forgotten", &BoundIn::d_min_triangle),
      activation_fault("activation: Eq. 19 as printed",
                       [](float d, float r, float, std::size_t i, ActivationOut& out) {
                         if (d < r / 2) out.slope[i] *= r / 2;
                       }),
      activation_fault("activation: half the coefficient of the logarithm",
                       [](float d, float r, float, std::size_t i, ActivationOut& out) {
                         if (d < r / 2) out.curvature[i] *= 0.5f;
                       }),
      {"activation: ogc for every activation", Stage::activation,
       [](Contestant& contestant, const Authority&) {
         contestant.activation = [right = contestant.activation](const ActivationIn& in) {
           ActivationIn other = in;
           for (ContactActivation& kind : other.activation) kind = ContactActivation::ogc;
           return right(other);
         };
       }},
      activation_fault("activation: no curvature jump at the radius",
                       [](float d, float r, float k, std::size_t i, ActivationOut& out) {
                         if (d == r) out.curvature[i] = k;
                       }),
      activation_fault("activation: energy without its constant, Eq. 20",
                       [](float d, float r, float k, std::size_t i, ActivationOut& out) {
                         if (d < r / 2) out.energy[i] = -k * r * r / 4 * std::log(d);
                       }),
      truncate_fault("truncate: flag inverted",
                     [](const auto&, std::size_t i, TruncateOut& out) { out.cut[i] = !out.cut[i]; }),
      truncate_fault("truncate: one ulp too far",
                     [](const auto& in, std::size_t i, TruncateOut& out) {
                       Vec3f& x = out.position[i];
                       const Vec3f& p = in.previous[i];
                       if (out.cut[i]) x = {outwards(x.x, p.x), outwards(x.y, p.y), outwards(x.z, p.z)};
                     }),
      truncate_fault("truncate: not truncated",
                     [](const auto& in, std::size_t i, TruncateOut& out) { out.position[i] = in.position[i]; }),
      truncate_fault("truncate: stale position copied",
                     [](const auto& in, std::size_t i, TruncateOut& out) {
                       if (out.cut[i]) out.position[i] = in.previous[i];
                     }),
      truncate_fault("truncate: untouched positions recomputed",
                     [](const auto& in, std::size_t i, TruncateOut& out) {
                       Vec3f& x = out.position[i];
                       if (!out.cut[i]) x.x = in.previous[i].x + (x.x - in.previous[i].x);
                     }),
  };
}

}  // namespace ogc::tests

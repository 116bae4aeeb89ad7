// Faults of volume_force.
#include <algorithm>

#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

Fault asked(const std::string& name, const std::function<void(VolumeForceCase&)>& change) {
  return {"volume_force: " + name, Stage::volume_force, [change](Contestant& contestant, const Authority&) {
            contestant.volume_force = [right = contestant.volume_force, change](const VolumeForceIn& in) {
              VolumeForceIn other = in;
              for (VolumeForceCase& c : other.cases) change(c);
              return right(other);
            };
          }};
}

using Spoil = std::function<void(const VolumeForceCase&, Vec3f&, std::array<float, 6>&)>;

Fault spoiled(const std::string& name, const Spoil& spoil) {
  return {"volume_force: " + name, Stage::volume_force, [spoil](Contestant& contestant, const Authority&) {
            contestant.volume_force = [right = contestant.volume_force, spoil](const VolumeForceIn& in) {
              ForceOut out = right(in);
              for (std::size_t i = 0; i < in.cases.size(); ++i) spoil(in.cases[i], out.force[i], out.block[i]);
              return out;
            };
          }};
}

/// n·Σ wᵢ (x₀ − xᵢ).
double height(const VolumeForceCase& c) {
  const auto along = [&](std::size_t k) {
    const Vec3f &x = c.vertex[0], &y = c.vertex[k];
    return c.direction[0] * (double{x.x} - y.x) + c.direction[1] * (double{x.y} - y.y) +
           c.direction[2] * (double{x.z} - y.z);
  };
  return c.weights[0] * along(1) + c.weights[1] * along(2) + c.weights[2] * along(3);
}

/// w of the vertex asked about.
float weight(const VolumeForceCase& c) { return c.own == 0 ? 1 : c.weights[static_cast<std::size_t>(c.own) - 1]; }

/// The question, with x₀ moved along n so that it lies deeper by `step` and has moved no further.
void lower(VolumeForceCase& c, double step) {
  for (auto* points : {&c.vertex, &c.start}) {
    Vec3f& x = (*points)[0];
    x = {static_cast<float>(x.x - step * c.direction[0]), static_cast<float>(x.y - step * c.direction[1]),
         static_cast<float>(x.z - step * c.direction[2])};
  }
}

}  // namespace

void add_right_volumes(Contestant& exact, const Authority& authority) {
  exact.volume_force = [authority](const VolumeForceIn& in) { return rounded(authority.volume_force(in)); };
}

std::vector<Fault> volume_faults() {
  return {
      asked("n of the other sign",
            [](VolumeForceCase& c) {
              for (float& x : c.direction) x = -x;
            }),
      asked("n turned inward where the point is inside",
            [](VolumeForceCase& c) {
              if (height(c) < 0)
                for (float& x : c.direction) x = -x;
            }),
      asked("depth without r", [](VolumeForceCase& c) { c.contact_radius = 0x1p-20f; }),
      asked("depth r at the surface from inside, as from outside: ‖φ‖ for φ",
            [](VolumeForceCase& c) {
              const double h = height(c);
              if (h < 0) lower(c, 2 * h);
            }),
      asked("slip since now, not since the start of the step", [](VolumeForceCase& c) { c.start = c.vertex; }),
      asked("slip of the point alone: a moving volume does not carry along",
            [](VolumeForceCase& c) {
              for (std::size_t k = 1; k < 4; ++k) c.start[k] = c.vertex[k];
            }),
      asked("friction with the wrong sign of the slip",
            [](VolumeForceCase& c) {
              // x + (x − xᵗ) for xᵗ
              for (std::size_t k = 0; k < 4; ++k) {
                const Vec3f x = c.vertex[k], s = c.start[k];
                c.start[k] = {2 * x.x - s.x, 2 * x.y - s.y, 2 * x.z - s.z};
              }
            }),
      asked("friction forgotten", [](VolumeForceCase& c) { c.friction = 0; }),
      asked("1/y below the limit too", [](VolumeForceCase& c) { c.slip_limit = 0x1p-38f; }),
      asked("weights of two corners exchanged",
            [](VolumeForceCase& c) { std::swap(c.weights[1], c.weights[2]); }),
      asked("weights of the nearest corner alone",
            [](VolumeForceCase& c) {
              const auto largest = std::max_element(c.weights.begin(), c.weights.end());
              const std::ptrdiff_t k = largest - c.weights.begin();
              c.weights = {};
              c.weights[static_cast<std::size_t>(k)] = 1;
            }),
      asked("radius 0.01 % too large", [](VolumeForceCase& c) { c.contact_radius *= 1.0001f; }),
      spoiled("weight not squared in the block",
              [](const VolumeForceCase& c, Vec3f&, std::array<float, 6>& block) {
                const float w = weight(c);
                if (w > 0)
                  for (float& b : block) b /= w;
              }),
      spoiled("nothing left on the corners: action without reaction",
              [](const VolumeForceCase& c, Vec3f& force, std::array<float, 6>&) {
                if (c.own > 0) force = {};
              }),
      spoiled("the corners pushed the way of the point",
              [](const VolumeForceCase& c, Vec3f& force, std::array<float, 6>&) {
                if (c.own > 0) force = {-force.x, -force.y, -force.z};
              }),
      spoiled("no force deeper than r",
              [](const VolumeForceCase& c, Vec3f& force, std::array<float, 6>& block) {
                if (height(c) < -c.contact_radius) force = {}, block = {};
              }),
      spoiled("force 0.1 % too small",
              [](const VolumeForceCase&, Vec3f& force, std::array<float, 6>&) {
                force = {0.999f * force.x, 0.999f * force.y, 0.999f * force.z};
              }),
  };
}

}  // namespace ogc::tests

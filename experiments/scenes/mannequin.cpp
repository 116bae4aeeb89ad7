// A limb first rotates about the x axis through its joint, then everything rotates about the y axis. Knees stay
// straight, because a bent knee would pinch the cloth in its hollow, and the cloth would stop the leg.
#include "experiments/scenes/mannequin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/scenes/shapes.hpp"

namespace ogc::experiments {
namespace {

using compare::Index;
using compare::Vec3;

constexpr double frame_seconds = 0.04, stride_seconds = 1.6, ease_seconds = 0.8;
constexpr double hip_height = 0.90, knee_height = 0.50, ankle_height = 0.08;  // [m]

enum class Joint { none, hip, shoulder };

struct Limb {
  Vec3 from, to;  ///< [m]
  double radius;  ///< [m]
  Joint joint;
  int side;  ///< −1, 1; 0: the middle
};

std::vector<Limb> limbs(const MannequinSizes& sizes) {
  const double top = sizes.shoulders;
  std::vector<Limb> all{{{0, sizes.waist, 0}, {0, top, 0}, sizes.torso_radius, Joint::none, 0},
                        {{0, 0.855, 0}, {0, 0.865, 0}, sizes.pelvis_radius, Joint::none, 0},
                        {{0, top + 0.10, 0}, {0, top + 0.20, 0}, 0.045, Joint::none, 0},
                        {{0, top + 0.28, 0.01}, {0, top + 0.34, 0.01}, 0.09, Joint::none, 0}};
  for (const int side : {-1, 1}) {
    const double s = side;
    all.push_back({{0.15 * s, top + 0.06, 0}, {0.40 * s, top - 0.02, 0}, 0.035, Joint::shoulder, side});
    all.push_back({{0.40 * s, top - 0.02, 0}, {0.62 * s, top - 0.10, 0.04}, 0.030, Joint::shoulder, side});
    all.push_back({{0.075 * s, hip_height, 0}, {0.085 * s, knee_height, 0}, 0.065, Joint::hip, side});
    all.push_back({{0.085 * s, knee_height, 0}, {0.085 * s, ankle_height, -0.01}, 0.045, Joint::hip, side});
    all.push_back(
        {{0.085 * s, ankle_height - 0.03, 0}, {0.095 * s, ankle_height - 0.04, 0.15}, 0.035, Joint::hip, side});
  }
  return all;
}

compare::Mesh surface_of(const Limb& limb, double spacing) {
  const double length = std::hypot(limb.to.x - limb.from.x, limb.to.y - limb.from.y, limb.to.z - limb.from.z);
  const auto cells = [&](double size, Index least) {
    return std::max(least, static_cast<Index>(std::lround(size / spacing)));
  };
  const double quarter = std::numbers::pi / 2 * limb.radius;
  return capsule({cells(4 * quarter, 6), cells(length, 1), cells(quarter, 2)}, limb.radius, limb.from, limb.to);
}

/// Rotates a point by `angle` forwards (towards +z) about the axis along x through (y, z) = (height, 0).
Vec3 swung(const Vec3& p, double height, double angle) {
  const double y = p.y - height, c = std::cos(angle), s = std::sin(angle);
  return {p.x, height + c * y + s * p.z, c * p.z - s * y};
}

/// Returns the position of a limb's point at time `t` [s].
Vec3 posed(Vec3 p, const Limb& limb, const MannequinSizes& sizes, double t) {
  const double eased = std::clamp(t / ease_seconds, 0.0, 1.0), strength = eased * eased * (3 - 2 * eased);
  const double phase = 2 * std::numbers::pi * t / stride_seconds, stride = limb.side * std::sin(phase);
  if (limb.joint == Joint::hip) p = swung(p, hip_height, 0.4 * strength * stride);
  if (limb.joint == Joint::shoulder) p = swung(p, sizes.shoulders + 0.06, -0.3 * strength * stride);
  const double turn = 0.15 * strength * std::sin(phase), c = std::cos(turn), s = std::sin(turn);
  return {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
}

compare::Vec3f narrowed(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

void append_mannequin(compare::Scene& scene, const MannequinSizes& sizes, const compare::Material& surface) {
  compare::Mesh whole;
  std::vector<Limb> limb_of;
  for (const Limb& limb : limbs(sizes)) {
    const compare::Mesh part = surface_of(limb, sizes.spacing);
    const auto first = static_cast<Index>(whole.positions.size());
    whole.positions.insert(whole.positions.end(), part.positions.begin(), part.positions.end());
    for (const auto& [a, b, c] : part.triangles) whole.triangles.push_back({first + a, first + b, first + c});
    limb_of.resize(whole.positions.size(), limb);
  }
  compare::PrescribedMotion motion;
  motion.name = "walk";
  const auto first = static_cast<Index>(scene.mesh.positions.size());
  for (std::size_t v = 0; v < whole.positions.size(); ++v) motion.vertices.push_back(first + static_cast<Index>(v));
  const int frames = static_cast<int>(std::ceil(sizes.seconds / frame_seconds - 1e-6));
  for (int k = 0; k <= frames; ++k) {
    motion.keyframes.times.push_back(frame_seconds * k);
    for (std::size_t v = 0; v < whole.positions.size(); ++v)
      motion.keyframes.positions.push_back(
          narrowed(tidy(posed(whole.positions[v], limb_of[v], sizes, frame_seconds * k))));
  }
  append_body(scene, {.name = "body", .material = surface}, whole);
  scene.motions.push_back(std::move(motion));
}

}  // namespace ogc::experiments

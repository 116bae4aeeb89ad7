// Host code in a file of its own (fast/stages/surface.cpp says why).
#include "fast/stages/volume_parts.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "fast/kernels/bvh.hpp"

namespace ogc::fast {
namespace {

/// A place on the Hilbert curve through the box of all positions.
class Curve {
 public:
  explicit Curve(std::span<const compare::Vec3f> positions) {
    Box box;
    for (const compare::Vec3f& x : positions) box.include(Vec{x.x, x.y, x.z});
    if (positions.empty()) return;
    low_ = box.lower;
    const Vec size = box.upper - box.lower;
    const float extent = std::max({size.x, size.y, size.z});
    if (extent > 0) scale_ = (0x1p20 - 1) / static_cast<double>(extent);
  }

  std::uint64_t operator()(const compare::Vec3f& a, const compare::Vec3f& b, const compare::Vec3f& c) const {
    const auto along = [this](float p, float q, float r, float low) {
      const double mean = (double{p} + q + r) / 3 - low;
      return static_cast<std::uint32_t>(std::clamp(mean * scale_, 0.0, 0x1p20 - 1));
    };
    return hilbert_key({{along(a.x, b.x, c.x, low_.x), along(a.y, b.y, c.y, low_.y), along(a.z, b.z, c.z, low_.z)}});
  }

 private:
  Vec low_;
  double scale_ = 0;
};

VolumeParts parts_of(const compare::Topology& topology, const std::vector<int>& triangles,
                     std::span<const compare::Vec3f> positions) {
  const Curve curve(positions);
  std::map<compare::Index, std::size_t> place;  // of a component's part
  std::vector<std::vector<std::pair<std::uint64_t, int>>> sorted;
  for (const int t : triangles) {
    const compare::Triangle& corners = topology.triangles[static_cast<std::size_t>(t)];
    const auto at = [&](std::size_t k) { return static_cast<std::size_t>(corners[k]); };
    const auto [entry, is_new] = place.try_emplace(topology.component[at(0)], sorted.size());
    if (is_new) sorted.emplace_back();
    sorted[entry->second].emplace_back(curve(positions[at(0)], positions[at(1)], positions[at(2)]), t);
  }
  VolumeParts parts;
  for (auto& part : sorted) {
    std::ranges::sort(part);
    std::vector<int>& facets = parts.emplace_back();
    for (const auto& [key, t] : part) facets.push_back(t);
  }
  return parts;
}

}  // namespace

VolumeParts volume_parts(const compare::Scene& scene, const compare::Topology& topology) {
  std::vector<int> triangles;
  for (const compare::Body& body : scene.bodies) {
    for (int k = 0; body.is_volume() && k < body.triangle_count; ++k) triangles.push_back(body.first_triangle + k);
  }
  return parts_of(topology, triangles, compare::to_single(scene.mesh.positions));
}

VolumeParts volume_parts(const compare::Topology& topology, std::span<const compare::Vec3f> positions) {
  std::vector<int> triangles(topology.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) triangles[t] = static_cast<int>(t);
  return parts_of(topology, triangles, positions);
}

}  // namespace ogc::fast

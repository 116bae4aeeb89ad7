// This host code is not in the header, so that only g++ compiles it (fast/stages/surface.cpp explains why).
#include "fast/stages/volume_parts.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "compare/problem/tetrahedra.hpp"
#include "compare/problem/volumes.hpp"
#include "fast/kernels/bvh.hpp"

namespace ogc::fast {
namespace {

/// Computes Hilbert keys in the box of all positions.
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

  /// Returns the Hilbert key of the vertices' mean.
  template <std::size_t N>
  std::uint64_t operator()(const std::array<compare::Index, N>& vertices,
                           std::span<const compare::Vec3f> positions) const {
    const auto along = [&](float compare::Vec3f::*axis, float low) {
      double sum = 0;
      for (const compare::Index v : vertices) sum += double{positions[static_cast<std::size_t>(v)].*axis};
      return static_cast<std::uint32_t>(std::clamp((sum / N - low) * scale_, 0.0, 0x1p20 - 1));
    };
    return hilbert_key(
        {{along(&compare::Vec3f::x, low_.x), along(&compare::Vec3f::y, low_.y), along(&compare::Vec3f::z, low_.z)}});
  }

 private:
  Vec low_;
  double scale_ = 0;
};

/// Hilbert key and number of each facet or tetrahedron.
using Places = std::vector<std::pair<std::uint64_t, int>>;

std::vector<int> in_order(Places& places) {
  std::ranges::sort(places);
  std::vector<int> order;
  for (const auto& [key, number] : places) order.push_back(number);
  return order;
}

VolumeParts parts_of(const compare::Topology& topology, const std::vector<int>& triangles,
                     std::span<const compare::Tetrahedron> tetrahedra, std::span<const compare::Edge> cavities,
                     std::span<const compare::Vec3f> positions) {
  const Curve curve(positions);
  const std::vector<compare::Index> component = compare::joined_components(topology, tetrahedra, cavities);
  std::map<compare::Index, std::size_t> place;  // by component: index of its part
  std::vector<std::pair<Places, Places>> sorted;
  for (const int t : triangles) {
    const compare::Triangle& corners = topology.triangles[static_cast<std::size_t>(t)];
    const auto [entry, is_new] = place.try_emplace(component[static_cast<std::size_t>(corners[0])], sorted.size());
    if (is_new) sorted.emplace_back();
    sorted[entry->second].first.emplace_back(curve(corners, positions), t);
  }
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    const std::size_t part = place.at(component[static_cast<std::size_t>(tetrahedra[t][0])]);
    sorted[part].second.emplace_back(curve(tetrahedra[t], positions), static_cast<int>(t));
  }
  VolumeParts parts;
  for (auto& [facets, solids] : sorted) parts.push_back({in_order(facets), in_order(solids)});
  return parts;
}

}  // namespace

VolumeParts volume_parts(const compare::Scene& scene, const compare::Topology& topology) {
  std::vector<int> triangles;
  for (const compare::Body& body : scene.bodies) {
    for (int k = 0; body.is_volume() && k < body.triangle_count; ++k) triangles.push_back(body.first_triangle + k);
  }
  return parts_of(topology, triangles, volume_tetrahedra(scene), compare::volume_cavities(scene),
                  compare::to_single(scene.rest_positions));
}

VolumeParts volume_parts(const compare::Topology& topology, std::span<const compare::Tetrahedron> tetrahedra,
                         std::span<const compare::Edge> cavities, std::span<const compare::Vec3f> positions) {
  std::vector<int> triangles(topology.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) triangles[t] = static_cast<int>(t);
  return parts_of(topology, triangles, tetrahedra, cavities, positions);
}

std::vector<compare::Tetrahedron> volume_tetrahedra(const compare::Scene& scene) {
  std::vector<compare::Tetrahedron> all;
  for (const compare::Body& body : scene.bodies) {
    const auto first = scene.mesh.tetrahedra.begin() + body.first_tetrahedron;
    if (body.is_volume()) all.insert(all.end(), first, first + body.tetrahedron_count);
  }
  return all;
}

AskerRows asker_rows(const compare::Scene& scene, const compare::Topology& topology, const std::vector<int>& order) {
  AskerRows rows;
  if (!compare::has_volumes(scene)) return rows;
  const std::size_t count = scene.mesh.positions.size();
  std::vector<int> slot_of(count, -1);
  for (std::size_t slot = 0; slot < order.size(); ++slot)
    slot_of[static_cast<std::size_t>(order[slot])] = static_cast<int>(slot);
  rows.askers.assign(order.size(), -1);
  for (const compare::Index v : compare::volume_askers(scene, topology)) {
    const int slot = slot_of[static_cast<std::size_t>(v)];
    if (slot >= 0)
      rows.askers[static_cast<std::size_t>(slot)] = v;
    else
      rows.askers.push_back(v);
  }
  const std::vector<bool> is_free = compare::free_volumes(scene);
  if (std::ranges::find(is_free, true) != is_free.end()) rows.slot_of = std::move(slot_of);
  return rows;
}

SolidTables solid_tables(const compare::Topology& topology, std::span<const compare::Tetrahedron> tetrahedra) {
  SolidTables tables;
  if (tetrahedra.empty()) return tables;
  std::vector<std::vector<int>> of_vertex(static_cast<std::size_t>(topology.vertex_count));
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    SolidElement element{{}, {-1, -1, -1, -1}};
    for (std::size_t k = 0; k < 4; ++k) {
      element.corner[k] = tetrahedra[t][k];
      of_vertex[static_cast<std::size_t>(tetrahedra[t][k])].push_back(static_cast<int>(t));
    }
    tables.elements.push_back(element);
  }
  tables.offsets.push_back(0);
  for (const std::vector<int>& row : of_vertex) {
    tables.items.insert(tables.items.end(), row.begin(), row.end());
    tables.offsets.push_back(static_cast<int>(tables.items.size()));
  }
  std::map<compare::Triangle, int> alone;
  const std::vector<compare::TetrahedronFace> faces = compare::sorted_faces(tetrahedra);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const compare::TetrahedronFace& face = faces[i];
    if (i + 1 < faces.size() && faces[i + 1].vertices == face.vertices) {
      const compare::TetrahedronFace& other = faces[++i];
      tables.elements[static_cast<std::size_t>(face.tetrahedron)].behind[face.corner] = other.tetrahedron;
      tables.elements[static_cast<std::size_t>(other.tetrahedron)].behind[other.corner] = face.tetrahedron;
    } else {
      alone.emplace(face.vertices, face.tetrahedron);
    }
  }
  for (compare::Triangle corners : topology.triangles) {
    std::ranges::sort(corners);
    const auto found = alone.find(corners);
    tables.owner.push_back(found == alone.end() ? -1 : found->second);
  }
  return tables;
}

}  // namespace ogc::fast

#include "reference/definitions/scene_volumes.hpp"

#include <algorithm>
#include <tuple>

#include <tbb/parallel_for.h>

#include "compare/problem/tetrahedra.hpp"
#include "reference/definitions/part_contacts.hpp"
#include "reference/definitions/volume_depth.hpp"

namespace ogc::reference {
namespace {

using compare::VolumeContact;

VolumeContact rounded(VolumeContact contact, const std::array<double, 3>& weights, const compare::Vec3& direction,
                      double depth) {
  const auto single = [](double x) { return static_cast<float>(x); };
  for (std::size_t k = 0; k < 3; ++k) contact.weights[k] = single(weights[k]);
  contact.direction = {single(direction.x), single(direction.y), single(direction.z)};
  contact.depth = single(depth);
  return contact;
}

/// Returns the contacts with volumes of triangles; points are numbered in the order of the askers.
std::vector<VolumeContact> contacts_of_triangles(const compare::VolumeDepthIn& in) {
  const Complex mesh{*in.topology, in.positions};
  const std::vector<compare::Index> part = compare::joined_components(*in.topology, {}, in.cavities);
  std::vector<std::vector<PartContact>> found(in.points.size());
  tbb::parallel_for(std::size_t{0}, found.size(),
                    [&](std::size_t i) { found[i] = part_contacts(mesh, in.points[i], in.contact_radius, part); });
  std::vector<VolumeContact> all;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const PartContact& exact : found[i])
      all.push_back(rounded({.point = static_cast<Index>(i),
                             .inside = exact.inside,
                             .triangle = exact.triangle,
                             .face = exact.face,
                             .direction = {}},
                            exact.weights, exact.direction, exact.depth));
  return all;
}

/// Returns the contacts with all parts, whether a part consists of triangles or of tetrahedra.
compare::VolumeDepthOut exact_of(const compare::VolumeDepthIn& in) {
  const compare::VolumeDepthTruth truth = volume_depth(in);
  compare::VolumeDepthOut out;
  for (std::size_t i = 0; i < truth.parts.size(); ++i) {
    for (const compare::VolumePartTruth& part : truth.parts[i]) {
      for (const compare::VolumeAnswer* exact : exact_answers(part))
        out.contacts.push_back(rounded(exact->contact, exact->weights, exact->direction, exact->depth));
      out.unresolved.insert(out.unresolved.end(), exact_unresolved(part), static_cast<Index>(i));
    }
  }
  std::ranges::sort(out.contacts, {},
                    [](const VolumeContact& c) { return std::tuple(c.point, c.inside, c.triangle, c.face); });
  return out;
}

}  // namespace

SceneVolumes::SceneVolumes(const compare::Scene& scene, const compare::Topology& topology)
    : topology_(topology),
      surface_(compare::volume_surface(scene)),
      asking_(compare::volume_askers(scene, topology)),
      contact_radius_(static_cast<float>(scene.settings.contact_radius)) {
  const std::vector<bool> is_volume = compare::volume_flags(scene);
  for (const Index v : asking_) own_.push_back(is_volume[static_cast<std::size_t>(v)] ? v : -1);
}

compare::VolumeDepthOut SceneVolumes::contacts(std::span<const compare::Vec3f> positions) const {
  compare::VolumeDepthOut out;
  if (!has_any()) return out;
  std::vector<Vec3f> points;
  for (const Index v : asking_) points.push_back(positions[static_cast<std::size_t>(v)]);
  const compare::VolumeDepthIn question{&surface_.topology,  positions, contact_radius_,  points,
                                        surface_.tetrahedra, own_,      surface_.cavities};
  if (surface_.tetrahedra.empty())
    out.contacts = contacts_of_triangles(question);
  else
    out = exact_of(question);
  for (VolumeContact& contact : out.contacts) {
    contact.point = asking_[static_cast<std::size_t>(contact.point)];
    contact.triangle = surface_.triangles[static_cast<std::size_t>(contact.triangle)];
    contact.face = scene_face(surface_, topology_, contact.face);
  }
  for (Index& point : out.unresolved) point = asking_[static_cast<std::size_t>(point)];
  return out;
}

}  // namespace ogc::reference

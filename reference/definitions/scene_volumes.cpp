#include "reference/definitions/scene_volumes.hpp"

#include <tbb/parallel_for.h>

#include "reference/definitions/part_contacts.hpp"

namespace ogc::reference {

SceneVolumes::SceneVolumes(const compare::Scene& scene, const compare::Topology& topology)
    : topology_(topology),
      surface_(compare::volume_surface(scene)),
      contact_radius_(static_cast<float>(scene.settings.contact_radius)) {
  const std::vector<Index> groups = rigid_groups(scene);
  const std::vector<bool> is_volume = compare::volume_flags(scene);
  for (std::size_t v = 0; v < groups.size(); ++v)
    if (groups[v] == -1 && !is_volume[v]) asking_.push_back(static_cast<Index>(v));
}

std::vector<compare::VolumeContact> SceneVolumes::contacts(std::span<const compare::Vec3f> positions) const {
  std::vector<compare::VolumeContact> all;
  if (!has_any()) return all;
  const Complex mesh{surface_.topology, positions};
  std::vector<std::vector<PartContact>> found(asking_.size());
  tbb::parallel_for(std::size_t{0}, asking_.size(), [&](std::size_t i) {
    found[i] = part_contacts(mesh, positions[static_cast<std::size_t>(asking_[i])], contact_radius_);
  });
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const PartContact& exact : found[i]) {
      const auto single = [](double x) { return static_cast<float>(x); };
      const compare::Vec3& n = exact.direction;
      compare::VolumeContact contact;
      contact.point = asking_[i];
      contact.inside = exact.inside;
      contact.triangle = surface_.triangles[static_cast<std::size_t>(exact.triangle)];
      contact.face = scene_face(surface_, topology_, exact.face);
      for (std::size_t k = 0; k < 3; ++k) contact.weights[k] = single(exact.weights[k]);
      contact.direction = {single(n.x), single(n.y), single(n.z)};
      contact.depth = single(exact.depth);
      all.push_back(contact);
    }
  }
  return all;
}

}  // namespace ogc::reference

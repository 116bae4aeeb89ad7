// The judge's way in to volumes: contacts of points with a volume, found in its tree, and the force of one contact,
// each case alone.
#pragma once

#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

#include "compare/stages/volume_depth.hpp"
#include "compare/stages/volume_force.hpp"
#include "fast/kernels/volume_depth.hpp"
#include "fast/kernels/volume_force.hpp"
#include "fast/probes/download.hpp"
#include "fast/probes/probe_forces.hpp"
#include "fast/stages/bvh.hpp"
#include "fast/stages/surface.hpp"

namespace ogc::fast {

/// Each contact with a volume alone.
struct ProbeVolumeForce {
  const VolumeContact* contact;              ///< by case
  const Vec *vertex, *start;                 ///< by case: the point and three corners [m]
  const int* own;                            ///< by case: the role asked about
  const float *contact_radius, *slip_limit;  ///< by case: r, ε_v h [m]
  ForceArrays out;                           ///< by case, written

  OGC_HD void operator()(int i) const {
    ForceAndBlock sum;
    add_volume_contact(contact[i], vertex + 4 * i, start + 4 * i, own[i], contact_radius[i], slip_limit[i], sum);
    out.store(i, sum);
  }
};

/// The stage `volume_force`.
template <class Backend>
compare::ForceOut probe_volume_force(Backend& backend, const compare::VolumeForceIn& in) {
  ProbeMemory<Backend> memory(backend);
  compare::ForceOut out;
  std::vector<VolumeContact> contacts;
  std::vector<int> own;
  std::vector<float> contact_radius, slip_limit;
  for (const compare::VolumeForceCase& c : in.cases) {
    const auto& [w0, w1, w2] = c.weights;
    contacts.push_back({{w0, w1, w2}, {c.direction[0], c.direction[1], c.direction[2]}, c.stiffness, c.friction});
    own.push_back(c.own);
    contact_radius.push_back(c.contact_radius);
    slip_limit.push_back(c.slip_limit);
  }
  const std::size_t n = in.cases.size();
  backend.for_each(
      static_cast<int>(n),
      ProbeVolumeForce{.contact = memory.template in<VolumeContact>(contacts),
                       .vertex = memory.template in<Vec>(points_of(in.cases, &compare::VolumeForceCase::vertex)),
                       .start = memory.template in<Vec>(points_of(in.cases, &compare::VolumeForceCase::start)),
                       .own = memory.template in<int>(own),
                       .contact_radius = memory.template in<float>(contact_radius),
                       .slip_limit = memory.template in<float>(slip_limit),
                       .out = force_arrays(memory, out, n)});
  memory.fetch();
  return out;
}

/// The parts of a volume, as its questions name them.
struct VolumeParts {
  std::vector<int> part_of;   ///< by vertex; −1 where it is on no triangle
  std::vector<int> first_of;  ///< by part: its lowest-numbered triangle

  explicit VolumeParts(const compare::Topology& topology) {
    std::vector<int> part_of_component(static_cast<std::size_t>(topology.vertex_count), -1);
    part_of.assign(part_of_component.size(), -1);
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
      for (const compare::Index v : topology.triangles[t]) {
        int& part = part_of_component[static_cast<std::size_t>(topology.component[static_cast<std::size_t>(v)])];
        if (part < 0) {
          part = static_cast<int>(first_of.size());
          first_of.push_back(static_cast<int>(t));
        }
        part_of[static_cast<std::size_t>(v)] = part;
      }
    }
  }
};

/// How many contacts each point has.
struct CountVolumeContacts {
  VolumeView volume;
  const Vec* points;  ///< who asks [m]
  int* count;         ///< by point, written

  OGC_HD void operator()(int i) const {
    const VolumeQuestion question(volume, points[i]);
    int found = 0;
    for (int part = 0; part < volume.part_count; ++part)
      question.visit_contacts(part, [&](const FoundVolumeContact&) { ++found; });
    count[i] = found;
  }
};

/// The contacts of each point, part after part.
struct FindVolumeContacts {
  VolumeView volume;
  const Vec* points;          ///< who asks [m]
  const int* first;           ///< by point: place of its first contact
  FoundVolumeContact* found;  ///< written

  OGC_HD void operator()(int i) const {
    const VolumeQuestion question(volume, points[i]);
    int at = first[i];
    for (int part = 0; part < volume.part_count; ++part)
      question.visit_contacts(part, [&](const FoundVolumeContact& contact) { found[at++] = contact; });
  }
};

/// The stage `volume_depth`.
template <class Backend>
compare::VolumeDepthOut probe_volume_depth(Backend& backend, const compare::VolumeDepthIn& in) {
  const Surface<Backend> surface(*in.topology, {});
  Bvh<Backend> tree(surface.view());
  ProbeMemory<Backend> memory(backend);
  const auto copied = [](std::span<const compare::Vec3f> x) { return std::vector<compare::Vec3f>(x.begin(), x.end()); };
  const Vec* positions = memory.template in<Vec>(copied(in.positions));
  const float* no_radius = memory.template in<float>(std::vector<float>{0});
  tree.rebuild(backend, positions);
  const RefitTrees refit = tree.refit(positions, no_radius);
  backend.for_each(refit.count(), refit);
  const VolumeParts parts(*in.topology);
  const VolumeView volume{.surface = surface.view(),
                          .positions = {memory.padded(copied(in.positions))},
                          .tree = tree.facets(),
                          .part_of = memory.template in<int>(parts.part_of),
                          .first_of = memory.template in<int>(parts.first_of),
                          .part_count = static_cast<int>(parts.first_of.size()),
                          .contact_radius = in.contact_radius};
  const Vec* points = memory.template in<Vec>(copied(in.points));
  const int n = static_cast<int>(in.points.size());
  std::vector<int> count;
  int* const counted = memory.template out<int>(count, in.points.size());
  backend.for_each(n, CountVolumeContacts{volume, points, counted});
  memory.fetch();
  std::vector<int> first(count.size() + 1);
  for (std::size_t i = 0; i < count.size(); ++i) first[i + 1] = first[i] + count[i];
  ProbeMemory<Backend> lists(backend);
  std::vector<FoundVolumeContact> found;
  FoundVolumeContact* const to = lists.template out<FoundVolumeContact>(found, static_cast<std::size_t>(first.back()));
  backend.for_each(n, FindVolumeContacts{volume, points, lists.template in<int>(first), to});
  lists.fetch();
  compare::VolumeDepthOut out;
  for (std::size_t i = 0; i < count.size(); ++i)
    for (int k = first[i]; k < first[i + 1]; ++k) {
      const FoundVolumeContact& c = found[static_cast<std::size_t>(k)];
      out.contacts.push_back({.point = static_cast<compare::Index>(i),
                              .inside = static_cast<std::uint8_t>(c.inside),
                              .triangle = c.triangle,
                              .face = face_of(c.face, *in.topology),
                              .weights = {c.weights[0], c.weights[1], c.weights[2]},
                              .direction = {c.direction.x, c.direction.y, c.direction.z},
                              .depth = c.depth});
    }
  std::ranges::sort(out.contacts, {},
                    [](const compare::VolumeContact& c) { return std::tuple(c.point, c.inside, c.triangle, c.face); });
  return out;
}

}  // namespace ogc::fast

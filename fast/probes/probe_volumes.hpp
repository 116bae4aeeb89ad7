// The judge's way in to volumes: contacts of points with a volume, found in its tree, and the force of one contact,
// each case alone.
#pragma once

#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

#include "compare/stages/volume_depth.hpp"
#include "compare/stages/volume_force.hpp"
#include "fast/probes/download.hpp"
#include "fast/probes/probe_forces.hpp"
#include "fast/stages/surface.hpp"
#include "fast/stages/volumes.hpp"

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

/// How many contacts each point has, and where its next search begins.
struct CountAtPoint {
  VolumeView volume;
  const Vec* points;       ///< who asks [m]
  const int* first_facet;  ///< by part: any of its facets
  int* nearest;            ///< by point, part by part, written: as AskVolumes has it
  int* count;              ///< by point, written

  OGC_HD void operator()(int i) const {
    const VolumeQuestion question(volume, points[i]);
    int found = 0;
    for (int part = 0; part < volume.part_count; ++part) {
      const NearestFacet answer = question.nearest_of(part, first_facet[part]);
      nearest[i * volume.part_count + part] = answer_of(answer);
      question.visit_contacts(part, answer, [&](const FoundVolumeContact&) { ++found; });
    }
    count[i] = found;
  }
};

/// The contacts of each point, part after part.
struct FindAtPoint {
  VolumeView volume;
  const Vec* points;          ///< who asks [m]
  const int* nearest;         ///< of CountAtPoint
  const int* first;           ///< by point: place of its first contact
  FoundVolumeContact* found;  ///< written

  OGC_HD void operator()(int i) const {
    const VolumeQuestion question(volume, points[i]);
    int at = first[i];
    for (int part = 0; part < volume.part_count; ++part)
      question.visit_contacts(part, nearest_in(nearest[i * volume.part_count + part]),
                              [&](const FoundVolumeContact& contact) { found[at++] = contact; });
  }
};

/// A contact of `point` in the words of the contract.
inline compare::VolumeContact contact_of(compare::Index point, const FoundVolumeContact& c,
                                         const compare::Topology& topology) {
  return {.point = point,
          .inside = static_cast<std::uint8_t>(c.inside),
          .triangle = c.triangle,
          .face = face_of(c.face, topology),
          .weights = {c.weights[0], c.weights[1], c.weights[2]},
          .direction = {c.direction.x, c.direction.y, c.direction.z},
          .depth = c.depth};
}

/// In the order of the contract.
inline void sort_contacts(std::vector<compare::VolumeContact>& contacts) {
  std::ranges::sort(contacts, {},
                    [](const compare::VolumeContact& c) { return std::tuple(c.point, c.inside, c.triangle, c.face); });
}

/// The stage `volume_depth`.
template <class Backend>
compare::VolumeDepthOut probe_volume_depth(Backend& backend, const compare::VolumeDepthIn& in) {
  const Surface<Backend> surface(*in.topology, {});
  const VolumeParts parts = volume_parts(*in.topology, in.positions);
  VolumeTrees<Backend> trees(parts);
  ProbeMemory<Backend> memory(backend);
  const auto copied = [](std::span<const compare::Vec3f> x) { return std::vector<compare::Vec3f>(x.begin(), x.end()); };
  trees.refit(backend, surface.view(), memory.template in<Vec>(copied(in.positions)));
  const VolumeView volume{
      surface.view(), {memory.padded(copied(in.positions))}, trees.parts(), trees.count(), in.contact_radius};
  const Vec* points = memory.template in<Vec>(copied(in.points));
  const int n = static_cast<int>(in.points.size());
  std::vector<int> first_facet, count, nearest;
  for (const std::vector<int>& facets : parts) first_facet.push_back(facets.front());
  int* const counted = memory.template out<int>(count, in.points.size());
  int* const answers = memory.template out<int>(nearest, in.points.size() * parts.size());
  backend.for_each(n, CountAtPoint{volume, points, memory.template in<int>(first_facet), answers, counted});
  memory.fetch();
  std::vector<int> first(count.size() + 1);
  for (std::size_t i = 0; i < count.size(); ++i) first[i + 1] = first[i] + count[i];
  ProbeMemory<Backend> lists(backend);
  std::vector<FoundVolumeContact> found;
  FoundVolumeContact* const to = lists.template out<FoundVolumeContact>(found, static_cast<std::size_t>(first.back()));
  backend.for_each(n, FindAtPoint{volume, points, answers, lists.template in<int>(first), to});
  lists.fetch();
  compare::VolumeDepthOut out;
  for (std::size_t i = 0; i < count.size(); ++i)
    for (int k = first[i]; k < first[i + 1]; ++k)
      out.contacts.push_back(
          contact_of(static_cast<compare::Index>(i), found[static_cast<std::size_t>(k)], *in.topology));
  sort_contacts(out.contacts);
  return out;
}

/// The contacts of a simulation's last search, by the vertices of its slots; waits for what is enqueued.
template <class Backend>
compare::VolumeDepthOut download_volume_contacts(Backend& backend, const Volumes<Backend>& volumes,
                                                 const SweepVertex* vertices, const compare::Topology& topology) {
  compare::VolumeDepthOut out;
  if (!volumes.is_used()) return out;
  const auto slots = static_cast<std::size_t>(volumes.slots()), capacity = static_cast<std::size_t>(volumes.capacity());
  const std::vector<int> counts = download_items(backend, volumes.stream().counts, slots);
  const std::vector<FoundVolumeContact> found = download_items(backend, volumes.found(), slots * capacity);
  const std::vector<SweepVertex> of_slot = download_items(backend, vertices, slots);
  for (std::size_t slot = 0; slot < slots; ++slot)
    for (std::size_t k = 0; k < static_cast<std::size_t>(counts[slot]); ++k)
      out.contacts.push_back(contact_of(of_slot[slot].vertex, found[slot * capacity + k], topology));
  sort_contacts(out.contacts);
  return out;
}

}  // namespace ogc::fast

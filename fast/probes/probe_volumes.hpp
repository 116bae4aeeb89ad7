// Lets the judge test volumes: finds the contacts between points and a volume by the volume's tree, and computes the
// force of one contact. Each case is computed alone.
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

/// Computes force and block of a contact with a volume. Runs once for each case.
struct ProbeVolumeForce {
  const VolumeContact* contact;              ///< by case
  const Vec *vertex, *start;                 ///< by case: the point and three corners [m]
  const int* own;                            ///< by case: the role of the vertex that is solved for
  const float *contact_radius, *slip_limit;  ///< by case: r, ε_v h [m]
  ForceArrays out;                           ///< by case, written

  OGC_HD void operator()(int i) const {
    ForceAndBlock sum;
    add_volume_contact(contact[i], vertex + 4 * i, start + 4 * i, own[i], contact_radius[i], slip_limit[i], sum);
    out.store(i, sum);
  }
};

/// Answers the stage `volume_force`.
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

/// A point that is tested against a volume.
struct VolumeAsker {
  Vec position;  ///< [m]
  int own;       ///< the vertex at the point, or −1
};

/// Counts the contacts of each point. Stores the nearest facets, where the searches of FindAtPoint begin.
struct CountAtPoint {
  VolumeView volume;
  const VolumeAsker* askers;
  const int* first_facet;  ///< by part: any of its facets
  int* nearest;            ///< by point and part, written: result of answer_of; for a solid part the facet, or −1
  int* count;              ///< by point, written
  int* unresolved;         ///< by point: sheets without a path to the boundary, written

  OGC_HD void operator()(int i) const {
    const VolumeQuestion question(volume, askers[i].position);
    const SolidQuestion of_solids(volume, askers[i].position, askers[i].own);
    int found = 0, lost = 0;
    const auto add = [&](const FoundVolumeContact&) { ++found; };
    for (int part = 0; part < volume.part_count; ++part) {
      int& answer = nearest[i * volume.part_count + part];
      if (volume.parts[part].is_solid()) {
        const SolidAnswer of_part = of_solids.visit_contacts(part, -1, add);
        lost += of_part.unresolved;
        answer = of_part.facet;
      } else {
        const NearestFacet facet = question.nearest_of(part, first_facet[part]);
        answer = answer_of(facet);
        question.visit_contacts(part, facet, add);
      }
    }
    count[i] = found;
    unresolved[i] = lost;
  }
};

/// Finds the contacts of each point, part after part.
struct FindAtPoint {
  VolumeView volume;
  const VolumeAsker* askers;
  const int* nearest;         ///< the results of CountAtPoint
  const int* first;           ///< by point: index of its first contact in `found`
  FoundVolumeContact* found;  ///< written

  OGC_HD void operator()(int i) const {
    const VolumeQuestion question(volume, askers[i].position);
    const SolidQuestion of_solids(volume, askers[i].position, askers[i].own);
    int at = first[i];
    const auto add = [&](const FoundVolumeContact& contact) { found[at++] = contact; };
    for (int part = 0; part < volume.part_count; ++part) {
      const int answer = nearest[i * volume.part_count + part];
      if (volume.parts[part].is_solid())
        of_solids.visit_contacts(part, answer, add);
      else
        question.visit_contacts(part, nearest_in(answer), add);
    }
  }
};

/// Returns a contact of `point` in the judge's type.
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

/// Sorts contacts into the judge's order.
inline void sort_contacts(std::vector<compare::VolumeContact>& contacts) {
  std::ranges::sort(contacts, {},
                    [](const compare::VolumeContact& c) { return std::tuple(c.point, c.inside, c.triangle, c.face); });
}

/// Answers the stage `volume_depth`.
template <class Backend>
compare::VolumeDepthOut probe_volume_depth(Backend& backend, const compare::VolumeDepthIn& in) {
  const Surface<Backend> surface(*in.topology, {});
  const VolumeParts parts = volume_parts(*in.topology, in.tetrahedra, in.cavities, in.positions);
  VolumeTrees<Backend> trees(parts, solid_tables(*in.topology, in.tetrahedra));
  ProbeMemory<Backend> memory(backend);
  const std::vector<compare::Vec3f> positions(in.positions.begin(), in.positions.end());
  trees.refit(backend, surface.view(), memory.template in<Vec>(positions));
  const VolumeView volume{surface.view(), {memory.padded(positions)}, trees.parts(),
                          trees.count(),  in.contact_radius,          trees.solids()};
  std::vector<VolumeAsker> askers;
  for (std::size_t i = 0; i < in.points.size(); ++i) {
    const compare::Vec3f& x = in.points[i];
    askers.push_back({{x.x, x.y, x.z}, in.own.empty() ? -1 : in.own[i]});
  }
  const VolumeAsker* const asking = memory.template in<VolumeAsker>(askers);
  const int n = static_cast<int>(in.points.size());
  std::vector<int> first_facet, count, nearest, unresolved;
  for (const PartOrder& part : parts) first_facet.push_back(part.facets.front());
  int* const counted = memory.template out<int>(count, in.points.size());
  int* const lost = memory.template out<int>(unresolved, in.points.size());
  int* const answers = memory.template out<int>(nearest, in.points.size() * parts.size());
  backend.for_each(n, CountAtPoint{volume, asking, memory.template in<int>(first_facet), answers, counted, lost});
  memory.fetch();
  std::vector<int> first(count.size() + 1);
  for (std::size_t i = 0; i < count.size(); ++i) first[i + 1] = first[i] + count[i];
  ProbeMemory<Backend> lists(backend);
  std::vector<FoundVolumeContact> found;
  FoundVolumeContact* const to = lists.template out<FoundVolumeContact>(found, static_cast<std::size_t>(first.back()));
  backend.for_each(n, FindAtPoint{volume, asking, answers, lists.template in<int>(first), to});
  lists.fetch();
  compare::VolumeDepthOut out;
  for (std::size_t i = 0; i < count.size(); ++i) {
    const auto point = static_cast<compare::Index>(i);
    for (int k = first[i]; k < first[i + 1]; ++k)
      out.contacts.push_back(contact_of(point, found[static_cast<std::size_t>(k)], *in.topology));
    out.unresolved.insert(out.unresolved.end(), static_cast<std::size_t>(unresolved[i]), point);
  }
  sort_contacts(out.contacts);
  return out;
}

/// Returns the contacts of a simulation's last search; waits for all enqueued work.
template <class Backend>
compare::VolumeDepthOut download_volume_contacts(Backend& backend, const Volumes<Backend>& volumes,
                                                 const compare::Topology& topology) {
  compare::VolumeDepthOut out;
  if (!volumes.is_used()) return out;
  const auto rows = static_cast<std::size_t>(volumes.rows()),
             capacity = static_cast<std::size_t>(volumes.stream().capacity);
  const std::vector<int> counts = download_items(backend, volumes.stream().counts, rows),
                         askers = download_items(backend, volumes.askers(), rows);
  const std::vector<FoundVolumeContact> found = download_items(backend, volumes.found(), rows * capacity);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t k = 0; k < static_cast<std::size_t>(counts[row]); ++k)
      out.contacts.push_back(contact_of(askers[row], found[row * capacity + k], topology));
  sort_contacts(out.contacts);
  if (volumes.unresolved() == nullptr) return out;
  const std::vector<int> unresolved = download_items(backend, volumes.unresolved(), rows);
  for (std::size_t row = 0; row < rows; ++row)
    out.unresolved.insert(out.unresolved.end(), static_cast<std::size_t>(unresolved[row]), askers[row]);
  std::ranges::sort(out.unresolved);
  return out;
}

}  // namespace ogc::fast

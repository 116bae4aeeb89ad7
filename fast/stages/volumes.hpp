// The volumes of a scene (§3.9; fast/kernels/volumes/): memory and launches of their trees and of their contacts with
// free vertices. A scene without volumes has none of it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "fast/kernels/volumes/contacts.hpp"
#include "fast/kernels/volumes/trees.hpp"
#include "fast/stages/backend.hpp"
#include "fast/stages/bvh.hpp"
#include "fast/stages/volume_parts.hpp"

namespace ogc::fast {

/// Trees of parts, and what is known of their tetrahedra.
template <class Backend>
class VolumeTrees {
 public:
  VolumeTrees(const VolumeParts& parts, const SolidTables& solids) : facet_trees_(static_cast<int>(parts.size())) {
    std::vector<PartTree> trees;
    std::vector<int> order;
    std::size_t nodes = 0;
    const auto plant = [&](const std::vector<int>& items) {
      trees.push_back({shape_of_tree(static_cast<int>(items.size())), nullptr, items_});
      items_ += RefitTrees::filled_up(static_cast<int>(items.size()));
      nodes += static_cast<std::size_t>(node_count(trees.back().tree));
      order.insert(order.end(), items.begin(), items.end());
    };
    for (const PartOrder& part : parts) plant(part.facets);
    for (const PartOrder& part : parts)
      if (!part.tetrahedra.empty()) plant(part.tetrahedra);
    const std::vector<Quad> empty(nodes);
    nodes_.upload(empty.data(), nodes);
    arrivals_.resize(nodes);
    arrivals_.fill_zero();
    order_.upload(order.data(), order.size());
    Quad* node = nodes_.data();
    int* arrival = arrivals_.data();
    const int* first = order_.data();
    for (PartTree& tree : trees) {
      tree.tree.nodes = node, tree.arrivals = arrival, tree.tree.order = first;
      const int own = node_count(tree.tree);
      node += own, arrival += own, first += tree.tree.count;
    }
    std::vector<VolumePart> views;
    std::size_t solid = parts.size();
    for (std::size_t k = 0; k < parts.size(); ++k)
      views.push_back({trees[k], parts[k].tetrahedra.empty() ? PartTree{} : trees[solid++]});
    trees_.upload(trees.data(), trees.size());
    parts_.upload(views.data(), views.size());
    elements_.upload(solids.elements.data(), solids.elements.size());
    is_positive_.resize(solids.elements.size());
    offsets_.upload(solids.offsets.data(), solids.offsets.size());
    around_.upload(solids.items.data(), solids.items.size());
    owner_.upload(solids.owner.data(), solids.owner.size());
  }

  int count() const { return static_cast<int>(parts_.size()); }  ///< parts
  const VolumePart* parts() const { return parts_.data(); }      ///< on the backend
  /// The tetrahedra of the parts, signs as of the last refit.
  SolidView solids() {
    return {elements_.data(), is_positive_.data(), {offsets_.data(), around_.data()}, owner_.data()};
  }

  /// At these positions; by vertex, on the backend [m].
  void refit(Backend& backend, const SurfaceView& surface, const Vec* positions) {
    const RefitVolumes refit{surface, solids(), positions, trees_.data(), facet_trees_, static_cast<int>(trees_.size()),
                             items_};
    backend.for_each(refit.count(), refit);
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  int facet_trees_, items_ = 0;
  Buffer<Quad> nodes_;
  Buffer<int> arrivals_, order_, offsets_, around_, owner_;
  Buffer<PartTree> trees_;
  Buffer<VolumePart> parts_;
  Buffer<SolidElement> elements_;
  Buffer<std::uint8_t> is_positive_;
};

/// Who asks volumes at a detection, and what of the detection they need; all on the backend.
struct VolumeAskers {
  PaddedVecs volumes;           ///< positions of the volumes' vertices, by vertex [m]
  const Vec* position;          ///< of those who ask, by vertex [m]
  const SweepVertex* vertices;  ///< by slot: who asks
  ContactTables tables;         ///< k and μ
  float contact_radius;         ///< r [m]
  const StepControl* control;   ///< where it is not active nobody asks
};

/// The resident volumes of one scene.
template <class Backend>
class Volumes {
 public:
  /// `slots`: free vertices. No parts: there are no volumes, and nothing below does anything.
  Volumes(const SurfaceView& surface, const VolumeParts& parts, const SolidTables& solids, int slots)
      : surface_(surface), trees_(parts, solids), slots_(slots) {
    if (!is_used()) return;
    std::vector<int> answers;
    for (const PartOrder& part : parts)
      answers.insert(answers.end(), static_cast<std::size_t>(slots), answer_of({part.facets.front(), VolumeSide::far}));
    answers_.upload(answers.data(), answers.size());
    counts_.resize(static_cast<std::size_t>(slots));
    counts_.fill_zero();
    longest_.resize(1);
    reserve(usual_capacity);
  }

  /// Whether there are any.
  bool is_used() const { return trees_.count() > 0; }

  /// The trees at these positions; by vertex, on the backend [m].
  void refit(Backend& backend, const Vec* positions) {
    if (is_used()) trees_.refit(backend, surface_, positions);
  }

  /// The contacts of all free vertices. *overflow (on the backend) is set where a row was too short.
  void find(Backend& backend, const VolumeAskers& askers, int* overflow) {
    if (!is_used()) return;
    const VolumeView view{surface_,       askers.volumes,        trees_.parts(),
                          trees_.count(), askers.contact_radius, trees_.solids()};
    backend.for_each(slots_ * trees_.count(),
                     AskVolumes{view, askers.vertices, slots_, askers.position, askers.control, answers_.data()});
    backend.for_each(slots_, ListVolumeContacts{.volume = view,
                                                .vertices = askers.vertices,
                                                .slots = slots_,
                                                .position = askers.position,
                                                .control = askers.control,
                                                .answers = answers_.data(),
                                                .tables = askers.tables,
                                                .capacity = capacity_,
                                                .counts = counts_.data(),
                                                .stream = stream_.data(),
                                                .found = found_.data(),
                                                .longest = longest_.data(),
                                                .overflow = overflow});
  }

  /// What the sweep reads.
  VolumeStream stream() const { return {stream_.data(), counts_.data(), capacity_}; }
  /// What was found, beside the stream.
  const FoundVolumeContact* found() const { return found_.data(); }
  /// Free vertices, where there are volumes; else 0.
  int slots() const { return is_used() ? slots_ : 0; }

  /// Into the control, at the end of a step.
  void count(Backend& backend, float contact_radius, StepControl* control) const {
    backend.for_each(slots(), CountVolumeContacts{counts_.data(), found_.data(), capacity_, contact_radius, control});
  }

  /// Host only: rows as long as the last detection needed.
  void grow() {
    if (!is_used()) return;
    int longest = 0;
    longest_.download(&longest, 1);
    if (longest > capacity_) reserve(longest);
  }
  /// Contacts that fit in a row.
  int capacity() const { return capacity_; }
  /// Host only: rows of this length, empty until the next detection.
  void reserve(int capacity) {
    capacity_ = capacity;
    const auto places = static_cast<std::size_t>(slots_) * static_cast<std::size_t>(capacity);
    stream_.resize(places), found_.resize(places);
    counts_.fill_zero();
    longest_.fill_zero();
  }

  /// Host only: contacts in place of those of a detection, row by row.
  void put(const std::vector<std::vector<VolumeIncidence>>& rows) {
    std::vector<int> counts;
    std::size_t longest = 1;
    for (const auto& row : rows) {
      counts.push_back(static_cast<int>(row.size()));
      longest = std::max(longest, row.size());
    }
    reserve(static_cast<int>(longest));
    std::vector<VolumeIncidence> all(rows.size() * longest);
    for (std::size_t slot = 0; slot < rows.size(); ++slot)
      std::copy(rows[slot].begin(), rows[slot].end(), all.begin() + static_cast<std::ptrdiff_t>(slot * longest));
    stream_.upload(all.data(), all.size());
    counts_.upload(counts.data(), counts.size());
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  /// A vertex near a ridge or in a junction of parts has two or three.
  static constexpr int usual_capacity = 4;

  SurfaceView surface_;
  VolumeTrees<Backend> trees_;
  int slots_, capacity_ = 0;
  Buffer<int> answers_, counts_, longest_;
  Buffer<VolumeIncidence> stream_;
  Buffer<FoundVolumeContact> found_;
};

}  // namespace ogc::fast

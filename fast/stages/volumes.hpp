// Holds the memory of a scene's volumes (§3.9; fast/kernels/volumes/), their trees and their contacts, and launches
// their kernels. Without volumes, the memory is empty and nothing is launched.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

#include "fast/kernels/volumes/contacts.hpp"
#include "fast/kernels/volumes/trees.hpp"
#include "fast/stages/backend.hpp"
#include "fast/stages/bvh.hpp"
#include "fast/stages/volume_parts.hpp"

namespace ogc::fast {

/// Holds the trees of the parts and the data of their tetrahedra.
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
  /// Returns the tetrahedra of the parts; their signs are those of the last refit.
  SolidView solids() {
    return {elements_.data(), is_positive_.data(), {offsets_.data(), around_.data()}, owner_.data()};
  }

  /// Refits the trees to `positions` [m], by vertex, on the backend.
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

/// The arguments of a detection that tests vertices against volumes; all pointers are to the backend.
struct VolumeAskers {
  PaddedVecs volumes;          ///< positions of the vertices of driven volumes, by vertex [m]
  const Vec* position;         ///< positions of the tested vertices and of free volumes, by vertex [m]
  ContactTables tables;        ///< k and μ
  float contact_radius;        ///< r [m]
  const StepControl* control;  ///< if it is not active, no vertex is tested
};

/// Holds the resident volumes of one scene. If the scene has no volumes, the functions do nothing.
template <class Backend>
class Volumes {
 public:
  /// `rows`: the scene's tested vertices. `slots`: number of free vertices. `colour`: colours of the sweep by vertex,
  /// on the backend.
  Volumes(const SurfaceView& surface, const VolumeParts& parts, const SolidTables& solids, const AskerRows& rows,
          int slots, const int* colour)
      : surface_(surface),
        trees_(parts, solids),
        rows_(static_cast<int>(rows.askers.size())),
        slots_(slots),
        has_solids_(!solids.elements.empty()),
        slot_of_host_(rows.slot_of),
        colour_(colour) {
    if (!is_used()) return;
    std::vector<int> answers;
    for (const PartOrder& part : parts)
      answers.insert(answers.end(), rows.askers.size(), answer_of({part.facets.front(), VolumeSide::far}));
    answers_.upload(answers.data(), answers.size());
    askers_.upload(rows.askers.data(), rows.askers.size());
    counts_.resize(rows.askers.size());
    counts_.fill_zero();
    longest_.resize(2);
    if (has_solids_) unresolved_.resize(rows.askers.size());
    if (!has_free()) {
      const std::vector<ClearBall> none(answers.size());
      clear_.upload(none.data(), none.size());
    }
    if (has_free()) {
      slot_of_.upload(rows.slot_of.data(), rows.slot_of.size());
      padded_.resize(rows.slot_of.size());
      corner_counts_.resize(static_cast<std::size_t>(slots));
      corner_counts_.fill_zero();
    }
    reserve(usual_capacity);
    if (has_free()) reserve_corners(usual_corner_capacity);
  }

  /// Returns whether the scene has volumes.
  bool is_used() const { return trees_.count() > 0; }
  /// Returns whether the scene has free volumes.
  bool has_free() const { return !slot_of_host_.empty(); }

  /// Refits the trees of driven volumes to `positions` [m], by vertex, on the backend. Driven volumes keep these
  /// positions during the step.
  void refit(Backend& backend, const Vec* positions) {
    if (!is_used() || has_free()) return;
    backend.for_each(static_cast<int>(clear_.size()), ForgetClearBalls{clear_.data()});
    trees_.refit(backend, surface_, positions);
  }

  /// Finds the contacts of all askers. *overflow (on the backend) is set if a row was too short.
  void find(Backend& backend, const VolumeAskers& asked, int* overflow) {
    if (!is_used()) return;
    PaddedVecs volumes = asked.volumes;
    if (has_free()) {
      backend.for_each(static_cast<int>(padded_.size()), PlaceVolumes{asked.position, padded_.data()});
      trees_.refit(backend, surface_, asked.position);
      volumes = {padded_.data()};
    }
    const VolumeView view{surface_, volumes, trees_.parts(), trees_.count(), asked.contact_radius, trees_.solids()};
    backend.for_each(rows_ * trees_.count(), AskVolumes{.volume = view,
                                                        .askers = askers_.data(),
                                                        .rows = rows_,
                                                        .position = asked.position,
                                                        .control = asked.control,
                                                        .answers = answers_.data(),
                                                        .clear = has_free() ? nullptr : clear_.data()});
    if (has_solids_)
      list<true>(backend, view, asked, overflow);
    else
      list<false>(backend, view, asked, overflow);
    if (!has_free()) return;
    const CornerRows corners{slot_of_.data(), corner_capacity_, corner_counts_.data(), corner_codes_.data()};
    backend.for_each(slots_, ForgetCorners{asked.control, corners});
    backend.for_each(rows_, FillCorners{asked.control, counts_.data(), stream_.data(), capacity_, corners});
    backend.for_each(slots_, SortCorners{asked.control, corners, longest_.data() + 1, overflow});
  }

  VolumeStream stream() const {
    VolumeStream stream{stream_.data(), counts_.data(), capacity_};
    if (!has_free()) return stream;
    stream.colour = colour_;
    stream.corner_codes = corner_codes_.data();
    stream.corner_counts = corner_counts_.data();
    stream.corner_capacity = corner_capacity_;
    return stream;
  }
  /// Returns the contacts as the search found them, at the same indices as in the stream.
  const FoundVolumeContact* found() const { return found_.data(); }
  /// Return, by row, the tested vertex, and the number of sheets without a path to the boundary (null if there are no
  /// solids). Both are on the backend.
  const int* askers() const { return askers_.data(); }
  const int* unresolved() const { return unresolved_.data(); }
  /// Returns the number of rows of contacts; 0 if there are no volumes.
  int rows() const { return is_used() ? rows_ : 0; }

  /// Adds the numbers of contacts to the control's counters, at the end of a step.
  void count(Backend& backend, float contact_radius, StepControl* control) const {
    backend.for_each(rows(), CountVolumeContacts{counts_.data(), found_.data(), unresolved_.data(), capacity_,
                                                 contact_radius, control});
  }

  /// Host only: makes rows as long as the last detection needed.
  void grow() {
    if (!is_used()) return;
    int longest[2] = {0, 0};
    longest_.download(longest, 2);
    if (longest[0] > capacity_) reserve(longest[0]);
    if (longest[1] > corner_capacity_) reserve_corners(longest[1]);
  }
  /// Returns how many contacts fit in the row of a tested vertex and, if volumes are free, in the row of a corner of
  /// their facets.
  std::vector<std::int64_t> capacities() const {
    if (!is_used()) return {};
    if (!has_free()) return {capacity_};
    return {capacity_, corner_capacity_};
  }
  /// Host only: sets the capacities of the rows, which are empty until the next detection. Throws std::invalid_argument
  /// if `capacities` and capacities() differ in length, or if a capacity is out of range.
  void reserve(std::span<const std::int64_t> capacities) {
    if (capacities.size() != this->capacities().size()) throw std::invalid_argument("capacities of other lists");
    for (const std::int64_t capacity : capacities)
      if (capacity <= 0 || capacity > most_places / std::max({1, rows_, slots_}))
        throw std::invalid_argument("capacities of other lists");
    if (!capacities.empty()) reserve(static_cast<int>(capacities[0]));
    if (capacities.size() > 1) reserve_corners(static_cast<int>(capacities[1]));
  }

  /// Host only: replaces the contacts of a detection by these rows.
  void put(const std::vector<std::vector<VolumeIncidence>>& rows) {
    std::vector<int> counts;
    std::size_t longest = 1;
    for (const auto& row : rows) {
      counts.push_back(static_cast<int>(row.size()));
      longest = std::max(longest, row.size());
    }
    reserve(static_cast<int>(longest));
    std::vector<VolumeIncidence> all(rows.size() * longest);
    for (std::size_t row = 0; row < rows.size(); ++row)
      std::copy(rows[row].begin(), rows[row].end(), all.begin() + static_cast<std::ptrdiff_t>(row * longest));
    stream_.upload(all.data(), all.size());
    counts_.upload(counts.data(), counts.size());
    if (has_free()) put_corners(rows);
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  /// A vertex near a ridge, or where parts meet, has two or three contacts.
  static constexpr int usual_capacity = 4;
  /// A vertex is a corner of about six triangles; each of them may have contacts with several vertices.
  static constexpr int usual_corner_capacity = 16;
  /// A corner's code holds the index of a contact and, in two bits, the role. So an index has at most 29 bits.
  static constexpr std::int64_t most_places = (std::int64_t{1} << 29) - 1;

  template <bool has_solids>
  void list(Backend& backend, const VolumeView& view, const VolumeAskers& asked, int* overflow) {
    backend.for_each(rows_, ListVolumeContacts<has_solids>{.volume = view,
                                                           .askers = askers_.data(),
                                                           .rows = rows_,
                                                           .position = asked.position,
                                                           .control = asked.control,
                                                           .answers = answers_.data(),
                                                           .tables = asked.tables,
                                                           .capacity = capacity_,
                                                           .counts = counts_.data(),
                                                           .stream = stream_.data(),
                                                           .found = found_.data(),
                                                           .unresolved = unresolved_.data(),
                                                           .longest = longest_.data(),
                                                           .overflow = overflow});
  }

  void reserve(int capacity) {
    capacity_ = capacity;
    const auto places = static_cast<std::size_t>(rows_) * static_cast<std::size_t>(capacity);
    stream_.resize(places), found_.resize(places);
    counts_.fill_zero();
    if (unresolved_.size() > 0) unresolved_.fill_zero();
    longest_.fill_zero();
    if (has_free()) corner_counts_.fill_zero();
  }

  void reserve_corners(int capacity) {
    corner_capacity_ = capacity;
    corner_codes_.resize(static_cast<std::size_t>(slots_) * static_cast<std::size_t>(capacity));
    corner_counts_.fill_zero();
  }

  void put_corners(const std::vector<std::vector<VolumeIncidence>>& rows) {
    std::vector<std::vector<int>> corners(static_cast<std::size_t>(slots_));
    for (std::size_t row = 0; row < rows.size(); ++row) {
      for (std::size_t k = 0; k < rows[row].size(); ++k) {
        const VolumeIncidence& incidence = rows[row][k];
        const int place = static_cast<int>(row) * capacity_ + static_cast<int>(k);
        for (int role = 1; role < 4; ++role) {
          const int slot = slot_of_host_[static_cast<std::size_t>(incidence.vertex(role))];
          if (slot >= 0 && incidence.contact.weight(role) != 0)
            corners[static_cast<std::size_t>(slot)].push_back(place << 2 | role);
        }
      }
    }
    std::size_t longest = 1;
    for (const std::vector<int>& row : corners) longest = std::max(longest, row.size());
    reserve_corners(static_cast<int>(longest));
    std::vector<int> counts, codes(corners.size() * longest);
    for (std::size_t slot = 0; slot < corners.size(); ++slot) {
      counts.push_back(static_cast<int>(corners[slot].size()));
      std::ranges::copy(corners[slot], codes.begin() + static_cast<std::ptrdiff_t>(slot * longest));
    }
    corner_codes_.upload(codes.data(), codes.size());
    corner_counts_.upload(counts.data(), counts.size());
  }

  SurfaceView surface_;
  VolumeTrees<Backend> trees_;
  int rows_, slots_, capacity_ = 0, corner_capacity_ = 0;
  bool has_solids_;
  std::vector<int> slot_of_host_;
  const int* colour_;
  Buffer<int> askers_, answers_, counts_, unresolved_, longest_;
  Buffer<ClearBall> clear_;                             ///< by index in `answers_`; only if no volume is free
  Buffer<int> slot_of_, corner_counts_, corner_codes_;  ///< only if some volumes are free
  Buffer<PaddedVec> padded_;  ///< only if some volumes are free: positions of the detection, by vertex [m]
  Buffer<VolumeIncidence> stream_;
  Buffer<FoundVolumeContact> found_;
};

}  // namespace ogc::fast

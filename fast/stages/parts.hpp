// Launches the work by which a part of a simulation (fast/kernels/parts.hpp) and the other parts keep the same state.
// Without other parts it does nothing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fast/kernels/bound.hpp"
#include "fast/kernels/parts.hpp"
#include "fast/stages/beside.hpp"
#include "fast/stages/colouring.hpp"
#include "fast/stages/hall.hpp"
#include "fast/stages/rest_state.hpp"

namespace ogc::fast {

/// Items begin … end − 1.
struct Range {
  int begin = 0, end = 0;
  int count() const { return end - begin; }
};

/// Returns the first vertex of each part, and behind them the number of vertices. The parts have about as many free
/// vertices each. Vertices of a component have consecutive numbers, so that few components are cut.
inline std::vector<int> part_begins(const Colouring& colouring, int parts) {
  std::vector<int> free = colouring.order;
  std::sort(free.begin(), free.end());
  std::vector<int> begins{0};
  for (int p = 1; p < parts; ++p) {
    const std::size_t place = free.size() * static_cast<std::size_t>(p) / static_cast<std::size_t>(parts);
    begins.push_back(place < free.size() ? free[place] : static_cast<int>(colouring.colour.size()));
  }
  begins.push_back(static_cast<int>(colouring.colour.size()));
  return begins;
}

/// Adds the parts that read vertices because of elements of one kind. `begins`: see part_begins; `places`: see
/// row_places_of.
template <class Kind>
void add_readers(const AtRest<Kind>& rest, const Colouring& colouring, const std::vector<int>& begins,
                 const std::vector<int>& places, std::vector<std::uint64_t>& readers) {
  for (const auto& element : rest.elements()) {
    std::vector<std::pair<int, std::uint64_t>> free;  // slot, bit of its part
    std::uint64_t all = 0;
    for (int role = 0; role < Kind::count(element); ++role) {
      const int v = Kind::vertices(element)[role];
      if (colouring.colour[as_index(v)] < 0) continue;
      const auto part = std::upper_bound(begins.begin(), begins.end(), v) - begins.begin() - 1;
      free.emplace_back(places[as_index(v)], std::uint64_t{1} << part);
      all |= free.back().second;
    }
    for (const auto& [slot, own] : free) readers[as_index(slot)] |= all & ~own;
  }
}

/// Returns, by slot, the parts that read a vertex because of elements (Readers::readers).
template <class... All>
std::vector<std::uint64_t> readers_of_elements(KindList<All...>, const RestState& rest, const Colouring& colouring,
                                               const std::vector<int>& begins) {
  std::vector<std::uint64_t> readers(colouring.order.size());
  const std::vector<int> places = row_places_of(colouring);
  (add_readers<All>(at_rest<All>(rest), colouring, begins, places, readers), ...);
  return readers;
}

/// One part of a simulation.
template <class Backend>
class Parts {
 public:
  /// `hall`: where this part meets the others; null: there are no others. `own`: number of this part.
  Parts(Backend& backend, std::shared_ptr<Hall> hall, int own, const Colouring& colouring, const RestState& rest)
      : backend_(backend), hall_(std::move(hall)), own_(own) {
    const int count = hall_ == nullptr ? 1 : hall_->parts();
    const std::vector<int> begins = part_begins(colouring, count);
    vertices_ = {begins[static_cast<std::size_t>(own)], begins[static_cast<std::size_t>(own) + 1]};
    for (int c = 0; c < colouring.count; ++c) {
      const auto order = colouring.order.begin(), first = order + colouring.begin[static_cast<std::size_t>(c)],
                 last = order + colouring.begin[static_cast<std::size_t>(c) + 1];
      slots_.push_back({static_cast<int>(std::lower_bound(first, last, vertices_.begin) - order),
                        static_cast<int>(std::lower_bound(first, last, vertices_.end) - order)});
    }
    if (hall_ == nullptr) return;
    begin_.upload(begins.data(), begins.size());
    const auto parts = static_cast<std::size_t>(count);
    arrays_.resize(parts);
    inbox_.resize(2 * parts);
    places_.resize(parts + 1);
    const std::vector<std::uint64_t> readers = readers_of_elements(Kinds{}, rest, colouring, begins);
    of_elements_.upload(readers.data(), readers.size());
    readers_.upload(readers.data(), readers.size());
    if constexpr (may_divide)
      backend_.join(*hall_, own);
    else
      throw std::invalid_argument("this backend has no parts");
  }

  bool is_one_of_several() const { return hall_ != nullptr; }
  int count() const { return hall_ == nullptr ? 1 : hall_->parts(); }
  int own() const { return own_; }
  Range vertices() const { return vertices_; }  ///< own vertices
  /// Returns what notes the readers of the own vertices.
  Readers readers() {
    return {readers_.data(), begin_.data(), static_cast<int>(readers_.size()), vertices_.begin, vertices_.end};
  }
  /// Returns the own slots of a colour.
  Range slots(int colour) const { return slots_[static_cast<std::size_t>(colour)]; }

  /// Host only, outside a step: makes room for the contacts of a detection.
  void reserve(int contacts) {
    if (hall_ != nullptr) found_.resize(static_cast<std::size_t>(contacts));
  }
  /// Host only, outside a step: waits for all parts.
  void wait() {
    if (hall_ != nullptr) hall_->meet();
  }
  /// Host only, outside a step: tells all parts where this part's arrays are; they may have moved.
  void publish(PartArrays arrays) {
    if (hall_ == nullptr) return;
    arrays.inbox = inbox_.data(), arrays.found = found_.data();
    hall_->arrays[static_cast<std::size_t>(own_)] = arrays;
    hall_->meet();
    arrays_.upload(hall_->arrays.data(), hall_->arrays.size());
    hall_->meet();  // before a part changes its item again
  }

  /// Waits until all parts have come here.
  void meet() {
    if constexpr (may_divide) {
      if (hall_ != nullptr) backend_.meet(0, Nothing{}, Nothing{});
    }
  }
  /// Shares the positions of the own vertices after a round of the guess loop, and what was counted. The arguments are
  /// those of GuessVertex.
  void share_guess(const Vec* position, const Vec* taken, int vertex_count, StepControl* control) {
    if constexpr (may_divide) {
      if (hall_ == nullptr) return;
      const SendGuess send{view(), vertices_.begin, vertex_count, position, taken, control};
      const Beside<SendGuess, SendCounts> both{3 * vertices_.count(), send, 1, {view(), control}};
      backend_.meet(both.count(), both, TakeCounts{view(), control});
    }
  }
  /// Shares the positions of a colour's own vertices with the parts that read them; with the last colour also what was
  /// counted. `padded`: as in StepState.
  void share_colour(const SweepView& sweep, const PaddedVec* padded, int colour) {
    if constexpr (may_divide) {
      if (hall_ == nullptr) return;
      const Range slots = this->slots(colour);
      const SendColour send{view(),      readers_.data(), sweep.vertices,
                            slots.begin, padded,          static_cast<int>(sweep.old + sweep.to_fresh - padded),
                            sweep.turn,  sweep.iteration};
      if (colour + 1 < static_cast<int>(slots_.size())) {
        backend_.meet(slots.count(), send, Nothing{});
      } else {
        const Beside<SendColour, SendCounts> both{slots.count(), send, 1, {view(), sweep.control}};
        backend_.meet(both.count(), both, TakeCounts{view(), sweep.control});
      }
    }
  }
  /// Shares all positions of the own vertices with all parts. The arguments are those of StepState.
  void share_positions(const Vec* position, const PaddedVec* padded, int vertex_count) {
    if constexpr (may_divide) {
      if (hall_ == nullptr) return;
      const int own = vertices_.count();
      backend_.meet(3 * own, SendPositions{view(), vertices_.begin, own, vertex_count, position, padded}, Nothing{});
    }
  }
  /// Takes over the forces that the other parts have measured (LeftForces).
  void share_forces(const SweepVertex* vertices, LeftForce* left, int slots) {
    if constexpr (may_divide) {
      if (hall_ == nullptr) return;
      meet();
      backend_.for_each(slots, TakeForces{view(), vertices, left});
    }
  }
  /// Takes over the contacts and the smallest distances that the other parts have found. Computes and shares `bounds`
  /// when the distances are complete.
  void share_contacts(const ListsView& lists, const ContactFaces& faces, const ConservativeBound& bounds) {
    if constexpr (may_divide) {
      if (hall_ == nullptr) return;
      const TakeDistances take{view(), faces.surface, vertices_.begin, vertices_.end, lists.overflow};
      backend_.for_each_counted(lists.contact_count, lists.capacity, ShowContacts{lists, found_.data()});
      backend_.meet(1, SendListCounts{view(), lists}, TakeListCounts{view(), lists, places_.data()});
      backend_.for_both(take.count(), take, places_.data() + count(), lists.capacity,
                        TakeContacts{view(), lists, faces, places_.data()});
      backend_.for_each(static_cast<int>(readers_.size()), ForgetReaders{of_elements_.data(), readers_.data()});
      const Beside<SendBound, SendListCounts> both{
          vertices_.count(), {view(), bounds, vertices_.begin}, 1, {view(), lists}};
      backend_.meet(both.count(), both, TakeOverflow{view(), lists});
    }
  }

 private:
  static constexpr bool may_divide = requires(Backend & backend) { backend.meetings(); };

  PartsView view() { return {own_, count(), arrays_.data(), begin_.data(), backend_.meetings()}; }

  Backend& backend_;
  std::shared_ptr<Hall> hall_;
  int own_;
  Range vertices_;
  std::vector<Range> slots_;  ///< by colour: the own ones
  typename Backend::template Buffer<PartArrays> arrays_;
  typename Backend::template Buffer<PartMessage> inbox_;
  typename Backend::template Buffer<std::uint64_t> of_elements_, readers_;
  typename Backend::template Buffer<RawContact> found_;
  typename Backend::template Buffer<int> begin_, places_;
};

}  // namespace ogc::fast

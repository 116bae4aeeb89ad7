// Launches the work by which a part of a simulation (fast/kernels/parts.hpp) and the other parts keep the same state.
// Without other parts it does nothing.
#pragma once

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fast/kernels/bound.hpp"
#include "fast/kernels/parts.hpp"
#include "fast/stages/beside.hpp"
#include "fast/stages/colouring.hpp"
#include "fast/stages/hall.hpp"

namespace ogc::fast {

/// Items begin … end − 1.
struct Range {
  int begin = 0, end = 0;
  int count() const { return end - begin; }
};

/// Returns the first vertex of each part, and behind them the number of vertices. The parts have about as many free
/// vertices each: cuts between parts cost nothing, since every position travels to all parts.
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

/// One part of a simulation.
template <class Backend>
class Parts {
 public:
  /// `hall`: where this part meets the others; null: there are no others. `own`: number of this part.
  Parts(Backend& backend, std::shared_ptr<Hall> hall, int own, const Colouring& colouring)
      : backend_(backend), hall_(std::move(hall)), own_(own), slots_in_all_(static_cast<int>(colouring.order.size())) {
    const int count = hall_ == nullptr ? 1 : hall_->parts();
    const std::vector<int> begins = part_begins(colouring, count);
    vertices_ = {begins[static_cast<std::size_t>(own)], begins[static_cast<std::size_t>(own) + 1]};
    for (int c = 0; c < colouring.count; ++c) {
      const auto order = colouring.order.begin(), first = order + colouring.begin[static_cast<std::size_t>(c)],
                 last = order + colouring.begin[static_cast<std::size_t>(c) + 1];
      colours_.push_back(
          {colouring.begin[static_cast<std::size_t>(c)], colouring.begin[static_cast<std::size_t>(c) + 1]});
      slots_.push_back({static_cast<int>(std::lower_bound(first, last, vertices_.begin) - order),
                        static_cast<int>(std::lower_bound(first, last, vertices_.end) - order)});
    }
    if (hall_ == nullptr) return;
    begin_.upload(begins.data(), begins.size());
    const auto parts = static_cast<std::size_t>(count);
    arrays_.resize(parts);
    inbox_.resize(2 * parts);
    mail_.resize(2 * colouring.order.size());
    places_.resize(parts + 1);
    if constexpr (may_divide)
      backend_.join(*hall_, own);
    else
      throw std::invalid_argument("this backend has no parts");
  }

  bool is_one_of_several() const { return hall_ != nullptr; }
  int count() const { return hall_ == nullptr ? 1 : hall_->parts(); }
  int own() const { return own_; }
  Range vertices() const { return vertices_; }  ///< own vertices
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
    arrays.inbox = inbox_.data(), arrays.mail = mail_.data(), arrays.found = found_.data();
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
      const Beside<SendGuess, SendCounts> both{vertices_.count(), send, 1, {view(), control}};
      backend_.meet(both.count(), both, TakeCounts{view(), control});
    }
  }
  /// Shares the positions of a colour's own vertices; with the last colour also what was counted.
  void share_colour(const SweepView& sweep, int colour) {
    if constexpr (may_divide) {
      if (hall_ == nullptr) return;
      const Range slots = this->slots(colour);
      PaddedVec* fresh = sweep.old + sweep.to_fresh;
      const SendColour send{view(), sweep.vertices, slots.begin, fresh, sweep.turn, sweep.iteration};
      if (colour + 1 < static_cast<int>(slots_.size())) {
        backend_.meet(slots.count(), send, Nothing{});
      } else {
        const Beside<SendColour, SendCounts> both{slots.count(), send, 1, {view(), sweep.control}};
        backend_.meet(both.count(), both, TakeCounts{view(), sweep.control});
      }
      const Range whole = colours_[static_cast<std::size_t>(colour)];
      backend_.for_each(whole.count() - slots.count(),
                        TakeColour{send, whole.begin, slots.count(), fresh, sweep.position});
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
  /// Takes over the contacts and the smallest distances that the other parts have found. Computes `bounds`, once for
  /// each vertex, when the distances are complete. `take.parts` is set here.
  void share_contacts(const ListsView& lists, const ContactFaces& faces, TakeDistances take,
                      const ConservativeBound& bounds) {
    if constexpr (may_divide) {
      if (hall_ == nullptr) return;
      take.parts = view();
      backend_.for_each_counted(lists.contact_count, lists.capacity, ShowContacts{lists, found_.data()});
      backend_.meet(1, SendListCounts{view(), lists}, TakeListCounts{view(), lists, places_.data()});
      backend_.for_both(take.count(), take, places_.data() + count(), lists.capacity,
                        TakeContacts{view(), lists, faces, places_.data()});
      const Beside<ConservativeBound, SendListCounts> both{take.vertex_count, bounds, 1, {view(), lists}};
      backend_.meet(both.count(), both, TakeOverflow{view(), lists});
    }
  }

 private:
  static constexpr bool may_divide = requires(Backend & backend) { backend.meetings(); };

  PartsView view() { return {own_, count(), arrays_.data(), begin_.data(), backend_.meetings(), slots_in_all_}; }

  Backend& backend_;
  std::shared_ptr<Hall> hall_;
  int own_, slots_in_all_;
  Range vertices_;
  std::vector<Range> colours_, slots_;  ///< by colour: all its slots, and the own ones
  typename Backend::template Buffer<PartArrays> arrays_;
  typename Backend::template Buffer<PartMessage> inbox_;
  typename Backend::template Buffer<PaddedVec> mail_;
  typename Backend::template Buffer<RawContact> found_;
  typename Backend::template Buffer<int> begin_, places_;
};

}  // namespace ogc::fast

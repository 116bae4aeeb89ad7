// Memory and launches of the guess by certificate of pairs (fast/kernels/pair_guess.hpp). Where nobody asked for it
// there is none of it. Nothing is nested in anything that asks a flag, so that a device can record it.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/settings.hpp"
#include "fast/kernels/pair_guess.hpp"
#include "fast/stages/detection.hpp"

namespace ogc::fast {

/// The guess of one surface.
template <class Backend>
class PairGuess {
 public:
  /// `is_fixed`: by vertex, whether it never moves.
  PairGuess(const compare::Settings& settings, const std::vector<std::uint8_t>& is_fixed)
      : is_used_(settings.guess == compare::Guess::pairs),
        contact_radius_(static_cast<float>(settings.contact_radius)),
        largest_reach_(static_cast<float>(settings.query_radius_cap * settings.contact_radius)) {
    if (!is_used_) return;
    is_fixed_.upload(is_fixed.data(), is_fixed.size());
    way_.resize(is_fixed.size());
    for (Buffer<float>* by_vertex : {&share_, &next_}) by_vertex->resize(is_fixed.size());
    unsafe_.resize(is_fixed.size());
    state_.resize(1);
  }

  /// Whether steps guess by pairs.
  bool is_used() const { return is_used_; }
  /// On the backend.
  PairGuessState* state() { return state_.data(); }

  /// Host only: room for so many noted pairs.
  void reserve(int noted_capacity) {
    if (is_used_) planes_.resize(static_cast<std::size_t>(noted_capacity));
  }

  /// What kernels share: X is where `detection` was, x and y are on the backend.
  PairGuessView view(Detection<Backend>& detection, const FeasibleRegions& regions, float bound_relaxation,
                     const Vec* target, Vec* position, StepControl* control) {
    const ListsView noted = detection.lists();
    return {.lists = {.surface = detection.surface(),
                      .positions = detection.positions(),
                      .is_fixed = is_fixed_.data(),
                      .share = bound_relaxation,
                      .query_radius = &state_.data()->reach,
                      .noted = noted.noted},
            .planes = planes_.data(),
            .regions = regions,
            .target = target,
            .way = way_.data(),
            .position = position,
            .share = share_.data(),
            .next = next_.data(),
            .unsafe = unsafe_.data(),
            .contact_radius = contact_radius_,
            .largest_reach = largest_reach_,
            .state = state_.data(),
            .control = control};
  }

  /// Whole moves, and the list of pairs that they could bring together.
  void begin(Backend& backend, Detection<Backend>& detection, float contact_radius, const PairGuessView& view) {
    const int vertices = view.lists.surface.vertex_count;
    backend.for_each(vertices, SpanMoves{view});
    backend.for_each(1, ChooseReach{view});
    backend.for_each(vertices, BeginMoves{view});
    detection.note_guess_pairs(contact_radius, &view.state->reach, {view.way, view.lists.positions, view.allowed()});
    const ListsView lists = detection.lists();
    backend.for_each(1, EndPairSearch{view.control, lists});
    backend.for_each_counted(lists.noted_count, lists.noted_capacity, ForgetPairs{view.planes});
  }

  /// One pass over all pairs.
  void pass(Backend& backend, Detection<Backend>& detection, const PairGuessView& view) {
    const ListsView lists = detection.lists();
    backend.for_each_counted(lists.noted_count, lists.noted_capacity, CheckPair{view});
    backend.for_each(view.lists.surface.vertex_count, ScaleMove{view});
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  bool is_used_;
  float contact_radius_, largest_reach_;
  Buffer<std::uint8_t> is_fixed_;
  Buffer<Vec> way_;
  Buffer<float> share_, next_;
  Buffer<int> unsafe_;
  Buffer<PairPlane> planes_;
  Buffer<PairGuessState> state_;
};

}  // namespace ogc::fast

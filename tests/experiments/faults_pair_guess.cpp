// Faults of the guess by certificate of pairs: a guess of its own with one mistake, within the right step.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reference/geometry/pair_planes.hpp"
#include "reference/geometry/truncate.hpp"
#include "reference/solvers/guess/pair_guess.hpp"
#include "reference/solvers/step.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

/// What a guess may get wrong; as it stands, nothing.
struct Mistakes {
  double reach = 1;               ///< share of R within which pairs are listed
  double sign = 1;                ///< of the approach along n
  bool sees_fixed = true;         ///< pairs with a fixed vertex count
  bool checks_neighbours = true;  ///< a pass looks at pairs that were safe in the pass before
  bool goes_on = true;            ///< vertices are cut until no pair is unsafe, not once
  int passes = 100;               ///< that scale
};

/// The guess of these mistakes: pairs are safe by their gap along n, or where their vertices are in their balls.
class OwnGuess {
 public:
  OwnGuess(const PairGuessIn& in, const Mistakes& mistakes) : in_(in), mistakes_(mistakes), x_(in.target) {
    std::array<double, 6> box{};
    std::vector<std::uint8_t> fixed;
    for (std::size_t v = 0; v < x_.size(); ++v) {
      fixed.push_back(in.exclusions.groups[v] == 0 ? 1 : 0);
      const std::array<double, 3> w = move(v);
      for (std::size_t k = 0; k < 3; ++k)
        box[2 * k] = std::min(box[2 * k], w[k]), box[2 * k + 1] = std::max(box[2 * k + 1], w[k]);
    }
    const double span = std::hypot(box[1] - box[0], box[3] - box[2], box[5] - box[4]), most = double{in.largest_reach};
    if (span > 2 * double{in.bound_relaxation} * most)
      for (std::size_t v = 0; v < x_.size(); ++v) x_[v] = cut(v, static_cast<float>(0.99 * in.bound_relaxation * most));
    pairs_ = reference::near_pairs_with_planes({in.topology, in.exclusions, in.previous, fixed,
                                                static_cast<float>(mistakes.reach * 1.01 * most), in.bound_relaxation});
    if (!mistakes.sees_fixed)
      std::erase_if(pairs_, [&](const reference::NearPair& pair) {
        return std::ranges::any_of(pair.vertices, [&](Index v) { return fixed[at(v)] != 0; });
      });
  }

  PairGuessOut run() {
    std::vector<bool> unsafe(pairs_.size(), true);
    for (int pass = 0; pass < mistakes_.passes; ++pass) {
      std::vector<double> share(x_.size(), 1);
      bool any = false;
      for (std::size_t i = 0; i < pairs_.size(); ++i) {
        const double safe = unsafe[i] || mistakes_.checks_neighbours ? safe_share(pairs_[i]) : 1;
        unsafe[i] = safe < 1;
        if (!unsafe[i]) continue;
        any = true;
        for (const Index v : pairs_[i].vertices) share[at(v)] = std::min(share[at(v)], 0.95 * safe);
      }
      if (!any) return {x_};
      for (std::size_t v = 0; v < x_.size(); ++v) scale(v, share[v]);
    }
    bool any = true;
    while (any) {
      std::vector<bool> cuts(x_.size(), false);
      for (const reference::NearPair& pair : pairs_)
        if (safe_share(pair) < 1)
          for (const Index v : pair.vertices) cuts[at(v)] = true;
      any = false;
      for (std::size_t v = 0; v < x_.size(); ++v)
        if (cuts[v]) x_[v] = cut(v, in_.bound[v]), any = mistakes_.goes_on;
    }
    return {x_};
  }

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  std::array<double, 3> move(std::size_t v) const {
    const Vec3f &x = x_[v], &p = in_.previous[v];
    return {double{x.x} - p.x, double{x.y} - p.y, double{x.z} - p.z};
  }
  Vec3f cut(std::size_t v, float radius) const {
    const TruncateTruth truth = reference::truncate({{in_.previous[v]}, {x_[v]}, {radius}});
    return truth.cut[0] == 0 ? x_[v] : reference::stored_within(truth.position[0], in_.previous[v], radius);
  }
  void scale(std::size_t v, double share) {
    if (share == 1) return;
    const std::array<double, 3> w = move(v);
    const Vec3f& p = in_.previous[v];
    x_[v] = {static_cast<float>(p.x + share * w[0]), static_cast<float>(p.y + share * w[1]),
             static_cast<float>(p.z + share * w[2])};
  }
  double gap(const reference::NearPair& pair, const std::vector<Vec3f>& x) const {
    double top = -std::numeric_limits<double>::infinity(), bottom = -top;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3f &n = pair.normal, &p = x[at(pair.vertices[k])];
      const double height = double{n.x} * p.x + double{n.y} * p.y + double{n.z} * p.z;
      k < pair.second_from ? top = std::max(top, height) : bottom = std::min(bottom, height);
    }
    return bottom - top;
  }
  double safe_share(const reference::NearPair& pair) const {
    const auto is_inside = [&](Index v) { return !reference::leaves_ball(in_, x_[at(v)], at(v)); };
    if (std::ranges::all_of(pair.vertices, is_inside)) return 1;
    const double before = gap(pair, in_.previous), shrunk = mistakes_.sign * (before - gap(pair, x_)),
                 room = 1.99 * double{in_.bound_relaxation} * before;
    if (!pair.has_plane || !(room > 0)) return 0;
    return shrunk <= room ? 1 : room / shrunk;
  }

  const PairGuessIn& in_;
  Mistakes mistakes_;
  std::vector<Vec3f> x_;
  std::vector<reference::NearPair> pairs_;
};

using Guesser = std::function<PairGuessOut(const PairGuessIn&)>;

Fault guessed(const std::string& name, const Guesser& guess) {
  return {"step: guess=pairs, " + name, Stage::step, [guess](Contestant& contestant, const Authority&) {
            contestant.step = [guess](const StepIn& in) { return reference::reference_step(in, guess); };
          }};
}

Fault mistaken(const std::string& name, const Mistakes& mistakes) {
  return guessed(name, [mistakes](const PairGuessIn& in) { return OwnGuess(in, mistakes).run(); });
}

/// All vertices to their balls, as one round has it.
PairGuessOut one_round(const PairGuessIn& in) {
  PairGuessOut out{in.target};
  for (std::size_t v = 0; v < out.position.size(); ++v) {
    const TruncateTruth truth = reference::truncate({{in.previous[v]}, {in.target[v]}, {in.bound[v]}});
    if (truth.cut[0] != 0) out.position[v] = reference::stored_within(truth.position[0], in.previous[v], in.bound[v]);
  }
  return out;
}

/// The contacts and bounds of X stay where the guess has left them.
void drop_second_detection(StepOut& out) {
  if (out.events.size() > 2 && out.events[2].kind == StepEventKind::detection) out.events.erase(out.events.begin() + 2);
}

}  // namespace

PairGuessOut own_pair_guess(const PairGuessIn& in) { return OwnGuess(in, {}).run(); }

std::vector<Fault> pair_guess_faults() {
  return {mistaken("pairs beyond a fifth of R forgotten", {.reach = 0.2}),
          mistaken("neighbours of scaled pairs not looked at again", {.checks_neighbours = false}),
          mistaken("groups not joined: vertices cut once", {.goes_on = false, .passes = 0}),
          mistaken("approach with the wrong sign", {.sign = -1}),
          mistaken("pairs with a fixed vertex left out", {.sees_fixed = false}),
          guessed("no pair looked at", [](const PairGuessIn& in) { return PairGuessOut{in.target}; }),
          guessed("pieces that nothing stops held back", one_round),
          {"step: guess=pairs, no detection where the guess led", Stage::step,
           [](Contestant& contestant, const Authority&) {
             contestant.step = [right = contestant.step](const StepIn& in) {
               StepOut out = right(in);
               if (in.scene->settings.guess == compare::Guess::pairs) drop_second_detection(out);
               return out;
             };
           }}};
}

}  // namespace ogc::tests

// Lets the judge test the initial guess with the kernels of the guess loop, one vertex for each case. Acceleration and
// time step are constants of these kernels, so each case gets its own kernels. Each case also gets its own control,
// which counts cut vertices. Vertices have no contacts: the stage `step` tests how contacts shorten a move.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/stages/initial_guess.hpp"
#include "fast/kernels/initial_guess.hpp"
#include "fast/kernels/rods/turn.hpp"
#include "fast/probes/probe_memory.hpp"
#include "fast/stages/kinds/segment.hpp"

namespace ogc::fast {

/// Runs both kernels of a round, one vertex for each case.
struct ProbeGuess {
  BeginVertex begin;        ///< with arrays by case
  GuessVertex guess;        ///< without contacts
  const Vec* acceleration;  ///< by case [m/s²]
  const float* step;        ///< by case: h [s]
  StepControl* control;     ///< by case
  std::uint8_t* cut;        ///< by case: 1 if the guess was truncated, written

  OGC_HD void operator()(int i) const {
    BeginVertex own_begin = begin;
    own_begin.acceleration = acceleration[i];
    own_begin.step = step[i];
    own_begin.control = control + i;
    own_begin(i);
    guess.position[i] = guess.regions.centre[i];
    GuessVertex own_guess = guess;
    own_guess.control = control + i;
    own_guess(i);
    cut[i] = static_cast<std::uint8_t>(control[i].cut);
  }
};

/// Returns one member of all cases.
template <class T>
std::vector<T> column(const compare::InitialGuessIn& in, T compare::InitialGuessCase::*member) {
  std::vector<T> all;
  for (const compare::InitialGuessCase& c : in.cases) all.push_back(c.*member);
  return all;
}

/// Rotates the orientation of a segment as its vector rotates from `before` to `now`. Runs once for each case.
struct ProbeTurn {
  const Vec *before, *now;  ///< by case [m]
  const Quat* orientation;  ///< by case
  Quat* out;                ///< by case, written

  OGC_HD void operator()(int i) const { out[i] = turned_along(before[i], now[i], orientation[i]); }
};

template <class Backend>
std::vector<compare::Quaternion> probe_turns(Backend& backend, const std::vector<compare::TurnCase>& turns) {
  ProbeMemory<Backend> memory(backend);
  std::vector<compare::Vec3f> before, now;
  std::vector<Quat> orientation, found;
  for (const compare::TurnCase& c : turns) {
    before.push_back(c.before), now.push_back(c.now);
    orientation.push_back(quat(c.orientation));
  }
  backend.for_each(static_cast<int>(turns.size()),
                   ProbeTurn{memory.template in<Vec>(before), memory.template in<Vec>(now),
                             memory.template in<Quat>(orientation), memory.template out<Quat>(found, turns.size())});
  memory.fetch();
  return quaternions(found);
}

/// Answers the stage `initial_guess`.
template <class Backend>
compare::InitialGuessOut probe_initial_guess(Backend& backend, const compare::InitialGuessIn& in) {
  using Case = compare::InitialGuessCase;
  ProbeMemory<Backend> memory(backend);
  compare::InitialGuessOut out;
  const std::size_t n = in.cases.size();
  std::vector<StepControl> controls(n);
  for (StepControl& control : controls) control.active = 1;
  typename Backend::template Buffer<StepControl> control;
  control.upload(controls.data(), n);
  Vec *target = memory.template out<Vec>(out.target, n), *position = memory.template out<Vec>(out.position, n);
  typename Backend::template Buffer<Vec> room;
  room.resize(2 * n);
  Vec* taken = room.data();
  const BeginVertex begin{.start = memory.template in<Vec>(column(in, &Case::start)),
                          .velocity = memory.template in<Vec>(column(in, &Case::velocity)),
                          .prescribed_number = memory.template in<int>(std::vector<int>(n, -1)),
                          .prescribed_targets = nullptr,
                          .prescribed_count = 0,
                          .acceleration = {},
                          .step = 0,
                          .position = position,
                          .target = target,
                          .taken = taken,
                          .control = nullptr};
  const GuessVertex guess{
      target,
      {memory.template in<Vec>(column(in, &Case::previous)), memory.template in<float>(column(in, &Case::bound))},
      {},
      static_cast<int>(n),
      taken,
      position,
      nullptr,
      memory.template in<int>(std::vector<int>(n, -1))};
  backend.for_each(static_cast<int>(n),
                   ProbeGuess{.begin = begin,
                              .guess = guess,
                              .acceleration = memory.template in<Vec>(column(in, &Case::acceleration)),
                              .step = memory.template in<float>(column(in, &Case::time_step)),
                              .control = control.data(),
                              .cut = memory.template out<std::uint8_t>(out.cut, n)});
  memory.fetch();
  out.orientation = probe_turns(backend, in.turns);
  return out;
}

}  // namespace ogc::fast

// The judge's way in to the initial guess: the kernels of the guess loop, one vertex a case. Acceleration and step are
// those of a scene, so each case gets kernels of its own, and a control of its own to count its cut; what is held is
// marked, in a round that holds contacts.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/stages/initial_guess.hpp"
#include "fast/kernels/initial_guess.hpp"
#include "fast/probes/probe_memory.hpp"

namespace ogc::fast {

/// Both kernels of a round, one vertex a case.
struct ProbeGuess {
  BeginVertex begin;        ///< with arrays by case
  GuessVertex guess;        ///< in its second round, where contacts are held
  const Vec* acceleration;  ///< by case [m/s²]
  const float* step;        ///< by case: h [s]
  StepControl* control;     ///< by case
  std::uint8_t* cut;        ///< by case: 1 where the guess was truncated, written

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

/// One member of all cases.
template <class T>
std::vector<T> column(const compare::InitialGuessIn& in, T compare::InitialGuessCase::*member) {
  std::vector<T> all;
  for (const compare::InitialGuessCase& c : in.cases) all.push_back(c.*member);
  return all;
}

/// The stage `initial_guess`.
template <class Backend>
compare::InitialGuessOut probe_initial_guess(Backend& backend, const compare::InitialGuessIn& in) {
  using Case = compare::InitialGuessCase;
  ProbeMemory<Backend> memory(backend);
  compare::InitialGuessOut out;
  const std::size_t n = in.cases.size();
  std::vector<int> touched;
  for (const Case& c : in.cases) touched.push_back(c.held);
  std::vector<StepControl> controls(n);
  for (StepControl& control : controls) control.active = control.rounds = 1;
  typename Backend::template Buffer<StepControl> control;
  control.upload(controls.data(), n);
  Vec *target = memory.template out<Vec>(out.target, n), *position = memory.template out<Vec>(out.position, n);
  const BeginVertex begin{.start = memory.template in<Vec>(column(in, &Case::start)),
                          .velocity = memory.template in<Vec>(column(in, &Case::velocity)),
                          .prescribed_number = memory.template in<int>(std::vector<int>(n, -1)),
                          .prescribed_targets = nullptr,
                          .prescribed_count = 0,
                          .acceleration = {},
                          .step = 0,
                          .position = position,
                          .target = target,
                          .control = nullptr};
  const GuessVertex guess{
      target,
      {memory.template in<Vec>(column(in, &Case::previous)), memory.template in<float>(column(in, &Case::bound))},
      memory.template in<int>(touched),
      position,
      nullptr};
  backend.for_each(static_cast<int>(n),
                   ProbeGuess{.begin = begin,
                              .guess = guess,
                              .acceleration = memory.template in<Vec>(column(in, &Case::acceleration)),
                              .step = memory.template in<float>(column(in, &Case::time_step)),
                              .control = control.data(),
                              .cut = memory.template out<std::uint8_t>(out.cut, n)});
  memory.fetch();
  return out;
}

}  // namespace ogc::fast

// Declares wrong contestants that the judge must catch: each changes the exact answer in one way. Most follow from the
// wrong forms of a stage (compare/judge/report/wrong_forms.hpp). Others are written by hand because no form can express
// them: an error in the last bit or of 0.1 %, one wrong item of a list, a wrong order of a step's events, a wrong step.
// The exact contestant must pass, which checks the judge, its tolerances and its grey zone.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/judge/cases/stage.hpp"
#include "compare/judge/report/wrong_forms.hpp"

namespace ogc::tests {

/// Returns the contestant with the authority's exact answers, rounded to single precision where the contract allows.
compare::Contestant exact_contestant(const compare::Authority& authority);

/// Returns the contestant that makes the form's mistake. `form.wrong` must not be empty. Forms of Stage::step are not
/// allowed: they accept wrong guesses in a given answer, but compute no answer.
compare::Contestant contestant_of(const compare::WrongForm& form, const compare::Authority& authority);

/// Returns the wrong forms of a stage that `contestant_of` accepts.
std::vector<compare::WrongForm> answering_forms(compare::Stage stage);

struct Fault {
  std::string name;  ///< "bound: 1 % too large"
  compare::Stage stage;
  /// Changes the stage of a right contestant.
  std::function<void(compare::Contestant&, const compare::Authority&)> plant;
  std::string generator{};  ///< the only generator whose cases can show the fault; empty: any
};

/// Returns all faults that are written by hand.
std::vector<Fault> faults();

/// Return the faults of each file: faults_pairs.cpp, faults_sets.cpp, …
std::vector<Fault> pair_faults();
std::vector<Fault> set_faults();
std::vector<Fault> plane_faults();
std::vector<Fault> region_faults();
std::vector<Fault> scalar_faults();
std::vector<Fault> force_faults();
std::vector<Fault> rest_faults();
std::vector<Fault> step_faults();
std::vector<Fault> sweep_faults();
std::vector<Fault> volume_faults();
std::vector<Fault> rod_faults();
std::vector<Fault> ipc_faults();

/// Returns the stage that a fault's name begins with.
compare::Stage stage_of(const std::string& fault);

template <class Out, class In>
using Answering = std::function<Out(const In&)> compare::Contestant::*;

/// Returns a fault that answers a wrong question correctly: `change(in)` changes a copy of the question.
template <class Out, class In, class Change>
Fault asked_wrongly(const std::string& name, Answering<Out, In> stage, Change change) {
  return {name, stage_of(name), [stage, change](compare::Contestant& contestant, const compare::Authority&) {
            contestant.*stage = [right = contestant.*stage, change](const In& in) {
              In other = in;
              change(other);
              return right(other);
            };
          }};
}

/// Returns a fault that changes the right answer by `spoil(in, out)`.
template <class Out, class In, class Spoil>
Fault spoiled(const std::string& name, Answering<Out, In> stage, Spoil spoil) {
  return {name, stage_of(name), [stage, spoil](compare::Contestant& contestant, const compare::Authority&) {
            contestant.*stage = [right = contestant.*stage, spoil](const In& in) {
              Out out = right(in);
              spoil(in, out);
              return out;
            };
          }};
}

/// Returns a fault that answers wrong cases correctly: `change(case)` changes a copy of each case.
template <class Out, class In, class Change>
Fault cases_asked_wrongly(const std::string& name, Answering<Out, In> stage, Change change) {
  return asked_wrongly(name, stage, [change](In& in) {
    for (auto& c : in.cases) change(c);
  });
}

/// Returns a fault that changes force and block of every case by `spoil(case, force, block)`.
template <class In, class Spoil>
Fault forces_spoiled(const std::string& name, Answering<compare::ForceOut, In> stage, Spoil spoil) {
  return spoiled(name, stage, [spoil](const In& in, compare::ForceOut& out) {
    for (std::size_t i = 0; i < in.cases.size(); ++i) spoil(in.cases[i], out.force[i], out.block[i]);
  });
}

/// Returns a fault whose forces are too small by `share`.
template <class In>
Fault forces_short_of(float share, const std::string& name, Answering<compare::ForceOut, In> stage) {
  return forces_spoiled(name, stage, [share](const auto&, compare::Vec3f& force, std::array<float, 6>&) {
    force = {(1 - share) * force.x, (1 - share) * force.y, (1 - share) * force.z};
  });
}

}  // namespace ogc::tests

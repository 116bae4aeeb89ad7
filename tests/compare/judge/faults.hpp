// Planted faults: wrong contestants that the judge must catch. Each is the exact answer spoiled in one way, most of
// them as published codes have it. The exact contestant itself must pass: that checks the judge, its tolerances and its
// grey zone against themselves.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/judge/stage.hpp"
#include "compare/problem/contestant.hpp"

namespace ogc::tests {

/// Answers with the authority's exact answers, rounded to single precision where the contract allows.
compare::Contestant exact_contestant(const compare::Authority& authority);

struct Fault {
  std::string name;
  compare::Stage stage;
  /// Spoils the stage of a right contestant.
  std::function<void(compare::Contestant&, const compare::Authority&)> plant;
};

/// All of them, at least one a stage.
std::vector<Fault> faults();

/// By file: faults_pairs.cpp, faults_sets.cpp, faults_scalars.cpp, faults_contacts.cpp, faults_forces.cpp,
/// faults_rest.cpp, faults_step.cpp, faults_sweep.cpp.
std::vector<Fault> pair_faults();
std::vector<Fault> set_faults();
std::vector<Fault> scalar_faults();
std::vector<Fault> contact_faults();
std::vector<Fault> force_faults();
std::vector<Fault> rest_faults();
std::vector<Fault> step_faults();
std::vector<Fault> sweep_faults();

}  // namespace ogc::tests

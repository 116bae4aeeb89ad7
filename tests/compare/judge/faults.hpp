// Planted faults: wrong contestants that the judge must catch. Each is the exact answer spoiled in one way, most of
// them as published codes have it. The exact contestant itself must pass: that checks the judge, its tolerances and its
// grey zone against themselves.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/judge/cases/stage.hpp"

namespace ogc::tests {

/// Answers with the authority's exact answers, rounded to single precision where the contract allows.
compare::Contestant exact_contestant(const compare::Authority& authority);

struct Fault {
  std::string name;
  compare::Stage stage;
  /// Spoils the stage of a right contestant.
  std::function<void(compare::Contestant&, const compare::Authority&)> plant;
  std::string generator{};  ///< whose cases alone can show it; empty: those of all
};

/// All of them, at least one a stage.
std::vector<Fault> faults();

/// The exact force and block of each case, rounded.
compare::ForceOut rounded(const compare::ForceTruth& truth);

/// By file, faults_pairs.cpp, faults_sets.cpp, …: the faults of its stages, and their right answers, put into a
/// contestant.
std::vector<Fault> pair_faults();
void add_right_pairs(compare::Contestant& exact, const compare::Authority& authority);
std::vector<Fault> set_faults();
void add_right_sets(compare::Contestant& exact, const compare::Authority& authority);
std::vector<Fault> plane_faults();
void add_right_planes(compare::Contestant& exact, const compare::Authority& authority);
std::vector<Fault> region_faults();
std::vector<Fault> scalar_faults();
void add_right_scalars(compare::Contestant& exact, const compare::Authority& authority);
std::vector<Fault> contact_faults();
void add_right_contacts(compare::Contestant& exact, const compare::Authority& authority);
std::vector<Fault> force_faults();
void add_right_forces(compare::Contestant& exact, const compare::Authority& authority);
std::vector<Fault> rest_faults();
void add_right_rest(compare::Contestant& exact, const compare::Authority& authority);
std::vector<Fault> step_faults();
void add_right_step(compare::Contestant& exact, const compare::Authority& authority);
std::vector<Fault> sweep_faults();
void add_right_sweep(compare::Contestant& exact, const compare::Authority& authority);
std::vector<Fault> volume_faults();
void add_right_volumes(compare::Contestant& exact, const compare::Authority& authority);
std::vector<Fault> rod_faults();
void add_right_rods(compare::Contestant& exact, const compare::Authority& authority);
std::vector<Fault> ipc_faults();
void add_right_ipc(compare::Contestant& exact, const compare::Authority& authority);
std::vector<Fault> rod_step_faults();

}  // namespace ogc::tests

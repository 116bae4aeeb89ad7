// One case of each stage, as data: what a generator makes, a contestant answers, a file keeps.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "compare/judge/stage.hpp"
#include "compare/problem/scene.hpp"
#include "compare/stages/bending.hpp"
#include "compare/stages/block.hpp"
#include "compare/stages/friction_force.hpp"
#include "compare/stages/initial_guess.hpp"
#include "compare/stages/membrane.hpp"
#include "compare/stages/spring.hpp"

namespace ogc::compare {

/// A parameter set after the case is made (compare/judge/parameters.hpp).
struct Override {
  std::string name;
  float value = 0;
  friend bool operator==(const Override&, const Override&) = default;
};

/// Names a generated case. Printed: `stage=detect_edge_edge gen=few seed=7 index=1234`, then parameters that are not
/// the generator's own (` r=0.002`), and for real states ` states=RUN`.
struct CaseName {
  Stage stage = Stage::closest_face;
  std::string generator;
  std::uint64_t seed = 0, index = 0;
  std::string states;                 ///< run folder; empty unless the generator takes real states
  std::vector<Override> overrides{};  ///< in the stage's order
  friend bool operator==(const CaseName&, const CaseName&) = default;
};

/// The canonical line.
std::string print_problem(const CaseName& name);
/// Reads the line back; keys in any order, `states` last. Throws InputError that names the key or value that is wrong,
/// or the parameter that the stage lacks.
CaseName parse_problem(const std::string& line);

struct ClosestFaceCase {
  Vec3f point;
  std::array<Vec3f, 3> triangle;
};

struct ClosestPointsCase {
  std::array<Vec3f, 2> first, second;
};

/// A whole state for detection.
struct MeshCase {
  std::shared_ptr<const Topology> topology;
  std::vector<Index> rigid_groups;
  std::vector<Vec3f> positions;
  float contact_radius = 0, query_radius = 0;
  CompressedRows partners{};  ///< as in Exclusions
};

struct BoundCase {
  std::shared_ptr<const Topology> topology;
  std::vector<float> d_min_vertex, d_min_edge, d_min_triangle;
  float bound_relaxation = 0.45f;
};

/// A mesh and what is asked about it.
struct BlockCase {
  std::shared_ptr<const Topology> topology;
  std::vector<Vec3f> positions;
  std::vector<BlockQuestion> questions;
};

struct RestStateCase {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Topology> topology;
};

/// A scene that takes one step.
struct StepCase {
  std::shared_ptr<const Scene> scene;  ///< rounded
  std::shared_ptr<const Topology> topology;
};

/// Where a sweep finds a scene; contacts and bounds follow from X_prev (compare/judge/sweep_question.hpp).
struct SweepCase {
  std::shared_ptr<const Scene> scene;               ///< rounded
  std::vector<Index> colour;                        ///< as in SweepIn
  std::vector<Vec3f> old, start, target, previous;  ///< x (what is beyond the bound is brought back), xᵗ, y, X_prev [m]
  /// [m]; b_v is the smaller one of it and the bound of the detection
  std::vector<float> largest_bound;
  float query_radius = 0;  ///< r_q [m]
};

struct ActivationCase {
  float distance = 0, contact_radius = 0, stiffness = 0;
  ContactActivation activation = ContactActivation::ogc;
};

struct TruncateCase {
  Vec3f previous, position;
  float bound = 0;
};

using CaseData = std::variant<ClosestFaceCase, ClosestPointsCase, MeshCase, BoundCase, ActivationCase, TruncateCase,
                              MembraneCase, BendingCase, RestStateCase, BlockCase, InitialGuessCase, ContactForceCase,
                              FrictionForceCase, SpringCase, SweepCase, StepCase>;

struct TestCase {
  CaseName name;
  CaseData data;
};

}  // namespace ogc::compare

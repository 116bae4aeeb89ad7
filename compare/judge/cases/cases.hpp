// Holds one case of each stage as data, as generators make it and files keep it.
#pragma once

#include <any>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/judge/cases/stage.hpp"
#include "compare/problem/scene.hpp"
#include "compare/stages/barrier.hpp"
#include "compare/stages/bending.hpp"
#include "compare/stages/block.hpp"
#include "compare/stages/ccd.hpp"
#include "compare/stages/friction_force.hpp"
#include "compare/stages/initial_guess.hpp"
#include "compare/stages/membrane.hpp"
#include "compare/stages/orientation.hpp"
#include "compare/stages/rod.hpp"
#include "compare/stages/spring.hpp"
#include "compare/stages/tetrahedron.hpp"
#include "compare/stages/truncate.hpp"
#include "compare/stages/volume_depth.hpp"
#include "compare/stages/volume_force.hpp"

namespace ogc::compare {

/// A parameter whose value is set after the case is made (compare/judge/cases/parameters.hpp).
struct Override {
  std::string name;  ///< name in the stage's table
  float value = 0;   ///< value as given
  friend bool operator==(const Override&, const Override&) = default;
};

/// The name of a generated case, printed as `stage=detect_edge_edge gen=few seed=7 index=1234`. Parameters that differ
/// from the generator's follow (` r=0.002`); for real states, ` states=RUN` comes last.
struct CaseName {
  Stage stage = Stage::closest_face;  ///< stage under test
  std::string generator;              ///< a row of the stage's table, `states` or `mutated`
  std::uint64_t seed = 0, index = 0;  ///< key of the random numbers
  std::string states;                 ///< run folder; empty unless the generator takes real states
  std::vector<Override> overrides{};  ///< in the order of the stage's table
  friend bool operator==(const CaseName&, const CaseName&) = default;
};

/// Prints the name in its canonical form.
std::string print_problem(const CaseName& name);
/// Reads a printed name; keys may be in any order, but `states` comes last. Throws InputError that names the wrong key
/// or value, or the parameter that the stage lacks.
CaseName parse_problem(const std::string& line);

/// A vertex for the initial guess, and perhaps a segment whose frame is turned.
struct GuessCase {
  InitialGuessCase vertex;
  std::optional<TurnCase> turn{};
};

/// A point and a triangle [m].
struct ClosestFaceCase {
  Vec3f point;                    ///< may lie on the triangle
  std::array<Vec3f, 3> triangle;  ///< by corner
};

/// Two edges [m].
struct ClosestPointsCase {
  std::array<Vec3f, 2> first, second;  ///< two ends each
};

/// A whole state for the detections.
struct MeshCase {
  std::shared_ptr<const Topology> topology;    ///< of the mesh
  std::vector<Index> rigid_groups;             ///< by vertex, as in Exclusions
  std::vector<Vec3f> positions;                ///< by vertex [m]
  float contact_radius = 0, query_radius = 0;  ///< r ≤ r_q [m]
  CompressedRows partners{};                   ///< as in Exclusions
};

/// Smallest distances of a mesh's faces.
struct BoundCase {
  std::shared_ptr<const Topology> topology;                     ///< of the mesh
  std::vector<float> d_min_vertex, d_min_edge, d_min_triangle;  ///< by face [m]
  float bounds_relaxation = 0.45f;                              ///< γ_p, Eq. 21
};

/// A state for stage plane.
struct PlaneCase {
  std::shared_ptr<const Topology> topology;  ///< of the mesh
  /// By vertex, as in Exclusions. Vertices of group 0 never move; pairs inside one group are excluded.
  std::vector<Index> rigid_groups;
  std::vector<Vec3f> positions;        ///< by vertex [m]
  float query_radius = 0;              ///< r_q [m]
  float bounds_relaxation = 0.45f;     ///< γ_p
  CompressedRows partners{};           ///< as in Exclusions
  std::vector<std::uint8_t> is_fixed;  ///< by vertex: whether its group is 0
  std::vector<Vec3f> displacement{};   ///< by vertex [m], as in PlaneIn; may be empty
};

/// A volume and points. The question is the depth of each point in the volume.
struct VolumeDepthCase {
  std::shared_ptr<const Topology> topology;  ///< of the volume
  std::vector<Vec3f> positions;              ///< by vertex [m]
  float contact_radius = 0;                  ///< r [m]
  std::vector<Vec3f> points;                 ///< each counts as a case [m]
  std::vector<Tetrahedron> tetrahedra{};     ///< of the parts that have tetrahedra
  std::vector<Index> own{};                  ///< by point: its vertex, or −1; empty if no point is a vertex
  std::vector<Edge> cavities{};              ///< as in VolumeDepthIn
};

/// A mesh and questions about it.
struct BlockCase {
  std::shared_ptr<const Topology> topology;  ///< of the mesh
  std::vector<Vec3f> positions;              ///< by vertex [m]
  std::vector<BlockQuestion> questions;      ///< each counts as a case
};

/// A scene whose rest data are the question.
struct RestStateCase {
  std::shared_ptr<const Scene> scene;        ///< rounded
  std::shared_ptr<const Topology> topology;  ///< of the mesh
};

/// A scene that takes one step.
struct StepCase {
  std::shared_ptr<const Scene> scene;        ///< rounded
  std::shared_ptr<const Topology> topology;  ///< of the mesh
};

/// The state in which a sweep begins; contacts and bounds follow from X_prev (compare/judge/engine/sweep_question.hpp).
struct SweepCase {
  std::shared_ptr<const Scene> scene;               ///< rounded
  std::vector<Index> colour;                        ///< as in SweepIn
  std::vector<Vec3f> old, start, target, previous;  ///< x (before it is brought within the bound), xᵗ, y, X_prev [m]
  /// upper limit of b_v [m]; the detection's bound may be smaller
  std::vector<float> largest_bound;
  float query_radius = 0;                                      ///< r_q [m]
  std::vector<Index> segment_colour{};                         ///< as in SweepIn
  std::vector<Quaternion> orientation{}, orientation_start{};  ///< q, qᵗ of the segments
};

/// A distance, and the activation there.
struct ActivationCase {
  float distance = 0, contact_radius = 0, stiffness = 0;  ///< d [m], r [m], k_c [N/m]
  ContactActivation activation = ContactActivation::ogc;  ///< function of d
};

/// A vertex that moved.
struct TruncateCase {
  Vec3f previous, position;  ///< X_prev, x [m]
  float bound = 0;           ///< b_v [m]
  /// If empty, only the ball limits the vertex, and the members below are not read.
  std::vector<HalfSpace> half_spaces{};
  Vec3f current{};                 ///< a point of the feasible region [m]
  std::array<float, 6> block{};    ///< H [N/m]
  std::uint8_t is_prescribed = 0;  ///< 1 if the vertex does not slide along its region
};

/// The data of a case, of the stage's own type.
using CaseData = std::any;

/// Returns the case; throws std::bad_any_cast if the data are of another stage.
template <class Case>
const Case& case_of(const CaseData& data) {
  if (const auto* found = std::any_cast<Case>(&data)) return *found;
  throw std::bad_any_cast();
}
template <class Case>
Case& case_of(CaseData& data) {
  if (auto* found = std::any_cast<Case>(&data)) return *found;
  throw std::bad_any_cast();
}

/// A case and the name from which it can be made again.
struct TestCase {
  CaseName name;  ///< if the case was made smaller: name of the original case
  CaseData data;  ///< of the stage's own type
};

}  // namespace ogc::compare

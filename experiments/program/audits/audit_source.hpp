// Provides the states that `ogc audit` checks, whichever program computed them. States are read one after the other and
// judged in parallel.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/files/meshes/polygon_mesh.hpp"
#include "compare/oracle/audit.hpp"
#include "compare/oracle/smallest_distances.hpp"
#include "compare/oracle/volume_audit.hpp"
#include "compare/problem/element_names.hpp"
#include "compare/problem/mesh.hpp"
#include "compare/problem/scene.hpp"
#include "experiments/program/audits/rounding_doubt.hpp"

namespace ogc::experiments {

/// Holds one state and, once it is judged, what the audit found.
struct AuditedState {
  std::string name;                                     ///< "step 12", a file, or "frame 3"
  std::shared_ptr<const compare::Topology> topology;    ///< of its mesh
  std::vector<compare::Vec3> positions;                 ///< [m]
  compare::AuditResult result;                          ///< its intersections
  compare::SmallestDistances distances;                 ///< how near it is to an intersection
  compare::ElementNames names;                          ///< element names with the numbers of the mesh's file
  std::string text;                                     ///< the listed intersections in words, one line each
  std::optional<compare::VolumePenetration> volumes{};  ///< where the scene has volumes
  std::string in_volumes{};                             ///< describes `volumes` in words
  bool is_solid = false;                                ///< the mesh has tetrahedra
  std::filesystem::path file{};                         ///< the file of this state alone; empty if there is none
  std::optional<RoundingDoubt> doubt{};                 ///< what the digits of the file leave undecided
};

/// The states to audit, from a run or from files of other programs.
class AuditSource {
 public:
  virtual ~AuditSource() = default;
  /// Returns the number of states.
  virtual std::size_t size() const = 0;
  /// Returns the name of state i in messages.
  virtual std::string name(std::size_t i) const = 0;
  /// Reads the next state. Throws compare::InputError if it can't be read; then no further state can be read.
  virtual AuditedState next() = 0;
  /// Judges a state exactly. Several threads may judge different states while another one reads.
  virtual void judge(AuditedState& state) const = 0;
  /// Returns the scene of the states; null if they are meshes.
  virtual const compare::Scene* scene() const { return nullptr; }
  /// Returns in words what besides `ogc audit` proves the motion between the states; empty if nothing does.
  virtual std::string proof_of_ways() const { return ""; }
  /// Returns the pairs that the audit leaves out.
  virtual compare::ExclusionView exclusions() const { return {}; }
  /// Returns in words what is left out besides faces that share a vertex; empty if nothing is.
  virtual std::string left_out() const { return ""; }
};

/// Says what is audited and how.
struct AuditRequest {
  std::vector<std::string>
      paths;             ///< a run folder, a folder of meshes, meshes, patterns of them, or one .npz, .npy or .pc2
  std::string topology;  ///< mesh with the triangles of files that hold positions alone; may be empty
  compare::MeshOptions meshes;                        ///< how mesh files are read
  std::size_t limit = compare::AuditOptions{}.limit;  ///< intersections listed for each state
};

/// Opens what the paths name. Several meshes are taken in natural order. Throws compare::InputError that lists what can
/// be named.
std::unique_ptr<AuditSource> open_audit(const AuditRequest& request);

}  // namespace ogc::experiments

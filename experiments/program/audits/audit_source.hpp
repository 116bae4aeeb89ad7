// Provides the states that `ogc audit` checks, from any program. States are read one after the other and judged in
// parallel.
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

/// Holds one state and, after it was judged, the result of the audit.
struct AuditedState {
  std::string name;                                     ///< "step 12", a file, or "frame 3"
  std::shared_ptr<const compare::Topology> topology;    ///< topology of the state's mesh
  std::vector<compare::Vec3> positions;                 ///< [m]
  compare::AuditResult result;                          ///< intersections of the state
  compare::SmallestDistances distances;                 ///< smallest distances between primitives
  compare::ElementNames names;                          ///< element names with the numbers of the mesh's file
  std::string text;                                     ///< the listed intersections in words, one line each
  std::optional<compare::VolumePenetration> volumes{};  ///< empty if the scene has no volumes
  std::string in_volumes{};                             ///< describes `volumes` in words
  bool is_solid = false;                                ///< the mesh has tetrahedra
  std::filesystem::path file{};                         ///< the file of this state alone; empty if there is none
  std::optional<RoundingDoubt> doubt{};  ///< findings that the rounding of the file's numbers may have caused
};

/// Provides the states to audit, from a run or from files of other programs.
class AuditSource {
 public:
  virtual ~AuditSource() = default;
  /// Returns the number of states.
  virtual std::size_t size() const = 0;
  /// Returns the name of state i for messages.
  virtual std::string name(std::size_t i) const = 0;
  /// Reads the next state. Throws compare::InputError if the state can't be read; then no later state can be read.
  virtual AuditedState next() = 0;
  /// Judges a state exactly. Several threads may judge different states while another thread reads.
  virtual void judge(AuditedState& state) const = 0;
  /// Returns the scene of the states; null if they are meshes.
  virtual const compare::Scene* scene() const { return nullptr; }
  /// Describes what proves the motion between the states safe, if something other than `ogc audit` does; else empty.
  virtual std::string proof_of_ways() const { return ""; }
  /// Returns the pairs that the audit leaves out.
  virtual compare::ExclusionView exclusions() const { return {}; }
  /// Describes what the audit leaves out besides faces that share a vertex; empty if it leaves out nothing else.
  virtual std::string left_out() const { return ""; }
};

/// Selects what is audited and how.
struct AuditRequest {
  std::vector<std::string>
      paths;                    ///< run folder, folder of meshes, meshes, patterns of meshes, or one .npz, .npy or .pc2
  std::string topology;         ///< mesh with the triangles for files that hold positions alone; may be empty
  compare::MeshOptions meshes;  ///< options for reading mesh files
  std::size_t limit = compare::AuditOptions{}.limit;  ///< number of intersections listed for each state
};

/// Opens the paths. Several meshes are taken in natural order. Throws compare::InputError that lists the kinds of paths
/// that are accepted.
std::unique_ptr<AuditSource> open_audit(const AuditRequest& request);

}  // namespace ogc::experiments

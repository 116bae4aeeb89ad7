// What `ogc audit` looks at, whoever computed it: states are read one after the other, and judged side by side.
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

/// One state, and what was found of it once it is judged.
struct AuditedState {
  std::string name;                                     ///< "step 12", a file, or "frame 3"
  std::shared_ptr<const compare::Topology> topology;    ///< of its mesh
  std::vector<compare::Vec3> positions;                 ///< [m]
  compare::AuditResult result;                          ///< its intersections
  compare::SmallestDistances distances;                 ///< how near it is to touching
  compare::ElementNames names;                          ///< as the mesh's file counts
  std::string text;                                     ///< the listed intersections in words, one line each
  std::optional<compare::VolumePenetration> volumes{};  ///< where the scene has volumes
  std::string in_volumes{};                             ///< the same in words
  bool is_solid = false;                                ///< of a mesh of tetrahedra
  std::filesystem::path file{};                         ///< that it was read from, where it has one of its own
  std::optional<RoundingDoubt> doubt{};                 ///< what the file's digits leave open
};

/// States to audit, of a run or of files of other programs.
class AuditSource {
 public:
  virtual ~AuditSource() = default;
  /// Number of states.
  virtual std::size_t size() const = 0;
  /// What state i is called in messages.
  virtual std::string name(std::size_t i) const = 0;
  /// Reads the next state. Throws compare::InputError where it can't be read; no further state can be asked for then.
  virtual AuditedState next() = 0;
  /// Judges a state exactly. Several threads may do so, with different states, while another one reads.
  virtual void judge(AuditedState& state) const = 0;
  /// The scene whose states they are; null where they are meshes.
  virtual const compare::Scene* scene() const { return nullptr; }
  /// What proves the ways between its states, beside `ogc audit`, in words; empty where nothing.
  virtual std::string proof_of_ways() const { return ""; }
  /// Pairs that it leaves out.
  virtual compare::ExclusionView exclusions() const { return {}; }
  /// What is left out besides what touches by its topology, in words; empty where nothing.
  virtual std::string left_out() const { return ""; }
};

/// What is audited, and how.
struct AuditRequest {
  std::vector<std::string>
      paths;                    ///< a run folder, a folder of meshes, meshes, patterns of them, one .npz, .npy or .pc2
  std::string topology;         ///< mesh of the triangles, for files that hold positions alone; may be empty
  compare::MeshOptions meshes;  ///< what is taken of mesh files
  std::size_t limit = compare::AuditOptions{}.limit;  ///< intersections that are listed of a state
};

/// Opens what the paths name. Several meshes are taken in natural order. Throws compare::InputError that says what
/// could be named.
std::unique_ptr<AuditSource> open_audit(const AuditRequest& request);

}  // namespace ogc::experiments

// Judges the states of a run while the run continues. The oracle finds exact intersections. The certificate of each
// motion is checked against exact bounds or planes of the reference (method.md §5.5, §5.6). If the simulation runs on a
// device, the audit runs beside it on the CPU. If the simulation runs on the CPU, the two alternate, so that the audit
// does not disturb the measured times of steps.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/oracle/audit.hpp"
#include "compare/oracle/certificate.hpp"
#include "compare/oracle/smallest_distances.hpp"
#include "compare/oracle/volume_audit.hpp"
#include "compare/problem/element_names.hpp"
#include "compare/stages/plane.hpp"

namespace ogc::experiments {

/// Selects the states to audit: each step, each stored frame, the last state, none.
enum class AuditMode { every, frame, end, off };
/// Returns the mode's name as a value of --audit.
std::string name_of(AuditMode mode);
/// Returns the mode with this name. Throws compare::InputError if there is none.
AuditMode audit_mode(const std::string& name);

/// Describes the pairs that audits of the scene leave out; empty if there are none. Pairs inside fixed and rigidly
/// moved bodies are always left out and not described.
std::string left_out_of_audits(const compare::Scene& scene);

/// Holds the exact findings about one state.
struct Verdict {
  std::int64_t step = 0;  ///< number of the state
  compare::AuditResult intersections;
  compare::MotionCertificate motion;        ///< certificate of the motion since the last detection
  std::size_t unsafe_bounds = 0;            ///< number of vertices whose b_v exceeds the exact bound at X_prev
  compare::Index worst_vertex = -1;         ///< vertex with the largest ratio of b_v to its exact bound
  double worst_bound = 0, exact_bound = 0;  ///< b_v of worst_vertex, and its exact bound [m]
  compare::PlaneGuarantee planes;           ///< guarantee of planes; with planes it replaces the exact bounds
  std::size_t broken_planes = 0;            ///< number of half-spaces that the state violates
  compare::VolumePenetration volumes;       ///< vertices and edges inside volumes; not part of the guarantee
  /// Returns whether the state keeps the guarantee.
  bool kept() const {
    return intersections.count == 0 && motion.kept() && unsafe_bounds == 0 && planes.kept() && broken_planes == 0;
  }
};

/// Judges states of one scene.
class StateJudge {
 public:
  explicit StateJudge(const compare::Scene& scene, const compare::MeshSources& sources = {});
  /// Audits a state without the certificate, for example a start or a frame of a file. `limit`: see
  /// compare::AuditOptions.
  compare::AuditResult audit(const std::vector<compare::Vec3f>& positions,
                             std::size_t limit = compare::AuditOptions{}.limit) const;
  /// Returns the smallest distances between primitives, except pairs that the audit leaves out.
  compare::SmallestDistances smallest_distances(const std::vector<compare::Vec3f>& positions) const;
  /// Returns the vertices and edges inside volumes; empty if the scene has no volumes.
  compare::VolumePenetration penetration(const std::vector<compare::Vec3f>& positions) const;
  /// Returns whether the scene has volumes.
  bool has_volumes() const { return volumes_.has_volumes(); }
  /// Returns a sentence with the number of vertices inside volumes, the deepest one, and the number of edges that meet
  /// a surface.
  std::string describe(const compare::VolumePenetration& penetration) const;
  /// Judges a state, and the certificate of the motion from the last detection to this state.
  Verdict judge(const compare::Snapshot& snapshot) const;
  /// Returns one line for each violation, with the names of the primitives; empty if there is none.
  std::string describe(const Verdict& verdict) const;
  std::string describe(const compare::AuditResult& result) const;
  /// Returns the pairs that the audit leaves out.
  const compare::Exclusions& exclusions() const { return exclusions_; }
  /// Returns the names that the texts of `describe` use for the scene's elements.
  const compare::ElementNames& names() const { return names_; }

 private:
  void judge_balls(const compare::Snapshot& snapshot, Verdict& verdict) const;
  void judge_planes(const compare::Snapshot& snapshot, Verdict& verdict) const;
  std::string name_of(const compare::PrimitivePair& pair) const;
  compare::Topology topology_;
  compare::Exclusions exclusions_;
  compare::ElementNames names_;
  compare::VolumeAuditor volumes_;
  float contact_radius_, bounds_relaxation_;
  compare::Bounds bounds_;
  std::vector<std::uint8_t> is_fixed_;  ///< by vertex
};

/// Collects verdicts in the order in which states were submitted.
class Auditor {
 public:
  /// `beside`: judges on a separate thread. The judge must outlive the auditor.
  Auditor(const StateJudge& judge, bool beside);
  ~Auditor();
  Auditor(const Auditor&) = delete;
  Auditor& operator=(const Auditor&) = delete;
  /// Adds a state. Waits while too many states are queued, because states may be large.
  void submit(compare::Snapshot snapshot);
  /// Returns the verdicts that are ready. Throws what the judge threw.
  std::vector<Verdict> take();
  /// Waits until all submitted states are judged. Returns the remaining verdicts. Throws what the judge threw.
  std::vector<Verdict> finish();

 private:
  void work();
  void judge_one(const compare::Snapshot& snapshot);
  const StateJudge& judge_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<compare::Snapshot> waiting_;
  std::vector<Verdict> ready_;
  std::exception_ptr failure_;
  bool busy_ = false, stop_ = false;
  std::thread thread_;
};

}  // namespace ogc::experiments

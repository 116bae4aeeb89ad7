// Judges the states of a run while it goes on: exact intersections by the oracle, and the motion certificate against
// exact bounds or planes of the reference (method.md §5.5, §5.6). If the simulation runs on a device, the audit runs
// beside it on the CPU. If the simulation runs on the CPU, the two take turns, so that the audit does not take cores
// from a step whose time is measured.
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

/// Which states are audited: each step, each stored frame, the last state, none.
enum class AuditMode { every, frame, end, off };
/// Returns the name that --audit has for it.
std::string name_of(AuditMode mode);
/// Returns the mode of this name. Throws compare::InputError if there is none.
AuditMode audit_mode(const std::string& name);

/// Returns in words what the audits of a scene leave out beyond pairs inside fixed and rigidly moved bodies; empty if
/// nothing.
std::string left_out_of_audits(const compare::Scene& scene);

/// Holds what was found of one state, exactly.
struct Verdict {
  std::int64_t step = 0;                    ///< number of the state
  compare::AuditResult intersections;       ///< of the state
  compare::MotionCertificate motion;        ///< since the last detection
  std::size_t unsafe_bounds = 0;            ///< vertices whose b_v is above the exact bound of X_prev
  compare::Index worst_vertex = -1;         ///< vertex with the largest ratio of b_v to its exact bound
  double worst_bound = 0, exact_bound = 0;  ///< both of that vertex [m]
  compare::PlaneGuarantee planes;           ///< the guarantee of planes, which replaces the exact bounds
  std::size_t broken_planes = 0;            ///< half-spaces that the state violates
  compare::VolumePenetration volumes;       ///< what is inside volumes; not part of the guarantee
  /// Returns whether the state keeps the guarantee.
  bool kept() const {
    return intersections.count == 0 && motion.kept() && unsafe_bounds == 0 && planes.kept() && broken_planes == 0;
  }
};

/// Judges states of one scene.
class StateJudge {
 public:
  explicit StateJudge(const compare::Scene& scene, const compare::MeshSources& sources = {});
  /// Audits a state without the certificate, such as a start or a frame of a file. `limit`: see compare::AuditOptions.
  compare::AuditResult audit(const std::vector<compare::Vec3f>& positions,
                             std::size_t limit = compare::AuditOptions{}.limit) const;
  /// Returns the smallest distances between primitives, without the pairs that the audit leaves out.
  compare::SmallestDistances smallest_distances(const std::vector<compare::Vec3f>& positions) const;
  /// Returns what is inside volumes; nothing if the scene has none.
  compare::VolumePenetration penetration(const std::vector<compare::Vec3f>& positions) const;
  /// Returns whether the scene has volumes.
  bool has_volumes() const { return volumes_.has_volumes(); }
  /// Returns in words how many vertices are inside volumes, the deepest one, and how many edges meet a surface.
  std::string describe(const compare::VolumePenetration& penetration) const;
  /// Judges a state together with the certificate since its last detection.
  Verdict judge(const compare::Snapshot& snapshot) const;
  /// Returns one line for each violation, which names the primitives; empty if there is none.
  std::string describe(const Verdict& verdict) const;
  std::string describe(const compare::AuditResult& result) const;
  /// Returns the pairs that the audit leaves out.
  const compare::Exclusions& exclusions() const { return exclusions_; }
  /// Returns the names of the scene's elements that all of these texts use.
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

/// Collects verdicts in the order of submission.
class Auditor {
 public:
  /// `beside`: judges on a thread of its own. The judge must outlive the auditor.
  Auditor(const StateJudge& judge, bool beside);
  ~Auditor();
  Auditor(const Auditor&) = delete;
  Auditor& operator=(const Auditor&) = delete;
  /// Adds a state; waits while too many states are queued, because a state may be large.
  void submit(compare::Snapshot snapshot);
  /// Returns the verdicts that are ready. Throws what the judge threw.
  std::vector<Verdict> take();
  /// Waits until all submitted states are judged; returns and throws like `take`.
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

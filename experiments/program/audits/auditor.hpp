// Judges the states of a run while it goes on: exact intersections by the oracle, and the motion certificate against
// exact bounds or planes of the reference (method.md §5.5, §5.6). On a device that computes elsewhere it works beside
// the simulation; on the CPU it takes turns with it, so that it does not steal the cores whose time a step is measured
// by.
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

/// What is audited: each step, each stored frame, the last state, nothing.
enum class AuditMode { every, frame, end, off };
/// As of --audit.
std::string name_of(AuditMode mode);
/// Throws compare::InputError where nothing is called so.
AuditMode audit_mode(const std::string& name);

/// What audits of a scene leave out beyond pairs inside fixed and rigidly moved bodies, in words; empty where nothing.
std::string left_out_of_audits(const compare::Scene& scene);

/// What is exactly true of one state.
struct Verdict {
  std::int64_t step = 0;                    ///< which state
  compare::AuditResult intersections;       ///< of the state
  compare::MotionCertificate motion;        ///< since the last detection
  std::size_t unsafe_bounds = 0;            ///< vertices whose b_v is above the exact bound of X_prev
  compare::Index worst_vertex = -1;         ///< of the largest b_v / exact bound among them
  double worst_bound = 0, exact_bound = 0;  ///< [m], of that vertex
  compare::PlaneGuarantee planes;           ///< with planes, in place of the exact bounds
  std::size_t broken_planes = 0;            ///< half-spaces that the state does not keep
  compare::VolumePenetration volumes;       ///< what is inside of volumes, which is no part of the guarantee
  /// Whether the state keeps the guarantee.
  bool kept() const {
    return intersections.count == 0 && motion.kept() && unsafe_bounds == 0 && planes.kept() && broken_planes == 0;
  }
};

/// Judges states of one scene.
class StateJudge {
 public:
  explicit StateJudge(const compare::Scene& scene, const compare::MeshSources& sources = {});
  /// A state without the certificate: a start, a frame of a file. `limit`: as of compare::AuditOptions.
  compare::AuditResult audit(const std::vector<compare::Vec3f>& positions,
                             std::size_t limit = compare::AuditOptions{}.limit) const;
  /// How near it is to touching, without the pairs that the audit leaves out.
  compare::SmallestDistances smallest_distances(const std::vector<compare::Vec3f>& positions) const;
  /// What is inside of volumes; of a scene without them nothing is.
  compare::VolumePenetration penetration(const std::vector<compare::Vec3f>& positions) const;
  /// Whether the scene has any.
  bool has_volumes() const { return volumes_.has_volumes(); }
  /// In words: how many vertices are inside, which is the deepest, and how many edges meet.
  std::string describe(const compare::VolumePenetration& penetration) const;
  /// A state with the certificate of the last detection before it.
  Verdict judge(const compare::Snapshot& snapshot) const;
  /// Names what is wrong, one line a primitive; empty where nothing is.
  std::string describe(const Verdict& verdict) const;
  std::string describe(const compare::AuditResult& result) const;
  /// Pairs that it leaves out.
  const compare::Exclusions& exclusions() const { return exclusions_; }
  /// What elements of the scene are called in all of these.
  const compare::ElementNames& names() const { return names_; }

 private:
  void judge_balls(const compare::Snapshot& snapshot, Verdict& verdict) const;
  void judge_planes(const compare::Snapshot& snapshot, Verdict& verdict) const;
  std::string name_of(const compare::PrimitivePair& pair) const;
  compare::Topology topology_;
  compare::Exclusions exclusions_;
  compare::ElementNames names_;
  compare::VolumeAuditor volumes_;
  float contact_radius_, bound_relaxation_;
  compare::Bounds bounds_;
  std::vector<std::uint8_t> is_fixed_;  ///< by vertex
};

/// Verdicts in the order of submission.
class Auditor {
 public:
  /// `beside`: judge on a thread of its own. The judge must outlive the auditor.
  Auditor(const StateJudge& judge, bool beside);
  ~Auditor();
  Auditor(const Auditor&) = delete;
  Auditor& operator=(const Auditor&) = delete;
  /// Waits where too many states are waiting already: a state may be large.
  void submit(compare::Snapshot snapshot);
  /// Verdicts that are ready; throws what the judge threw.
  std::vector<Verdict> take();
  /// Waits for all that was submitted.
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

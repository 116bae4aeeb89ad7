#include "experiments/program/audits/auditor.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "experiments/program/output.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {

namespace {

/// Number of states that may wait while another state is judged. With this number the simulation rarely waits, and
/// memory holds only a few states.
constexpr std::size_t most_waiting = 2;

constexpr std::array<std::string_view, 4> audit_names{"every", "frame", "end", "off"};  // by AuditMode

}  // namespace

std::string name_of(AuditMode mode) { return std::string(audit_names[static_cast<std::size_t>(mode)]); }

AuditMode audit_mode(const std::string& name) {
  const auto found = std::ranges::find(audit_names, name);
  if (found == audit_names.end())
    throw compare::InputError("audit: " + compare::unknown_name("mode", name, audit_names));
  return static_cast<AuditMode>(found - audit_names.begin());
}

std::string left_out_of_audits(const compare::Scene& scene) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (!scene.excluded_pairs.empty())
    add("pairs beside " + counted(scene.excluded_pairs.size(), "excluded pair") + " of vertices");
  for (const compare::PrescribedMotion& motion : scene.motions)
    if (!motion.keyframes.empty()) add("pairs inside '" + motion.name + "', which moves by keyframes");
  return text;
}

StateJudge::StateJudge(const compare::Scene& scene, const compare::MeshSources& sources)
    : topology_(compare::build_topology(scene)),
      exclusions_(compare::exclusions(scene)),
      names_(scene, sources),
      volumes_(scene),
      contact_radius_(static_cast<float>(scene.settings.contact_radius)),
      bounds_relaxation_(static_cast<float>(scene.settings.bounds_relaxation)),
      bounds_(scene.settings.bounds),
      is_fixed_(compare::fixed_flags(exclusions_.groups)) {}

compare::AuditResult StateJudge::audit(const std::vector<compare::Vec3f>& positions, std::size_t limit) const {
  return compare::audit(topology_, compare::to_double(positions), exclusions_, {.limit = limit});
}

compare::SmallestDistances StateJudge::smallest_distances(const std::vector<compare::Vec3f>& positions) const {
  return compare::smallest_distances(topology_, compare::to_double(positions), exclusions_);
}

compare::VolumePenetration StateJudge::penetration(const std::vector<compare::Vec3f>& positions) const {
  return volumes_.audit(compare::to_double(positions));
}

std::string StateJudge::describe(const compare::VolumePenetration& penetration) const {
  std::string text = counted(penetration.vertices_inside, "vertex position") + " inside volumes";
  if (penetration.deepest_vertex >= 0)
    text += ", the deepest " + names_.vertex(penetration.deepest_vertex) + " by " + number(penetration.deepest) + " m";
  return text + "; " + counted(penetration.edges_meeting, "edge") + " through a surface of volume or garment";
}

Verdict StateJudge::judge(const compare::Snapshot& snapshot) const {
  Verdict verdict;
  verdict.step = snapshot.step;
  verdict.intersections = audit(snapshot.positions);
  verdict.volumes = penetration(snapshot.positions);
  const compare::BoundsTraits policy = traits_of(bounds_);
  if (!policy.certifies) return verdict;
  verdict.motion = compare::motion_certificate(snapshot.positions, snapshot.previous, snapshot.bounds);
  policy.has_planes ? judge_planes(snapshot, verdict) : judge_balls(snapshot, verdict);
  return verdict;
}

void StateJudge::judge_planes(const compare::Snapshot& snapshot, Verdict& verdict) const {
  const compare::PlaneIn in{&topology_, exclusions_,           snapshot.previous,
                            is_fixed_,  snapshot.query_radius, bounds_relaxation_};
  verdict.planes = reference::plane_guarantee(in, {snapshot.planes, snapshot.bounds});
  verdict.broken_planes = reference::broken_planes(snapshot.planes, snapshot.positions);
}

void StateJudge::judge_balls(const compare::Snapshot& snapshot, Verdict& verdict) const {
  const compare::DetectIn in{&topology_, exclusions_, snapshot.previous, contact_radius_, snapshot.query_radius};
  const std::vector<float> exact = reference::exact_bounds(in, bounds_relaxation_);
  double worst = 1;
  for (std::size_t v = 0; v < exact.size(); ++v) {
    const double bound = snapshot.bounds[v], limit = exact[v];
    if (bound <= limit) continue;
    ++verdict.unsafe_bounds;
    if (verdict.worst_vertex >= 0 && !(bound / limit > worst)) continue;
    worst = bound / limit;
    verdict.worst_vertex = static_cast<compare::Index>(v);
    verdict.worst_bound = bound;
    verdict.exact_bound = limit;
  }
}

std::string StateJudge::name_of(const compare::PrimitivePair& pair) const {
  if (pair.kind == compare::PrimitivePair::Kind::vertex_triangle)
    return names_.vertex(pair.first) + " and " +
           names_.triangle(pair.second, topology_.triangles[static_cast<std::size_t>(pair.second)]);
  return names_.edge(topology_.edges[static_cast<std::size_t>(pair.first)]) + " and " +
         names_.edge(topology_.edges[static_cast<std::size_t>(pair.second)]);
}

std::string StateJudge::describe(const compare::AuditResult& result) const {
  return compare::describe(result, topology_, names_);
}

std::string StateJudge::describe(const Verdict& verdict) const {
  std::string text = verdict.intersections.count == 0 ? "" : describe(verdict.intersections);
  if (!text.empty() && text.back() != '\n') text += "\n";
  if (!verdict.motion.kept())
    text += counted(verdict.motion.violations, "vertex position") +
            " beyond the bound; the worst: " + names_.vertex(verdict.motion.worst_vertex) + " moved " +
            number(verdict.motion.worst_ratio, 9) + " times its bound\n";
  if (verdict.unsafe_bounds > 0)
    text += counted(verdict.unsafe_bounds, "bound") +
            " larger than the exact one; the worst: " + names_.vertex(verdict.worst_vertex) + ", " +
            number(verdict.worst_bound, 9) + " m instead of " + number(verdict.exact_bound, 9) + " m\n";
  const compare::PlaneGuarantee& planes = verdict.planes;
  if (planes.uncovered > 0)
    text += counted(planes.uncovered, "pair") +
            " that neither a plane nor balls hold apart; the first: " + name_of(planes.worst) + "\n";
  if (planes.too_large > 0) text += counted(planes.too_large, "ball") + " larger than the query radius allows\n";
  if (planes.broken + verdict.broken_planes > 0)
    text += counted(planes.broken, "half-space") + " not kept at the detection, " +
            counted(verdict.broken_planes, "half-space") + " not kept now\n";
  return text;
}

Auditor::Auditor(const StateJudge& judge, bool beside) : judge_(judge) {
  if (beside) thread_ = std::thread([this] { work(); });
}

Auditor::~Auditor() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    waiting_.clear();
  }
  changed_.notify_all();
  thread_.join();
}

void Auditor::judge_one(const compare::Snapshot& snapshot) {
  try {
    Verdict verdict = judge_.judge(snapshot);
    const std::lock_guard lock(mutex_);
    ready_.push_back(std::move(verdict));
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
  }
}

void Auditor::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
    if (stop_) return;
    const compare::Snapshot snapshot = std::move(waiting_.front());
    waiting_.pop_front();
    busy_ = true;
    lock.unlock();
    changed_.notify_all();
    judge_one(snapshot);
    lock.lock();
    busy_ = false;
    changed_.notify_all();
  }
}

void Auditor::submit(compare::Snapshot snapshot) {
  if (!thread_.joinable()) return judge_one(snapshot);
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < most_waiting; });
  waiting_.push_back(std::move(snapshot));
  changed_.notify_all();
}

std::vector<Verdict> Auditor::take() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  return std::exchange(ready_, {});
}

std::vector<Verdict> Auditor::finish() {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.empty() && !busy_; });
  }
  return take();
}

}  // namespace ogc::experiments

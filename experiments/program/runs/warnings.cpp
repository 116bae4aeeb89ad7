#include "experiments/program/runs/warnings.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/bench/rank_test.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/runs/curved_rest.hpp"
#include "experiments/program/runs/thin_solids.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {

namespace {

using compare::Vec3;

/// The warning suggests a tolerance with which IPC ends a step only when every vertex is slower than this share of the
/// speed that gravity adds per step. The value is a rough choice.
constexpr double share_of_gravity = 0.1;

double norm(const Vec3& a) { return std::hypot(a.x, a.y, a.z); }
double separation(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

std::string bounds_warning(const compare::Scene& scene) {
  if (traits_of(scene.settings.bounds).certifies) return "";
  return "bounds=off: nothing keeps surfaces from passing through each other, and this run guarantees nothing; take "
         "bounds=ball, bounds=planes or bounds=dat (not with --solver penalty)";
}

std::string box_warning(const compare::Scene& scene) {
  if (scene.mesh.positions.empty()) return "";
  Vec3 low = scene.mesh.positions.front(), high = low;
  for (const Vec3& p : scene.mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double diagonal = separation(low, high);
  if (diagonal <= largest_diagonal) return "";
  return "the scene's box has a diagonal of " + number(diagonal) + " m, above " + number(largest_diagonal) +
         " m: lengths are metres; a mesh in millimetres is to be scaled by 0.001, one in centimetres by 0.01";
}

/// Returns the median edge length of the body's triangles, where shared edges count twice; 0 if there is no triangle.
double median_edge(const compare::Scene& scene, const compare::Body& body) {
  std::vector<double> lengths;
  const auto at = [&](compare::Index v) { return scene.mesh.positions[static_cast<std::size_t>(v)]; };
  for (compare::Index t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t) {
    const auto& [a, b, c] = scene.mesh.triangles[static_cast<std::size_t>(t)];
    lengths.insert(lengths.end(), {separation(at(a), at(b)), separation(at(b), at(c)), separation(at(c), at(a))});
  }
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::ranges::nth_element(lengths, middle);
  return *middle;
}

/// Warns of a large r. Names the body with the shortest edges, which has the most contacts.
std::string radius_warning(const compare::Scene& scene) {
  const double contact_radius = scene.settings.contact_radius;
  const compare::Body* finest = nullptr;
  double edge = 0;
  for (const compare::Body& body : scene.bodies) {
    const double median = median_edge(scene, body);
    if (median > 0 && (finest == nullptr || median < edge)) finest = &body, edge = median;
  }
  if (finest == nullptr || contact_radius <= most_edges_a_radius * edge) return "";
  return "contact_radius is " + number(contact_radius) + " m, " + number(contact_radius / edge) + " median edges (" +
         number(edge) + " m) of body '" + finest->name + "', above " + number(most_edges_a_radius) +
         ": neighbours in the mesh press each other apart, and contacts are many; take at most " + number(edge, 2) +
         " m, one edge, or a coarser mesh (ogc suggest says more)";
}

/// Warns if the tolerance lets IPC end a step in which a vertex still moves at a larger speed than gravity adds in the
/// step. A body at rest and a body that should begin to slide then look alike.
std::string tolerance_warning(const compare::Scene& scene, Solver solver) {
  if (solver != Solver::ipc) return "";
  const double speed = reference::ipc_end_speed(scene), gained = norm(scene.gravity) * scene.settings.time_step;
  if (gained == 0 || speed <= gained) return "";
  const bool by_velocity = compare::get_setting(scene.settings, "ipc_stopping") != 0;
  const std::string setting = by_velocity ? "ipc_velocity_tolerance" : "ipc_tolerance";
  const double least = compare::get_setting(scene.settings, setting) * share_of_gravity * gained / speed;
  return setting + " ends a step of IPC where nothing would move faster than " + number(speed) +
         " m/s, and gravity changes speeds by " + number(gained) +
         " m/s in a step: what should begin to move may stay; take " + setting + "=" + number(least, 1);
}

/// Returns the position that keyframes give the k-th vertex of their motion at t = 0: between two keys, or at the first
/// or last key.
Vec3 at_start(const compare::PrescribedMotion& motion, std::size_t k) {
  const std::vector<double>& times = motion.keyframes.times;
  const auto key = [&](std::size_t frame) {
    const compare::Vec3f& x = motion.keyframes.positions[frame * motion.vertices.size() + k];
    return Vec3{x.x, x.y, x.z};
  };
  const auto after = static_cast<std::size_t>(std::ranges::upper_bound(times, 0.0) - times.begin());
  if (after == 0 || after == times.size()) return key(after == 0 ? 0 : after - 1);
  const double s = -times[after - 1] / (times[after] - times[after - 1]);
  const Vec3 from = key(after - 1), to = key(after);
  return {from.x + s * (to.x - from.x), from.y + s * (to.y - from.y), from.z + s * (to.z - from.z)};
}

/// Warns of the motion whose keyframes are farthest from its vertices at the start.
std::string keys_warning(const compare::Scene& scene) {
  double farthest = most_radii_from_keys * scene.settings.contact_radius;
  const compare::PrescribedMotion* of = nullptr;
  compare::Index vertex = -1;
  for (const compare::PrescribedMotion& motion : scene.motions)
    for (std::size_t k = 0; k < motion.vertices.size() && !motion.keyframes.empty(); ++k) {
      const compare::Index v = motion.vertices[k];
      const double away = separation(at_start(motion, k), scene.mesh.positions[static_cast<std::size_t>(v)]);
      if (away > farthest) farthest = away, of = &motion, vertex = v;
    }
  if (of == nullptr) return "";
  const auto body = static_cast<std::size_t>(compare::body_of_vertex(scene)[static_cast<std::size_t>(vertex)]);
  return "the keyframes of motion '" + of->name + "' begin " + number(farthest) + " m away from body '" +
         scene.bodies.at(body).name + "', which they drive (vertex " + std::to_string(vertex) +
         "): the first step carries it there as fast as bounds let it; begin with a key where the body is, or move the "
         "body to the first key";
}

}  // namespace

void ForcesLeft::look_at(const compare::StepMetrics& row) {
  if (!(row.left_rounding <= most_force_left)) return;
  residuals_.push_back(row.left_residual);
  held_.push_back(row.left_held);
}

double ForcesLeft::median_residual() const { return median(residuals_); }
double ForcesLeft::median_held() const { return median(held_); }

Warnings::Warnings(const compare::Scene& scene, Solver solver)
    : radius_(scene.settings.contact_radius),
      guess_rounds_(scene.settings.guess_rounds),
      iterations_(scene.settings.iterations),
      settled_move_(scene.settings.settled_move),
      free_(std::ranges::count(rigid_groups(scene), -1)) {
  for (std::string text : {bounds_warning(scene), box_warning(scene), radius_warning(scene), thin_solid_warning(scene),
                           curved_rest_warning(scene), tolerance_warning(scene, solver), keys_warning(scene)})
    if (!text.empty()) of_scene_.push_back(std::move(text));
}

std::vector<std::string> Warnings::look_at(const compare::StepMetrics& row, std::optional<double> momentum_lost) {
  std::vector<std::string> first;
  const auto note = [&](std::optional<Worst>& worst, double value, auto text) {
    const bool is_first = !worst;
    if (is_first || value > worst->value) worst = Worst{row.step, value};
    if (is_first) first.push_back(text());
  };
  if (momentum_lost && *momentum_lost > most_momentum_lost)
    note(momentum_, *momentum_lost, [this] { return momentum_text(); });
  forces_left_.look_at(row);
  held_ = free_ > 0 && (row.vertices_cut >= free_ || row.share_cut >= 1) ? held_ + 1 : 0;
  const bool is_first = longest_held_ < most_held_steps;
  longest_held_ = std::max(longest_held_, held_);
  if (is_first && held_ >= most_held_steps) first.push_back(held_text());
  if (row.largest_lag > radius_) note(lag_, row.largest_lag, [this] { return lag_text(); });
  return first;
}

std::vector<std::string> Warnings::list() const {
  std::vector<std::string> texts = of_scene_;
  if (momentum_) texts.push_back(momentum_text());
  if (lag_) texts.push_back(lag_text());
  if (longest_held_ >= most_held_steps) texts.push_back(held_text());
  for (std::string& text : look_back()) texts.push_back(std::move(text));
  return texts;
}

std::vector<std::string> Warnings::look_back() const {
  if (!(forces_left_.median_residual() >= most_force_left)) return {};
  return {force_text()};
}

std::string Warnings::momentum_text() const {
  return "step " + std::to_string(momentum_->step) + " lost " + number(100 * momentum_->value) +
         " % of what was to move, by mass and way, to truncation, above " + number(100 * most_momentum_lost) +
         " %, after all " + std::to_string(guess_rounds_) +
         " rounds of the guess: what moves is faster than bounds let it; take a smaller time_step, or a larger "
         "detection_radius_cap, contact_radius or guess_rounds";
}

std::string Warnings::force_text() const {
  const std::string settles = settled_move_ > 0 ? "a smaller settled_move than " + number(settled_move_) + " m, " : "";
  return "the median step leaves free vertices with " + number(100 * forces_left_.median_residual(), 3) +
         " % of their force (Eq. 29, " + counted(forces_left_.steps(), "step") + " measured), above " +
         number(100 * most_force_left) + " %: sweeps end before they are done; take " + settles +
         "more iterations than " + std::to_string(iterations_) + ", a smaller time_step, or --solver newton";
}

std::string Warnings::held_text() const {
  return counted(static_cast<std::size_t>(longest_held_), "step") + " in a row ended with every one of the " +
         std::to_string(free_) + " free vertices" +
         " cut by its bound: nothing moves as forces ask, and what hangs still is no equilibrium; look at the smallest "
         "distances of the start (ogc audit), or take a smaller time_step or a larger detection_radius_cap or "
         "contact_radius";
}

std::string Warnings::lag_text() const {
  return "prescribed vertices lag " + number(lag_->value) + " m behind their motion in step " +
         std::to_string(lag_->step) + ", above contact_radius (" + number(radius_) +
         " m): bounds hold them; move them slower, or take a smaller time_step or a larger detection_radius_cap";
}

}  // namespace ogc::experiments

#include "compare/judge/cases/states.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/judge/cases/block_questions.hpp"
#include "compare/judge/cases/colours.hpp"
#include "compare/judge/cases/stage_traits.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/rods.hpp"
#include "compare/record/run_folder.hpp"
#include "compare/stages/plane.hpp"

namespace ogc::compare {

namespace {

constexpr std::size_t least_frames = 16, most_frames = 100, vertices_kept = std::size_t{1} << 22;
constexpr int questions = 256;  // questions of stage block for each frame

double mean_edge_length(const Topology& topology, const std::vector<Vec3f>& positions) {
  double total = 0;
  for (const Edge& e : topology.edges) {
    const Vec3f &a = positions[e[0]], &b = positions[e[1]];
    total += std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
  }
  return topology.edges.empty() || total == 0 ? 1 : total / static_cast<double>(topology.edges.size());
}

}  // namespace

States::States(const std::filesystem::path& folder, const Authority& authority)
    : folder_(folder.string()), authority_(authority) {
  const RunReader run(folder);
  if (run.frame_count() == 0)
    throw InputError(folder_ + ": the run holds no frame yet; give a run that has stored at least one");
  const Scene& scene = run.scene();
  auto rounded = std::make_shared<Scene>(scene);
  round_to_single(*rounded);
  scene_ = std::move(rounded);
  topology_ = std::make_shared<Topology>(build_topology(scene));
  if (topology_->edges.empty()) throw InputError(folder_ + ": the run's mesh has no edge; give a run of a mesh");
  groups_ = rigid_groups(scene);
  partners_ = exclusions(scene).partners;
  body_ = body_of_vertex(scene);
  rest_ = authority_.rest_state({scene_.get(), topology_.get()}).exact;
  contact_radius_ = static_cast<float>(scene.settings.contact_radius);
  detection_radius_cap_ = static_cast<float>(scene.settings.detection_radius_cap);
  bounds_relaxation_ = static_cast<float>(scene.settings.bounds_relaxation);
  const std::size_t affordable = vertices_kept / std::max<std::size_t>(1, scene.mesh.positions.size());
  const std::size_t count = std::min(run.frame_count(), std::clamp(affordable, least_frames, most_frames));
  for (std::size_t i = 0; i < count; ++i) {
    Frame frame = run.frame(count == 1 ? 0 : i * (run.frame_count() - 1) / (count - 1));
    if (i == 0) cell_size_ = mean_edge_length(*topology_, frame.positions);
    State state{std::move(frame.positions),
                std::move(frame.bounds),
                std::move(frame.velocities),
                std::move(frame.orientations),
                frame.step,
                {}};
    for (std::size_t v = 0; v < state.positions.size(); ++v)
      state.cells.emplace_back(cell(state.positions[v]), static_cast<Index>(v));
    std::sort(state.cells.begin(), state.cells.end());
    states_.push_back(std::move(state));
  }
  smallest_distances_.resize(states_.size());
  contacts_.resize(states_.size());
}

std::string States::missing(Stage stage) const { return traits_of(stage).missing_in(*this); }

std::uint64_t States::cell(const Vec3f& p) const {
  const auto number = [&](float x) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / cell_size_)) + (1 << 20)) & 0x1fffff;
  };
  return number(p.x) << 42 | number(p.y) << 21 | number(p.z);
}

Index States::neighbour(const State& state, Index v, Random& random) const {
  const float size = static_cast<float>(cell_size_);
  for (int attempt = 0; attempt < 16; ++attempt) {
    Vec3f p = state.positions[v];
    p.x += size * static_cast<float>(random.below(3) - 1);
    p.y += size * static_cast<float>(random.below(3) - 1);
    p.z += size * static_cast<float>(random.below(3) - 1);
    const std::uint64_t key = cell(p);
    const auto first = std::lower_bound(state.cells.begin(), state.cells.end(), std::pair{key, Index{-1}});
    const auto last = std::lower_bound(first, state.cells.end(), std::pair{key + 1, Index{-1}});
    if (first == last) continue;
    const Index other = first[random.below(static_cast<int>(last - first))].second;
    if (other != v) return other;
  }
  return v;
}

TruncateCase States::moved_vertex(std::size_t frame, Random& random) const {
  const State &before = states_[frame], &after = states_[std::min(frame + 1, states_.size() - 1)];
  const Index v = random.below(topology_->vertex_count);
  const float bound = before.bounds.empty() ? contact_radius_ : before.bounds[v];
  return {before.positions[v], after.positions[v], bound};
}

InitialGuessCase States::guessed_vertex(std::size_t frame, Random& random) const {
  const State& state = states_[frame];
  const Index v = random.below(topology_->vertex_count);
  // vertices of volumes have no bound
  const bool is_bounded = !state.bounds.empty() && state.bounds[v] < std::numeric_limits<float>::max();
  const float bound = is_bounded ? state.bounds[v] : contact_radius_;
  return {state.positions[v],
          state.velocities[v],
          to_single({scene_->gravity})[0],
          static_cast<float>(scene_->settings.time_step),
          state.positions[v],
          bound,
          random.one_in(8)};
}

BoundCase States::bound(std::size_t frame) const {
  const std::lock_guard lock(filling_);
  std::optional<BoundCase>& c = smallest_distances_[frame];
  if (!c) {
    const DetectIn in{topology_.get(),
                      {groups_, partners_.rows() > 0 ? &partners_ : nullptr},
                      states_[frame].positions,
                      contact_radius_,
                      contact_radius_ * std::max(1.0f, detection_radius_cap_)};
    DetectVertexFacetOut near = authority_.detect_vertex_facet(in).exact;
    c = BoundCase{topology_, std::move(near.d_min_vertex), authority_.detect_edge_edge(in).exact.d_min_edge,
                  std::move(near.d_min_triangle), bounds_relaxation_};
  }
  return *c;
}

std::vector<Quaternion> States::orientations_of(const State& state) const {
  if (!state.orientations.empty()) return state.orientations;
  return std::vector<Quaternion>(rod_segments(*scene_).size(), Quaternion{0, 0, 0, 1});
}

SweepCase States::sweep(std::size_t frame, Random& random) const {
  const State& state = states_[frame];
  SweepCase c;
  c.scene = scene_;
  c.colour = random_colours(random, *scene_, *topology_);
  c.previous = c.start = c.target = state.positions;
  const double h = scene_->settings.time_step;
  const auto ahead = [h](double x, double v, double a) { return static_cast<float>(x + h * (v + h * a)); };
  for (std::size_t v = 0; v < c.target.size(); ++v) {
    if (groups_[v] >= 0) continue;
    const Vec3f &x = state.positions[v], &speed = state.velocities[v];
    const Vec3& a = scene_->gravity;
    c.target[v] = {ahead(x.x, speed.x, a.x), ahead(x.y, speed.y, a.y), ahead(x.z, speed.z, a.z)};
  }
  for (const PrescribedMotion& motion : scene_->motions) {
    const std::vector<Vec3f> targets = prescribed_targets(*scene_, motion, static_cast<double>(state.step + 1) * h);
    for (std::size_t i = 0; i < targets.size(); ++i)
      c.target[static_cast<std::size_t>(motion.vertices[i])] = targets[i];
  }
  c.old = c.target;
  c.largest_bound.assign(c.previous.size(), std::numeric_limits<float>::max());
  c.query_radius = static_cast<float>(contact_radius_ * random.between(1, std::max(1.0f, detection_radius_cap_)));
  if (!has_rods(*scene_)) return c;
  c.segment_colour = random_segment_colours(random, *scene_);
  c.orientation = c.orientation_start = orientations_of(state);
  return c;
}

StepCase States::step(std::size_t frame) const {
  const State& state = states_[frame];
  auto scene = std::make_shared<Scene>(*scene_);
  scene->mesh.positions = to_double(state.positions);
  scene->velocities = to_double(state.velocities);
  if (has_rods(*scene)) scene->orientations = orientations_of(state);
  const double now = static_cast<double>(state.step) * scene->settings.time_step;
  for (PrescribedMotion& motion : scene->motions) {
    const double elapsed = std::clamp(now, motion.start, motion.end) - motion.start;
    motion.centre = {motion.centre.x + elapsed * motion.velocity.x, motion.centre.y + elapsed * motion.velocity.y,
                     motion.centre.z + elapsed * motion.velocity.z};
    motion.start = std::max(0.0, motion.start - now);
    motion.end = std::max(0.0, motion.end - now);
    for (double& time : motion.keyframes.times) time -= now;
  }
  return {std::move(scene), topology_};
}

MeshCase States::whole(std::size_t frame, Random& random) const {
  const float factor = random.one_in(4) ? 1
                                        : static_cast<float>(random.between(1, std::max(1.0f, detection_radius_cap_)));
  return {topology_,
          groups_,
          states_[frame].positions,
          contact_radius_,
          std::max(contact_radius_, contact_radius_ * factor),
          partners_};
}

PlaneCase States::plane(std::size_t frame, Random& random) const {
  const MeshCase mesh = whole(frame, random);
  return {topology_, groups_, mesh.positions, mesh.query_radius, bounds_relaxation_, partners_, fixed_flags(groups_)};
}

BlockCase States::block(std::size_t frame, Random& random) const {
  const std::vector<Vec3f>& x = states_[frame].positions;
  return {topology_, x, block_questions(random, *topology_, x, questions)};
}

CaseData States::make(Stage stage, std::uint64_t index, Random& random) const {
  if (const std::string why = missing(stage); !why.empty())
    throw InputError(folder_ + ": the run has no states for the stage " + std::string(stage_name(stage)) + ": " + why +
                     "; use its generators");
  return traits_of(stage).of_state(*this, index, random);
}

}  // namespace ogc::compare

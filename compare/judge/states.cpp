#include "compare/judge/states.hpp"

#include <algorithm>
#include <cmath>

#include "compare/problem/error.hpp"
#include "compare/record/run_folder.hpp"

namespace ogc::compare {

namespace {

constexpr std::size_t largest_count = 16;

double mean_edge_length(const Topology& topology, const std::vector<Vec3f>& positions) {
  double total = 0;
  for (const Edge& e : topology.edges) {
    const Vec3f &a = positions[e[0]], &b = positions[e[1]];
    total += std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
  }
  return topology.edges.empty() || total == 0 ? 1 : total / static_cast<double>(topology.edges.size());
}

}  // namespace

States::States(const std::filesystem::path& folder) : folder_(folder.string()) {
  const RunReader run(folder);
  if (run.frame_count() == 0) throw InputError(folder_ + ": the run holds no frame yet; give a run that has stored at least one");
  const Scene& scene = run.scene();
  topology_ = std::make_shared<Topology>(build_topology(static_cast<Index>(scene.mesh.positions.size()), scene.mesh.triangles, scene.mesh.loose_edges));
  if (topology_->edges.empty()) throw InputError(folder_ + ": the run's mesh has no edge; give a run of a mesh");
  groups_ = rigid_groups(scene);
  contact_radius_ = static_cast<float>(scene.settings.contact_radius);
  query_radius_cap_ = static_cast<float>(scene.settings.query_radius_cap);
  bound_relaxation_ = static_cast<float>(scene.settings.bound_relaxation);
  const std::size_t count = std::min(run.frame_count(), largest_count);
  for (std::size_t i = 0; i < count; ++i) {
    Frame frame = run.frame(count == 1 ? 0 : i * (run.frame_count() - 1) / (count - 1));
    if (i == 0) cell_size_ = mean_edge_length(*topology_, frame.positions);
    State state{std::move(frame.positions), std::move(frame.bounds), {}};
    for (std::size_t v = 0; v < state.positions.size(); ++v) state.cells.emplace_back(cell(state.positions[v]), static_cast<Index>(v));
    std::sort(state.cells.begin(), state.cells.end());
    states_.push_back(std::move(state));
  }
}

std::uint64_t States::cell(const Vec3f& p) const {
  const auto number = [&](float x) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / cell_size_)) + (1 << 20)) & 0x1fffff; };
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

CaseData States::vertex_triangle(const State& state, Random& random) const {
  const Index v = random.below(topology_->vertex_count);
  const auto candidates = topology_->vertex_triangles[static_cast<std::size_t>(neighbour(state, v, random))];
  const auto any = static_cast<Index>(random.bits() % topology_->triangles.size());
  const Triangle t = topology_->triangles[candidates.empty() ? any : random.pick(candidates)];
  return ClosestFaceCase{state.positions[v], {state.positions[t[0]], state.positions[t[1]], state.positions[t[2]]}};
}

CaseData States::edge_edge(const State& state, Random& random) const {
  const Index v = random.below(topology_->vertex_count);
  const auto edge_of = [&](Index vertex) {
    const auto candidates = topology_->vertex_edges[static_cast<std::size_t>(vertex)];
    return candidates.empty() ? static_cast<Index>(random.bits() % topology_->edges.size()) : random.pick(candidates);
  };
  const Index a = edge_of(v), b = edge_of(neighbour(state, v, random));
  const Edge e = topology_->edges[std::min(a, b)], f = topology_->edges[std::max(a, b)];
  return ClosestPointsCase{{state.positions[e[0]], state.positions[e[1]]}, {state.positions[f[0]], state.positions[f[1]]}};
}

CaseData States::moved_vertex(std::size_t frame, Random& random) const {
  const State &before = states_[frame], &after = states_[std::min(frame + 1, states_.size() - 1)];
  const Index v = random.below(topology_->vertex_count);
  const float bound = before.bounds.empty() ? contact_radius_ : before.bounds[v];
  return TruncateCase{before.positions[v], after.positions[v], bound};
}

CaseData States::bound(Random& random) const {
  BoundCase c{topology_, {}, {}, {}, bound_relaxation_};
  const auto fill = [&](std::vector<float>& values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<float>(contact_radius_ * random.magnitude(-3, 0.6)));
  };
  fill(c.d_min_vertex, static_cast<std::size_t>(topology_->vertex_count));
  fill(c.d_min_edge, topology_->edges.size());
  fill(c.d_min_triangle, topology_->triangles.size());
  return c;
}

CaseData States::make(Stage stage, std::uint64_t index, Random& random) const {
  if (!has(stage)) throw InputError(folder_ + ": the run has no states for the stage " + std::string(stage_name(stage)) + "; use its generators");
  const std::size_t frame = index % states_.size();
  const State& state = states_[frame];
  switch (stage) {
    case Stage::closest_face: return vertex_triangle(state, random);
    case Stage::closest_points: return edge_edge(state, random);
    case Stage::truncate: return moved_vertex(frame, random);
    case Stage::bound: return bound(random);
    default: break;
  }
  const float factor = random.one_in(4) ? 1 : static_cast<float>(random.between(1, std::max(1.0f, query_radius_cap_)));
  return MeshCase{topology_, groups_, state.positions, contact_radius_, std::max(contact_radius_, contact_radius_ * factor)};
}

}  // namespace ogc::compare

#include "experiments/bench/stage_benchmarks.hpp"

#include <functional>
#include <mutex>
#include <stdexcept>

#include <benchmark/benchmark.h>

#include "compare/judge/generators.hpp"
#include "compare/judge/judge.hpp"
#include "compare/judge/questions.hpp"
#include "compare/judge/sweep_question.hpp"
#include "experiments/scenes/registry.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {

namespace {

using compare::Contestant;
using compare::Stage;
using compare::TestCase;

constexpr std::uint64_t batch = 1u << 14, seed = 1;

/// A question, ready to be asked again and again.
struct Call {
  std::function<void()> ask;
  std::int64_t items = 0;  ///< cases, or vertices of a mesh
};

/// Of the generators that seek no degeneracy, by their shares.
std::vector<TestCase> generic_cases(Stage stage, std::uint64_t count) {
  double shares = 0;
  for (const compare::Generator& row : generators(stage)) shares += row.generic ? row.share : 0;
  std::vector<TestCase> cases;
  for (const compare::Generator& row : generators(stage)) {
    if (!row.generic) continue;
    const auto wanted = static_cast<std::uint64_t>(static_cast<double>(count) * row.share / shares) + 1;
    for (std::uint64_t i = 0; i < wanted && cases.size() < count; ++i)
      cases.push_back(generate(row, {stage, std::string(row.name), seed, i, "", {}}));
  }
  if (cases.empty()) throw std::logic_error("a stage without generic cases");
  return cases;
}

template <class In, class Out>
Call call_of(In in, const std::function<Out(const In&)>& stage, std::int64_t items) {
  const auto kept = std::make_shared<const In>(std::move(in));
  return {[kept, stage] { benchmark::DoNotOptimize(stage(*kept)); }, items};
}

Call pair_call(Stage stage, const Contestant& contestant) {
  const std::vector<TestCase> cases = generic_cases(stage, batch);
  const auto n = static_cast<std::int64_t>(cases.size());
  switch (stage) {
    case Stage::closest_face: return call_of(face_question(cases), contestant.closest_face, n);
    case Stage::closest_points: return call_of(points_question(cases), contestant.closest_points, n);
    case Stage::initial_guess:
      return call_of(case_question(cases, &compare::InitialGuessIn::cases), contestant.initial_guess, n);
    case Stage::activation: return call_of(activation_question(cases), contestant.activation, n);
    case Stage::contact_force:
      return call_of(case_question(cases, &compare::ContactForceIn::cases), contestant.contact_force, n);
    case Stage::friction_force:
      return call_of(case_question(cases, &compare::FrictionForceIn::cases), contestant.friction_force, n);
    case Stage::membrane: return call_of(case_question(cases, &compare::MembraneIn::cases), contestant.membrane, n);
    case Stage::bending: return call_of(case_question(cases, &compare::BendingIn::cases), contestant.bending, n);
    case Stage::spring: return call_of(case_question(cases, &compare::SpringIn::cases), contestant.spring, n);
    default: return call_of(truncate_question(cases), contestant.truncate, n);
  }
}

/// What a mesh's question looks at.
struct SceneData {
  compare::Scene scene;
  compare::Topology topology;
  compare::Exclusions left_out;
  std::vector<compare::Vec3f> positions;
  compare::DetectVertexFacetOut vertex_facet;
  compare::DetectEdgeEdgeOut edge_edge;

  explicit SceneData(compare::Scene from)
      : scene(std::move(from)),
        topology(build_topology(scene)),
        left_out(exclusions(scene)),
        positions(compare::to_single(scene.mesh.positions)) {}
  compare::DetectIn detect() const {
    const auto radius = static_cast<float>(scene.settings.contact_radius);
    return {&topology, left_out, positions, radius, static_cast<float>(scene.settings.query_radius_cap) * radius};
  }
};

/// The owner of what a view looks at goes where the view goes.
template <class Owner>
Call owned(Call call, std::shared_ptr<Owner> owner) {
  call.ask = [ask = std::move(call.ask), owner = std::move(owner)] { ask(); };
  return call;
}

Call scene_call(Stage stage, const Contestant& contestant, compare::Scene scene) {
  const auto data = std::make_shared<SceneData>(std::move(scene));
  const auto n = static_cast<std::int64_t>(data->positions.size());
  switch (stage) {
    case Stage::rest_state:
      return owned(call_of(compare::RestStateIn{&data->scene, &data->topology}, contestant.rest_state, n), data);
    case Stage::step: return owned(call_of(compare::StepIn{&data->scene, &data->topology}, contestant.step, n), data);
    case Stage::detect_vertex_facet: return owned(call_of(data->detect(), contestant.detect_vertex_facet, n), data);
    case Stage::detect_edge_edge: return owned(call_of(data->detect(), contestant.detect_edge_edge, n), data);
    default: break;
  }
  data->vertex_facet = contestant.detect_vertex_facet(data->detect());
  data->edge_edge = contestant.detect_edge_edge(data->detect());
  const compare::BoundIn in{&data->topology, data->vertex_facet.d_min_vertex, data->edge_edge.d_min_edge,
                            data->vertex_facet.d_min_triangle,
                            static_cast<float>(data->scene.settings.bound_relaxation)};
  return owned(call_of(in, contestant.bound, n), data);
}

/// One mesh of the judge.
Call case_call(Stage stage, const Contestant& contestant) {
  const auto test = std::make_shared<TestCase>(generic_cases(stage, 1).front());
  if (stage == Stage::block) {
    const compare::BlockIn in = block_question(*test);
    return owned(call_of(in, contestant.block, static_cast<std::int64_t>(in.questions.size())), test);
  }
  const auto question = std::make_shared<compare::SweepQuestion>(std::get<compare::SweepCase>(test->data),
                                                                 reference::authority());
  return owned(owned(call_of(question->in(), contestant.sweep, static_cast<std::int64_t>(question->in().colour.size())),
                     question),
               test);
}

bool takes_scene(Stage stage) { return is_mesh_stage(stage) && stage != Stage::block && stage != Stage::sweep; }

Call make_call(Stage stage, const Contestant& contestant, const std::string& scale) {
  if (!is_mesh_stage(stage)) return pair_call(stage, contestant);
  if (!takes_scene(stage)) return case_call(stage, contestant);
  return scene_call(stage, contestant, make_scene("cloth_on_sphere", parse_scale(scale)));
}

}  // namespace

void register_stage_benchmarks(const BenchOptions& options) {
  for (const fast::Backend backend : options.backends) {
    for (const Stage stage : compare::all_stages) {
      const std::string name = "stage/" + std::string(stage_name(stage)) +
                               (takes_scene(stage) ? "/" + options.scale : "") + "/" + name_of(backend);
      const auto body = [stage, backend, scale = options.scale,
                         call = std::make_shared<std::optional<Call>>()](benchmark::State& state) {
        if (!*call) *call = make_call(stage, fast::contestant(backend), scale);
        (*call)->ask();
        for (auto _ : state) (*call)->ask();
        state.SetItemsProcessed(state.iterations() * (*call)->items);
      };
      benchmark::RegisterBenchmark(name.c_str(), body)->UseRealTime()->MinTime(0.05)->Repetitions(options.repetitions);
    }
  }
}

}  // namespace ogc::experiments

#include "experiments/python/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "compare/problem/error.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/readers.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/validate.hpp"
#include "experiments/python/contacts.hpp"

namespace ogc::python {
namespace {

using compare::StepMetrics;

template <class Choice>
Choice parse(const char* what, std::string_view name) {
  constexpr auto& names = compare::choice_names<Choice>;
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw compare::InputError(compare::unknown_name(what, name, names));
  return static_cast<Choice>(found - names.begin());
}

template <auto field>
constexpr MetricColumn column(const char* name) {
  using Value = std::remove_cvref_t<decltype(std::declval<StepMetrics>().*field)>;
  if constexpr (std::is_integral_v<Value>)
    return {name, true, nullptr, [](const StepMetrics& row) { return static_cast<std::int64_t>(row.*field); }};
  else
    return {name, false, [](const StepMetrics& row) { return row.*field; }, nullptr};
}

constexpr std::array all_columns{
    column<&StepMetrics::step>("step"),
    column<&StepMetrics::wall_ms>("wall_ms"),
    column<&StepMetrics::vertex_facet_contacts>("vertex_facet_contacts"),
    column<&StepMetrics::edge_edge_contacts>("edge_edge_contacts"),
    column<&StepMetrics::broad_phases>("broad_phases"),
    column<&StepMetrics::discrete_detections>("discrete_detections"),
    column<&StepMetrics::guess_rounds>("guess_rounds"),
    column<&StepMetrics::iterations>("iterations"),
    column<&StepMetrics::vertices_cut>("vertices_cut"),
    column<&StepMetrics::share_cut>("share_cut"),
    column<&StepMetrics::momentum_lost_guess>("momentum_lost_guess"),
    column<&StepMetrics::momentum_lost_end>("momentum_lost_end"),
    column<&StepMetrics::largest_lag>("largest_lag"),
    column<&StepMetrics::query_radius>("query_radius"),
    column<&StepMetrics::residual>("residual"),
    column<&StepMetrics::kinetic_energy>("kinetic_energy"),
    column<&StepMetrics::elastic_energy>("elastic_energy"),
    column<&StepMetrics::contact_energy>("contact_energy"),
    column<&StepMetrics::gravity_energy>("gravity_energy"),
    column<&StepMetrics::smallest_distance>("smallest_distance"),
    column<&StepMetrics::repeats>("repeats"),
    column<&StepMetrics::status>("status"),
};

std::int64_t frame_steps(const compare::Settings& settings) {
  if (settings.frame_steps > 0) return settings.frame_steps;
  return std::max<std::int64_t>(1, std::llround(1 / (60 * settings.time_step)));
}

}  // namespace

compare::Material material_of(const ClothMaterial& cloth) {
  if (!(cloth.poisson > -1 && cloth.poisson < 1))
    throw compare::InputError("poisson: " + std::to_string(cloth.poisson) + " came; plane stress has −1 < ν < 1");
  compare::Material material;
  material.density = cloth.density;
  material.membrane = parse<compare::MembraneModel>("membrane", cloth.membrane);
  material.bending = parse<compare::BendingModel>("bending_model", cloth.bending_model);
  material.lame_mu = cloth.young / (2 * (1 + cloth.poisson));
  material.lame_lambda = cloth.young * cloth.poisson / (1 - cloth.poisson * cloth.poisson);
  material.bending_stiffness = cloth.bending;
  material.membrane_damping = cloth.damping;
  material.bending_damping = cloth.bending_damping;
  material.contact_stiffness = cloth.contact_stiffness;
  material.friction = cloth.friction;
  return material;
}

compare::Mesh mesh_of(std::span<const compare::Vec3f> positions, std::span<const compare::Triangle> triangles) {
  compare::Mesh mesh;
  mesh.positions = compare::to_double({positions.begin(), positions.end()});
  mesh.triangles.assign(triangles.begin(), triangles.end());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const compare::Index v : triangles[t])
      if (v < 0 || compare::at(v) >= positions.size())
        throw compare::InputError("faces: triangle " + std::to_string(t) + " names vertex " + std::to_string(v) +
                                  ", but x has " + std::to_string(positions.size()) + " vertices");
  return mesh;
}

compare::Material obstacle_material(double friction, double contact_stiffness) {
  compare::Material material;
  material.membrane = compare::MembraneModel::none;
  material.bending = compare::BendingModel::none;
  material.lame_mu = material.lame_lambda = material.bending_stiffness = 0;
  material.friction = friction;
  material.contact_stiffness = contact_stiffness;
  return material;
}

std::span<const MetricColumn> metric_columns() { return all_columns; }

compare::Scene checked(compare::Scene scene) {
  compare::round_to_single(scene);
  const std::vector<compare::Problem> problems = compare::validate(scene);
  if (!problems.empty())
    throw compare::InputError("the scene '" + scene.name + "' cannot be simulated:\n" + compare::describe(problems));
  compare::refuse_unread(scene.settings, "vbd");
  return scene;
}

std::string failure_of(const StepMetrics& row) {
  const std::string where = "step " + std::to_string(row.step) + ": ";
  if (row.status & compare::step_not_finite)
    return where +
           "a position became infinite or not a number; the last good state is kept. Take a smaller dt, more "
           "iterations, or softer materials";
  if (row.status & compare::step_bound_violated)
    return where +
           "a vertex moved further than its bound: the guarantee is broken; the last good state is kept. "
           "Please report it";
  return {};
}

Simulation::Simulation(compare::Scene scene, std::string_view backend, const compare::SimulationOptions& options) {
  const fast::Backend chosen = usable_backend(backend);
  scene_ = checked(std::move(scene));
  simulation_ = fast::contestant(chosen).start(scene_, options);
  state_ = &fast::resident_state(*simulation_);
}

std::vector<StepMetrics> Simulation::advance(std::int64_t steps, const std::function<void()>& between) {
  std::unique_lock lock(busy_);
  if (steps < 0) throw compare::InputError("steps: " + std::to_string(steps) + " came; give at least 0");
  if (!failure_.empty()) throw std::runtime_error(failure_ + " (restore a snapshot to go on)");
  const std::int64_t chunk = frame_steps(scene_.settings);
  std::vector<StepMetrics> rows;
  while (steps > 0) {
    const std::int64_t now = std::min(steps, chunk);
    begin_overwriting();
    const std::vector<StepMetrics> new_rows = simulation_->advance(now);
    rows.insert(rows.end(), new_rows.begin(), new_rows.end());
    rows_.insert(rows_.end(), new_rows.begin(), new_rows.end());
    if (!new_rows.empty()) failure_ = failure_of(new_rows.back());
    if (!failure_.empty()) throw std::runtime_error(failure_);
    steps -= now;
    // `between` may call Python code, such as the handler of a signal, and this may read the simulation.
    lock.unlock();
    between();
    lock.lock();
  }
  return rows;
}

std::vector<StepMetrics> Simulation::rows() const {
  const std::lock_guard lock(busy_);
  return rows_;
}

compare::Snapshot Simulation::snapshot() const {
  const std::lock_guard lock(busy_);
  return simulation_->snapshot();
}

void Simulation::restore(const compare::Snapshot& snapshot) {
  const std::lock_guard lock(busy_);
  if (snapshot.positions.size() != scene_.mesh.positions.size())
    throw compare::InputError("snapshot: it has " + std::to_string(snapshot.positions.size()) +
                              " vertices, the scene " + std::to_string(scene_.mesh.positions.size()));
  begin_overwriting();
  simulation_->restore(snapshot);
  failure_.clear();
  rows_.clear();
}

const compare::Vec3f* Simulation::lend_rows(StateField field, std::uint64_t version) {
  const std::lock_guard lock(busy_);
  expect(version);
  note_lent();
  return field == StateField::positions ? state_->positions_resident() : state_->velocities_resident();
}

std::vector<compare::Vec3f> Simulation::copy_rows(StateField field, std::uint64_t version) {
  const std::lock_guard lock(busy_);
  expect(version);
  return field == StateField::positions ? state_->positions() : state_->velocities();
}

}  // namespace ogc::python

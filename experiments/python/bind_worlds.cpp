// Binds worlds. Texts are for help() and the stubs.
#include "experiments/python/worlds.hpp"

#include <utility>
#include <variant>

#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "compare/problem/error.hpp"
#include "experiments/python/arrays.hpp"
#include "experiments/python/module.hpp"
#include "experiments/python/scenes.hpp"

namespace ogc::python {

using compare::InputError;
using compare::StepMetrics;

Worlds::Worlds(const std::vector<compare::Scene>& scenes, std::string_view backend,
               const compare::SimulationOptions& options)
    : failures_(scenes.size()) {
  for (const compare::Scene& scene : scenes) vertices_.push_back(scene.mesh.positions.size());
  worlds_ = fast::start_worlds(usable_backend(backend), scenes, options);
}

int Worlds::number_of(std::int64_t world) const {
  if (world < 0 || static_cast<std::size_t>(world) >= count())
    throw InputError("world: " + std::to_string(world) + " came; there are " + std::to_string(count()) +
                     ", numbered from 0");
  return static_cast<int>(world);
}

std::vector<std::vector<StepMetrics>> Worlds::advance(std::span<const std::int64_t> steps) {
  if (steps.size() != count())
    throw InputError("steps: " + std::to_string(steps.size()) + " numbers came for " + std::to_string(count()) +
                     " worlds");
  for (const std::int64_t number : steps)
    if (number < 0) throw InputError("steps: " + std::to_string(number) + " came; give at least 0");
  const std::lock_guard lock(busy_);
  std::vector<std::vector<StepMetrics>> rows = worlds_->advance(steps);
  for (std::size_t w = 0; w < rows.size(); ++w)
    if (!rows[w].empty() && failures_[w].empty()) failures_[w] = failure_of(rows[w].back());
  return rows;
}

std::vector<std::string> Worlds::failures() const {
  const std::lock_guard lock(busy_);
  return failures_;
}

compare::Snapshot Worlds::snapshot(std::int64_t world) const {
  const int number = number_of(world);
  const std::lock_guard lock(busy_);
  return worlds_->snapshot(number);
}

void Worlds::reset(std::int64_t world, const compare::Snapshot& state) {
  const int number = number_of(world);
  const std::size_t expected = vertices_[static_cast<std::size_t>(number)];
  if (state.positions.size() != expected)
    throw InputError("snapshot: it has " + std::to_string(state.positions.size()) + " vertices, world " +
                     std::to_string(world) + " has " + std::to_string(expected));
  const std::lock_guard lock(busy_);
  worlds_->reset(number, state);
  failures_[static_cast<std::size_t>(number)].clear();
}

std::unique_ptr<Worlds> worlds_of_scene(const compare::Scene& scene, std::int64_t count, const std::string& backend,
                                        bool energies) {
  if (count < 1) throw InputError("count: " + std::to_string(count) + " came; give at least 1");
  const nb::gil_scoped_release release;
  const compare::Scene one = checked(scene);
  const auto copies = static_cast<std::size_t>(count);
  fast::expect_room(usable_backend(backend), one, copies);  // before the copies are made
  return std::make_unique<Worlds>(std::vector<compare::Scene>(copies, one), backend,
                                  compare::SimulationOptions{.energies = energies});
}

namespace {

std::unique_ptr<Worlds> worlds_of_scenes(const std::vector<compare::Scene*>& scenes, const std::string& backend,
                                         bool energies) {
  std::vector<compare::Scene> copies;
  for (const compare::Scene* scene : scenes) {
    if (scene == nullptr) throw nb::type_error("scenes: None came; give objects of Scene");
    copies.push_back(checked(*scene));
  }
  const nb::gil_scoped_release release;
  return std::make_unique<Worlds>(copies, backend, compare::SimulationOptions{.energies = energies});
}

nb::list advance_all(Worlds& worlds, const std::variant<std::int64_t, std::vector<std::int64_t>>& steps) {
  std::vector<std::vector<StepMetrics>> rows;
  {
    const nb::gil_scoped_release release;
    const auto* one = std::get_if<std::int64_t>(&steps);
    rows = worlds.advance(one != nullptr ? std::vector<std::int64_t>(worlds.count(), *one)
                                         : std::get<std::vector<std::int64_t>>(steps));
  }
  nb::list tables;
  for (const std::vector<StepMetrics>& of_world : rows) tables.append(table_of(of_world));
  return tables;
}

nb::dict failures_of(const Worlds& worlds) {
  nb::dict found;
  const std::vector<std::string> all = worlds.failures();
  for (std::size_t w = 0; w < all.size(); ++w)
    if (!all[w].empty()) found[nb::int_(w)] = nb::cast(all[w]);
  return found;
}

}  // namespace

void bind_worlds(nb::module_& module) {
  nb::class_<Worlds>(module, "Worlds",
                     "Scenes that run side by side and never see each other; worlds and Scene.worlds make it. On a "
                     "device all\n"
                     "share each launch. A world has the bits that it has alone.")
      .def("__len__", &Worlds::count)
      .def("advance", &advance_all, nb::arg("steps") = 1,
           nb::sig("def advance(self, steps: int | collections.abc.Sequence[int] = 1) -> list[numpy.recarray]"),
           "Runs so many steps in each world, or steps[w] in world w, and returns the metrics of each, a row a step.\n"
           "A world whose step fails keeps its last good state and stands still until `reset`; the others go on.\n\n"
           "ValueError: a negative number, or not one for each world.")
      .def_prop_ro("failures", &failures_of, nb::sig("def failures(self) -> dict[int, str]"),
                   "worlds that stand still, and why")
      .def(
          "snapshot",
          [](const Worlds& worlds, std::int64_t world) {
            const nb::gil_scoped_release release;
            return worlds.snapshot(world);
          },
          nb::arg("world"), nb::sig("def snapshot(self, world: int) -> Snapshot"),
          "Copies the state of a world to the host. ValueError: there is no such world.")
      .def(
          "reset",
          [](Worlds& worlds, std::int64_t world, const compare::Snapshot& snapshot) {
            const nb::gil_scoped_release release;
            worlds.reset(world, snapshot);
          },
          nb::arg("world"), nb::arg("snapshot"), nb::sig("def reset(self, world: int, snapshot: Snapshot) -> None"),
          "Goes on from a snapshot, to the same bits, in this world alone. ValueError: there is no such world, or the\n"
          "snapshot has another number of vertices.")
      .def_prop_ro("device", &Worlds::device, "\"2 threads\", or the device");
  module.def(
      "worlds", &worlds_of_scenes, nb::arg("scenes"), nb::arg("backend") = "cpu", nb::arg("energies") = true,
      nb::sig("def worlds(scenes: collections.abc.Sequence[Scene], backend: str = 'cpu', energies: bool = True) "
              "-> Worlds"),
      "Starts one world for each scene; meshes and settings may differ.\n\n"
      "ValueError: no scene, or one that is not valid. RuntimeError: the backend is not there, or has too little\n"
      "memory.");
}

}  // namespace ogc::python

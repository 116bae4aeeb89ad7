// Binds scenes and simulations. Texts are for help() and the stubs.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/unique_ptr.h>

#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "experiments/python/arrays.hpp"
#include "experiments/python/module.hpp"
#include "experiments/python/scenes.hpp"
#include "experiments/scenes/registry.hpp"

namespace ogc::python {
namespace {

using compare::Snapshot;

/// A body of a scene: the ranges of its vertices and triangles.
struct Body {
  std::string name;
  compare::Index first_vertex = 0, vertex_count = 0, first_triangle = 0, triangle_count = 0;
};

nb::object slice_of(compare::Index first, compare::Index count) {
  return nb::slice(nb::int_(first), nb::int_(first + count), nb::none());
}

Body body_of(const compare::Scene& scene, std::size_t i) {
  const compare::Body& body = scene.bodies[i];
  return {body.name, body.first_vertex, body.vertex_count, body.first_triangle, body.triangle_count};
}

/// Returns the given name, or "cloth_2" for the third body.
std::string name_of(const compare::Scene& scene, const std::optional<std::string>& given, const std::string& kind) {
  if (given) return *given;
  return kind + "_" + std::to_string(scene.bodies.size());
}

void set_all(compare::Settings& settings, const nb::kwargs& given) {
  for (const auto& [name, value] : given) {
    const nb::str text = nb::isinstance<nb::bool_>(value) ? nb::str(nb::int_(nb::cast<bool>(value))) : nb::str(value);
    compare::set_setting(settings, nb::cast<std::string_view>(name), nb::cast<std::string_view>(text));
  }
}

compare::Vec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

void init_scene(compare::Scene* self, double dt, std::int64_t iterations, double radius,
                const std::array<double, 3>& gravity, const std::string& name, const nb::kwargs& settings) {
  compare::Scene scene;
  scene.name = name;
  scene.gravity = vector_of(gravity);
  scene.settings.time_step = dt;
  scene.settings.iterations = iterations;
  scene.settings.contact_radius = radius;
  set_all(scene.settings, settings);
  new (self) compare::Scene(std::move(scene));
}

Body add_cloth(compare::Scene& scene, nb::handle x, nb::handle faces, const ClothMaterial& material, nb::handle rest,
               nb::handle velocities, const std::optional<std::string>& name) {
  const auto positions = given_positions(x, "x");
  const auto triangles = given_triangles(faces, "faces");
  const auto expect_rows = [&](const char* argument, std::size_t rows) {
    if (rows != positions.items.size())
      throw compare::InputError(std::string(argument) + ": " + std::to_string(rows) + " rows came for " +
                                std::to_string(positions.items.size()) + " vertices");
  };
  Given<compare::Vec3f> given_rest, given_velocities;
  if (!rest.is_none()) given_rest = given_positions(rest, "rest");
  if (!velocities.is_none()) given_velocities = given_positions(velocities, "velocities");
  if (!rest.is_none()) expect_rows("rest", given_rest.items.size());
  if (!velocities.is_none()) expect_rows("velocities", given_velocities.items.size());
  const std::size_t first = scene.mesh.positions.size();
  const std::size_t body = append_body(scene,
                                       {.name = name_of(scene, name, "cloth"), .material = material_of(material)},
                                       mesh_of(positions.items, triangles.items));
  for (std::size_t v = 0; v < given_rest.items.size(); ++v)
    scene.rest_positions[first + v] = {given_rest.items[v].x, given_rest.items[v].y, given_rest.items[v].z};
  for (std::size_t v = 0; v < given_velocities.items.size(); ++v)
    scene.velocities[first + v] = {given_velocities.items[v].x, given_velocities.items[v].y,
                                   given_velocities.items[v].z};
  return body_of(scene, body);
}

Body add_fixed_body(compare::Scene& scene, nb::handle x, nb::handle faces, double friction, double contact_stiffness,
                    const std::optional<std::string>& name) {
  const auto positions = given_positions(x, "x");
  const auto triangles = given_triangles(faces, "faces");
  return body_of(scene, append_body(scene,
                                    {.name = name_of(scene, name, "body"),
                                     .fixed = true,
                                     .material = obstacle_material(friction, contact_stiffness)},
                                    mesh_of(positions.items, triangles.items)));
}

Body add_moving_body(compare::Scene& scene, nb::handle frames, nb::handle faces, nb::handle times, double friction,
                     double contact_stiffness, const std::optional<std::string>& name) {
  const auto given_frames = given<compare::Vec3f>(frames, {"frames", "float32", "(F, V, 3)", 3, 3});
  const auto triangles = given_triangles(faces, "faces");
  const std::size_t count = given_frames.array.shape(0), vertices = given_frames.array.shape(1);
  if (count < 2)
    throw compare::InputError("frames: " + std::to_string(count) +
                              " came; a moving body needs two, one that rests is add_fixed_body");
  std::vector<double> moments;
  if (times.is_none()) {
    for (std::size_t k = 0; k < count; ++k) moments.push_back(static_cast<double>(k) * scene.settings.time_step);
  } else {
    const auto given_times = given<double>(times, {"times", "float64", "(F,)", 1});
    moments.assign(given_times.items.begin(), given_times.items.end());
  }
  if (moments.size() != count)
    throw compare::InputError("times: " + std::to_string(moments.size()) + " came for " + std::to_string(count) +
                              " frames");
  const auto first = static_cast<compare::Index>(scene.mesh.positions.size());
  const std::string body_name = name_of(scene, name, "body");
  const std::size_t body = append_body(scene,
                                       {.name = body_name, .material = obstacle_material(friction, contact_stiffness)},
                                       mesh_of(given_frames.items.first(vertices), triangles.items));
  compare::PrescribedMotion motion;
  motion.name = body_name + "_motion";
  for (std::size_t v = 0; v < vertices; ++v) motion.vertices.push_back(first + static_cast<compare::Index>(v));
  motion.keyframes.times = std::move(moments);
  motion.keyframes.positions.assign(given_frames.items.begin(), given_frames.items.end());
  scene.motions.push_back(std::move(motion));
  return body_of(scene, body);
}

/// NumPy's types of a table of metrics. NumPy takes longer to make them than a short step takes.
struct TableType {
  nb::object row, table;

  TableType() {
    nb::list types;
    for (const MetricColumn& column : metric_columns())
      types.append(nb::make_tuple(column.name, column.is_whole ? "i8" : "f8"));
    const nb::module_ numpy = nb::module_::import_("numpy");
    row = numpy.attr("dtype")(nb::make_tuple(numpy.attr("record"), types));
    table = numpy.attr("recarray");
  }
};

}  // namespace

nb::object table_of(const std::vector<compare::StepMetrics>& rows) {
  const auto columns = metric_columns();
  auto cells = std::make_unique<std::vector<std::int64_t>>();
  cells->reserve(rows.size() * columns.size());
  for (const compare::StepMetrics& row : rows)
    for (const MetricColumn& column : columns) {
      std::int64_t cell = 0;
      if (column.is_whole) {
        cell = column.whole(row);
      } else {
        const double number = column.number(row);
        std::memcpy(&cell, &number, sizeof cell);
      }
      cells->push_back(cell);
    }
  std::int64_t* data = cells->data();
  const std::size_t count = cells->size();
  const nb::capsule owner(cells.release(),
                          [](void* all) noexcept { delete static_cast<std::vector<std::int64_t>*>(all); });
  const nb::object array = nb::cast(nb::ndarray<nb::numpy, std::int64_t, nb::ndim<1>>(data, {count}, owner),
                                    nb::rv_policy::reference);
  static const TableType* const type = new TableType;  // kept for good: Python's objects may end before statics do
  return array.attr("view")(type->row).attr("view")(type->table);
}

namespace {

nb::object advance(Simulation& simulation, std::int64_t steps) {
  std::vector<compare::StepMetrics> rows;
  {
    const nb::gil_scoped_release release;
    rows = simulation.advance(steps, [] {
      const nb::gil_scoped_acquire acquire;
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
    });
  }
  return table_of(rows);
}

Snapshot snapshot_of(const Simulation& simulation) {
  const nb::gil_scoped_release release;
  return simulation.snapshot();
}

template <StateField field>
StateView view_of(nb::handle self) {
  auto& simulation = nb::cast<Simulation&>(self);
  return {nb::borrow(self),           &simulation,         field, simulation.scene().mesh.positions.size(),
          simulation.device_number(), simulation.version()};
}

/// Advances a few steps at a time, and yields the row of each.
struct Steps {
  nb::object simulation, rows = nb::none();
  std::int64_t left = 0, every = 1;
  std::size_t next = 0;

  nb::object operator()() {
    if (rows.is_none() || next == nb::len(rows)) {
      if (left <= 0) throw nb::stop_iteration();
      const std::int64_t now = std::min(left, every);
      left -= now;
      next = 0;
      rows = advance(nb::cast<Simulation&>(simulation), now);
    }
    return rows[next++];
  }
};

Steps run(nb::object self, std::optional<double> seconds, std::optional<std::int64_t> steps, std::int64_t every) {
  if (seconds.has_value() == steps.has_value()) throw compare::InputError("run: give either seconds or steps");
  if (every < 1) throw compare::InputError("every: " + std::to_string(every) + " came; give at least 1");
  const double dt = nb::cast<Simulation&>(self).scene().settings.time_step;
  // The number of steps that end within `seconds`; half a step absorbs the rounding of their quotient.
  const double asked = steps ? 0 : *seconds / dt + 0.5;
  if (!(asked >= 0 && asked < 0x1p62))
    throw compare::InputError("seconds: " + compare::shortest(*seconds) + " came; give a number of at least 0");
  const std::int64_t count = steps ? *steps : static_cast<std::int64_t>(asked);
  return {.simulation = std::move(self), .left = count, .every = every};
}

std::unique_ptr<Simulation> start(const compare::Scene& scene, const std::string& backend,
                                  const std::optional<std::string>& bounds, bool profile, bool energies) {
  compare::Scene copy = scene;
  if (bounds) compare::set_setting(copy.settings, "bounds", *bounds);
  const nb::gil_scoped_release release;
  return std::make_unique<Simulation>(std::move(copy), backend,
                                      compare::SimulationOptions{.profile = profile, .energies = energies});
}

void bind_bodies(nb::module_& module) {
  nb::class_<Body>(module, "Body", "A body of a scene.")
      .def_ro("name", &Body::name)
      .def_prop_ro(
          "vertices", [](const Body& body) { return slice_of(body.first_vertex, body.vertex_count); },
          nb::sig("def vertices(self) -> slice"), "its part of positions: sim.positions[body.vertices]")
      .def_prop_ro(
          "triangles", [](const Body& body) { return slice_of(body.first_triangle, body.triangle_count); },
          nb::sig("def triangles(self) -> slice"), "its part of scene.faces")
      .def("__repr__", [](const Body& body) {
        return "Body '" + body.name + "' of " + std::to_string(body.vertex_count) + " vertices";
      });
}

#define OGC_FACES "faces: " OGC_GIVEN("int32", "(None, 3)")
#define OGC_MORE "friction: float = 0.2, contact_stiffness: float = 100, name: str | None = None) -> Body"

void bind_adders(nb::class_<compare::Scene>& bound) {
  bound.def(
      "add_cloth",
      [](compare::Scene& scene, nb::handle x, nb::handle faces, double density, double young, double poisson,
         double bending, double friction, double contact_stiffness, double damping, double bending_damping,
         const std::string& membrane, const std::string& bending_model, nb::handle rest, nb::handle velocities,
         const std::optional<std::string>& name) {
        return add_cloth(scene, x, faces,
                         {density, young, poisson, bending, friction, contact_stiffness, damping, bending_damping,
                          membrane, bending_model},
                         rest, velocities, name);
      },
      nb::arg("x").none(), nb::arg("faces").none(), nb::arg("density") = 0.2, nb::arg("young") = 1e3,
      nb::arg("poisson") = 0.3, nb::arg("bending") = 5e-7, nb::arg("friction") = 0.2,
      nb::arg("contact_stiffness") = 100.0, nb::arg("damping") = 0.0, nb::arg("bending_damping") = 0.0,
      nb::arg("membrane") = "stable_neo_hookean", nb::arg("bending_model") = "discrete_hinge",
      nb::arg("rest") = nb::none(), nb::arg("velocities") = nb::none(), nb::arg("name") = nb::none(),
      nb::sig("def add_cloth(self, x: " OGC_GIVEN(
          "float32", "(None, 3)") ", " OGC_FACES ", density: float = 0.2, young: float = 1000.0, poisson: float = 0.3, "
                                  "bending: float = 5e-7, friction: "
                                  "float = 0.2, contact_stiffness: float = 100.0, damping: float = 0.0, "
                                  "bending_damping: float = 0.0, "
                                  "membrane: str = 'stable_neo_hookean', bending_model: str = 'discrete_hinge', "
                                  "rest: " OGC_GIVEN("float32", "(None, 3)") " | None = None, velocities: " OGC_GIVEN(
                                      "float32", "(None, 3)") " | None = None, name: str | None = None) -> Body"),
      "Adds a cloth and returns its ranges.\n\n"
      "x: float32 (V, 3), start [m]. faces: int32 (T, 3), numbered from 0 in x. density: mass per rest area [kg/m²].\n"
      "young: Young's modulus E times thickness [N/m]; poisson: ν [1]; μ = E/(2(1 + ν)), λ = Eν/(1 − ν²) (method.md "
      "§4.6).\n"
      "bending: k_b [J] (§4.7). friction: μ_c [1]. contact_stiffness: k_c [N/m]; two surfaces meet with the means.\n"
      "damping, bending_damping: k_d [s] (§4.9). membrane: stable_neo_hookean, st_venant_kirchhoff or none.\n"
      "bending_model: discrete_hinge, isometric_quadratic or none. rest: float32 (V, 3) [m], else x.\n"
      "velocities: float32 (V, 3) [m/s], else 0.\n\n"
      "TypeError: another dtype, shape, order or device. ValueError: a number out of range; start() checks the rest.");
  bound.def("add_fixed_body", &add_fixed_body, nb::arg("x").none(), nb::arg("faces").none(), nb::arg("friction") = 0.2,
            nb::arg("contact_stiffness") = 100.0, nb::arg("name") = nb::none(),
            nb::sig("def add_fixed_body(self, x: " OGC_GIVEN("float32", "(None, 3)") ", " OGC_FACES ", " OGC_MORE),
            "Adds a body that never moves and returns its ranges.\n\n"
            "x: float32 (V, 3) [m]. faces: int32 (T, 3). friction: μ_c [1]. contact_stiffness: k_c [N/m].");
  bound.def("add_moving_body", &add_moving_body, nb::arg("frames").none(), nb::arg("faces").none(),
            nb::arg("times") = nb::none(), nb::arg("friction") = 0.2, nb::arg("contact_stiffness") = 100.0,
            nb::arg("name") = nb::none(),
            nb::sig("def add_moving_body(self, frames: " OGC_GIVEN(
                "float32", "(None, None, 3)") ", " OGC_FACES
                                              ", times: " OGC_GIVEN("float64", "(None,)") " | None = None, " OGC_MORE),
            "Adds a body whose motion is given and returns its ranges.\n\n"
            "frames: float32 (F, V, 3), F ≥ 2 [m]; between two the vertices move along straight lines.\n"
            "times: float64 (F,), ascending [s]; without it one frame each step. faces: int32 (T, 3).");
}

std::array<double, 3> no_motion() { return {0, 0, 0}; }

void bind_motion(nb::class_<compare::Scene>& bound) {
  bound.def(
      "move",
      [](compare::Scene& scene, nb::handle vertices, const std::array<double, 3>& velocity, double angular_velocity,
         const std::array<double, 3>& axis, const std::array<double, 3>& centre, double begin, double end) {
        const auto moved = given<compare::Index>(vertices, {"vertices", "int32", "(n,)", 1});
        compare::PrescribedMotion motion;
        motion.name = "motion_" + std::to_string(scene.motions.size());
        motion.vertices.assign(moved.items.begin(), moved.items.end());
        motion.velocity = vector_of(velocity);
        motion.angular_velocity = angular_velocity;
        motion.axis = vector_of(axis);
        motion.centre = vector_of(centre);
        motion.start = begin;
        motion.end = end;
        scene.motions.push_back(std::move(motion));
      },
      nb::arg("vertices").none(), nb::arg("velocity") = no_motion(), nb::arg("angular_velocity") = 0.0,
      nb::arg("axis") = std::array<double, 3>{1, 0, 0}, nb::arg("centre") = no_motion(), nb::arg("begin") = 0.0,
      nb::arg("end") = 1e30,
      nb::sig("def move(self, vertices: " OGC_GIVEN(
          "int32",
          "(None,)") ", velocity: tuple[float, float, float] = "
                     "(0, 0, 0), angular_velocity: float = 0, axis: tuple[float, float, float] = (1, 0, 0), centre: "
                     "tuple[float, float, float] = (0, 0, 0), begin: float = 0, end: float = 1e30) -> None"),
      "Prescribes the motion of vertices: x(t) = R(ω(t − begin)) (x − centre) + centre + velocity (t − begin).\n\n"
      "vertices: int32 (n,), numbered in scene.positions; without further arguments they are held. velocity [m/s];\n"
      "angular_velocity: ω about axis, by the right-hand rule [rad/s]; before begin and after end [s] they rest.");
}

void bind_scene(nb::module_& module) {
  nb::class_<compare::Scene> bound(
      module, "Scene",
      "A scene of bodies, made of arrays.\n\n"
      "dt: h [s]. iterations: sweeps a step. radius: contact radius r [m]. gravity [m/s²]. Further settings by their\n"
      "names: Scene(..., bounds=\"planes\", friction_velocity=1e-3); scene.settings lists them. Arrays are copied "
      "into\n"
      "the scene. ValueError: an unknown setting or a bad value.");
  bound.def("__init__", &init_scene, nb::arg("dt"), nb::arg("iterations"), nb::arg("radius"),
            nb::arg("gravity") = std::array<double, 3>{0, -9.81, 0}, nb::arg("name") = "scene", nb::arg("settings"),
            nb::sig("def __init__(self, dt: float, iterations: int, radius: float, gravity: tuple[float, float, float] "
                    "= (0, -9.81, 0), name: str = 'scene', **settings: float | int | str) -> None"));
  bind_adders(bound);
  bind_motion(bound);
  bound
      .def(
          "start", &start, nb::arg("backend") = "cpu", nb::arg("bounds") = nb::none(), nb::arg("profile") = false,
          nb::arg("energies") = true,
          nb::sig("def start(self, backend: str = 'cpu', bounds: str | None = None, profile: bool = False, energies: "
                  "bool = True) -> Simulation"),
          "Starts a simulation of a copy of this scene.\n\n"
          "backend: \"cpu\" or \"cuda\". bounds: \"ball\", \"planes\", \"dat\" or \"off\"; without it the scene's. "
          "energies: whether\n"
          "steps report them. The start must be free of intersections: ogc_testbed.audit tells.\n\n"
          "ValueError: the scene is not valid; the message lists what to mend. RuntimeError: the backend is not there.")
      .def("worlds", &worlds_of_scene, nb::arg("count"), nb::arg("backend") = "cpu", nb::arg("energies") = true,
           nb::sig("def worlds(self, count: int, backend: str = 'cpu', energies: bool = True) -> Worlds"),
           "Starts so many copies of this scene that never see each other; ogc_testbed.worlds takes scenes that "
           "differ.\n\n"
           "ValueError: the scene is not valid, or count < 1. RuntimeError: the backend is not there, or has too "
           "little\n"
           "memory; the message says how many copies fit.")
      .def_prop_ro(
          "positions", [](const compare::Scene& scene) { return owned(to_single(scene.mesh.positions)); },
          nb::sig("def positions(self) -> " OGC_LENT("float32", "(None, 3)")),
          "float32 (V, 3): start of all bodies [m]")
      .def_prop_ro(
          "faces",
          [](nb::handle self) {
            const auto& rows = nb::cast<compare::Scene&>(self).mesh.triangles;
            nb::object borrowed = lent<compare::Index, 3>(rows.data(), rows.size(), self);
            return borrowed.attr("copy")();
          },
          nb::sig("def faces(self) -> " OGC_LENT("int32", "(None, 3)")), "int32 (T, 3): triangles of all bodies")
      .def_prop_ro(
          "bodies",
          [](const compare::Scene& scene) {
            nb::list all;
            for (std::size_t i = 0; i < scene.bodies.size(); ++i) all.append(body_of(scene, i));
            return all;
          },
          nb::sig("def bodies(self) -> list[Body]"), "all bodies, in order")
      .def_prop_ro(
          "settings",
          [](const compare::Scene& scene) {
            nb::dict all;
            for (const compare::SettingInfo& info : compare::setting_table())
              all[nb::cast(info.name)] = compare::setting_text(scene.settings, info);
            return all;
          },
          nb::sig("def settings(self) -> dict[str, str]"), "all settings by name, as text")
      .def(
          "set", [](compare::Scene& scene, const nb::kwargs& given) { set_all(scene.settings, given); },
          nb::arg("settings"), nb::sig("def set(self, **settings: float | int | str) -> None"),
          "Changes settings by name. ValueError: an unknown name (with the nearest known one) or a bad value.")
      .def_ro("name", &compare::Scene::name);
}

void bind_snapshot(nb::module_& module) {
  const auto rows = []<auto field>() {
    return [](nb::handle self) {
      const auto& all = nb::cast<Snapshot&>(self).*field;
      if constexpr (std::is_same_v<decltype(all), const std::vector<float>&>)
        return lent<float, 1>(all.data(), all.size(), self);
      else
        return lent<float, 3>(all.data(), all.size(), self);
    };
  };
  nb::class_<Snapshot>(module, "Snapshot", "A state of a simulation, and what its certificate needs. Read-only arrays.")
      .def_ro("step", &Snapshot::step, "number of the step that ended here")
      .def_ro("query_radius", &Snapshot::query_radius, "r_q of the last detection [m]")
      .def_prop_ro("positions", rows.operator()<&Snapshot::positions>(),
                   nb::sig("def positions(self) -> " OGC_LENT("float32", "(None, 3)")), "float32 (V, 3) [m]")
      .def_prop_ro("velocities", rows.operator()<&Snapshot::velocities>(),
                   nb::sig("def velocities(self) -> " OGC_LENT("float32", "(None, 3)")), "float32 (V, 3) [m/s]")
      .def_prop_ro("previous", rows.operator()<&Snapshot::previous>(),
                   nb::sig("def previous(self) -> " OGC_LENT("float32", "(None, 3)")),
                   "float32 (V, 3): X_prev, where contacts were detected last [m]")
      .def_prop_ro("bound", rows.operator()<&Snapshot::bounds>(),
                   nb::sig("def bound(self) -> " OGC_LENT("float32", "(None,)")),
                   "float32 (V,): b_v of the last detection (Eq. 21) [m]");
}

void bind_simulation(nb::module_& module) {
  nb::class_<Steps>(module, "Steps", "Yields the metrics of each step; Simulation.run returns it.")
      .def(
          "__iter__", [](nb::handle self) { return nb::borrow(self); }, nb::sig("def __iter__(self) -> Steps"))
      .def(
          "__next__", [](Steps& steps) { return steps(); }, nb::sig("def __next__(self) -> numpy.record"));
  nb::class_<Simulation>(module, "Simulation",
                         "A running simulation; its state stays where the backend computes. Scene.start makes it.")
      .def("advance", &advance, nb::arg("steps") = 1, nb::sig("def advance(self, steps: int = 1) -> numpy.recarray"),
           "Runs steps and returns their metrics, a structured array with one row each. Other Python threads run\n"
           "meanwhile; Ctrl-C ends the call after a frame.\n\n"
           "RuntimeError: a step failed; the last good state is kept, and `metrics` has the row.")
      .def("run", &run, nb::arg("seconds") = nb::none(), nb::arg("steps") = nb::none(), nb::arg("every") = 1,
           nb::sig("def run(self, seconds: float | None = None, steps: int | None = None, every: int = 1) -> Steps"),
           "Yields the metrics of each step of so many seconds, or steps; runs `every` steps at a time.")
      .def("snapshot", &snapshot_of, "Copies the state to the host.")
      .def(
          "restore",
          [](Simulation& simulation, const Snapshot& snapshot) {
            const nb::gil_scoped_release release;
            simulation.restore(snapshot);
          },
          nb::arg("snapshot"), "Goes on from a snapshot, to the same bits; `metrics` begins anew.")
      .def_prop_ro("positions", &view_of<StateField::positions>, nb::sig("def positions(self) -> StateView"),
                   "positions [m], not copied; valid until the next step or restore. positions.cpu() is a copy")
      .def_prop_ro("velocities", &view_of<StateField::velocities>, nb::sig("def velocities(self) -> StateView"),
                   "velocities [m/s], not copied; valid until the next step or restore. velocities.cpu() is a copy")
      .def_prop_ro(
          "metrics",
          [](const Simulation& simulation) {
            std::vector<compare::StepMetrics> rows;
            {
              const nb::gil_scoped_release release;
              rows = simulation.rows();
            }
            return table_of(rows);
          },
          nb::sig("def metrics(self) -> numpy.recarray"),
          "metrics of all steps since the start or the last restore, on the host: step, wall_ms [ms], "
          "vertex_facet_contacts,\n"
          "edge_edge_contacts, largest_lag [m], smallest_distance [m], energies [J] … as in steps.csv")
      .def_prop_ro(
          "faces",
          [](nb::handle self) {
            const auto& rows = nb::cast<Simulation&>(self).scene().mesh.triangles;
            return lent<compare::Index, 3>(rows.data(), rows.size(), self);
          },
          nb::sig("def faces(self) -> " OGC_LENT("int32", "(None, 3)")),
          "int32 (T, 3), read-only: triangles of all bodies")
      .def(
          "save",
          [](nb::handle self, nb::handle path, nb::handle frames) {
            nb::module_::import_("ogc_testbed.meshes").attr("save")(path, self, frames);
          },
          nb::arg("path"), nb::arg("frames") = nb::none(),
          nb::sig("def save(self, path: str | os.PathLike[str], frames: " OGC_GIVEN(
              "float32", "(None, None, 3)") " | None = None) -> None"),
          "Writes a .npz with positions, float32 (F, V, 3) [m], triangles, int32 (T, 3), and metrics, which ogc.load,\n"
          "numpy.load and `ogc audit` read. frames: states to write, np.stack of sim.positions.cpu(); without it the "
          "present "
          "one.\n\n"
          "ValueError: another kind of file. TypeError: frames of another dtype or shape.")
      .def_prop_ro("device", &Simulation::device, "\"2 threads\", or the device");
}

}  // namespace

void bind_scenes(nb::module_& module) {
  bind_bodies(module);
  bind_snapshot(module);
  bind_simulation(module);
  bind_scene(module);
  module.def(
      "scene",
      [](std::string_view name, std::string_view scale) {
        const nb::gil_scoped_release release;
        return experiments::make_scene(name, experiments::parse_scale(scale));
      },
      nb::arg("name"), nb::arg("scale") = "small",
      "Returns a built-in scene; scale: smoke (seconds), small (minutes on two cores) or paper.\n\n"
      "ValueError: an unknown name or scale; the message lists the known ones.");
  module.def(
      "scenes",
      [] {
        nb::dict all;
        for (const experiments::SceneInfo& info : experiments::scenes())
          all[nb::cast(info.name)] = nb::cast(info.summary);
        return all;
      },
      nb::sig("def scenes() -> dict[str, str]"), "Returns name and summary of each built-in scene.");
}

}  // namespace ogc::python

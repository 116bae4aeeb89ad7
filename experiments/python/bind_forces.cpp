// Binds forces of contacts for other people's solvers. Texts are for help() and the stubs.
#include <array>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nanobind/stl/string_view.h>

#include "compare/problem/error.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/text.hpp"
#include "experiments/python/arrays.hpp"
#include "experiments/python/contacts.hpp"
#include "experiments/python/guard.hpp"
#include "experiments/python/module.hpp"
#include "fast/contact_forces.hpp"

namespace ogc::python {
namespace {

using compare::Vec3f;

compare::ContactActivation parse_activation(std::string_view name) {
  constexpr auto& names = compare::choice_names<compare::ContactActivation>;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<compare::ContactActivation>(i);
  throw compare::InputError(compare::unknown_name("activation", name, names));
}

/// Energies, and arrays of forces and blocks, by vertex.
struct ContactForceSums {
  fast::ContactEnergy energy;
  nb::object force, friction, block;
};

/// Forces of the contacts of one mesh; several threads may call it, one after the other is served.
class ContactForces {
 public:
  ContactForces(const fast::Mesh& mesh, std::span<const Vec3f> rest, const fast::ContactForceOptions& options,
                fast::Backend backend, std::span<const compare::Index> colours)
      : backend_(backend), rest_(rest.begin(), rest.end()), forces_(mesh, rest, options, backend, colours) {}

  Place place() const { return backend_ == fast::Backend::cuda ? Place::either : Place::host; }
  const fast::Mesh& mesh() const { return forces_.mesh(); }
  const fast::ContactForceOptions& options() const { return forces_.options(); }

  /// Finds contacts at x and keeps them. A guard of our own does it, because it takes positions from everywhere and
  /// keeps them; nothing depends on what it proves. It begins at the rest positions, which are on the host.
  void find(std::span<const Vec3f> x, bool is_there) {
    const std::lock_guard lock(busy_);
    const float r = options().contact_radius;
    if (!found_) found_.emplace(mesh(), rest_, fast::GuardOptions{.contact_radius = r, .query_radius = r}, backend_);
    is_there ? found_->reset_resident(x.data()) : found_->reset(x);
  }

  /// Calls evaluate(forces, contacts) with the contacts of a guard, or without one with those of the last `find`.
  template <class Evaluate>
  void with_contacts(Guard* guard, const Evaluate& evaluate) {
    const std::lock_guard lock(busy_);
    const auto use = [&](const fast::Guard& with) {
      evaluate(forces_, fast::FoundContacts{with.contacts(), with.detected_at_resident()});
    };
    if (guard != nullptr) {
      expect_like(*guard);
      guard->lend(use);
    } else if (found_) {
      use(*found_);
    } else {
      throw compare::InputError("contacts: none were found: call find(x) first, or pass guard=");
    }
  }

 private:
  void expect_like(const Guard& guard) const {
    if (&guard.mesh().topology() != &mesh().topology())
      throw compare::InputError("guard: it has another Mesh object: make both with the same one");
    if (guard.backend() != backend_)
      throw compare::InputError("guard: it has another backend: make both with the same one");
    const auto text = [](float r) { return compare::shortest(compare::as_typed(static_cast<double>(r))); };
    if (guard.radius() != options().contact_radius)
      throw compare::InputError("guard: its radius is " + text(guard.radius()) + ", but that of the forces is " +
                                text(options().contact_radius) + ": make it with this radius");
  }

  fast::Backend backend_;
  std::vector<Vec3f> rest_;
  fast::ContactForces forces_;
  std::optional<fast::Guard> found_;
  std::mutex busy_;
};

void init_forces(ContactForces* self, const Mesh& mesh, nb::handle rest, double radius, double contact_stiffness,
                 double friction, double friction_velocity, std::string_view activation, nb::handle colours,
                 std::string_view backend) {
  const Given<Vec3f> positions = given_positions(rest, "rest");
  Given<compare::Index> numbers;
  if (!colours.is_none()) numbers = given<compare::Index>(colours, {"colours", "int32", "(V,)", 1});
  const fast::Backend chosen = usable_backend(backend);
  const fast::ContactForceOptions options{.contact_radius = static_cast<float>(radius),
                                          .contact_stiffness = static_cast<float>(contact_stiffness),
                                          .friction = static_cast<float>(friction),
                                          .friction_velocity = friction_velocity,
                                          .contact_activation = parse_activation(activation)};
  expect_vertices("rest", positions.items.size(), mesh.mesh());
  if (!colours.is_none()) expect_vertices("colours", numbers.items.size(), mesh.mesh());
  const nb::gil_scoped_release release;
  new (self) ContactForces(mesh.mesh(), positions.items, options, chosen, numbers.items);
}

void find(ContactForces& forces, nb::handle x) {
  const Given<Vec3f> positions = given_positions(x, "x", forces.place());
  expect_vertices("x", positions.items.size(), forces.mesh());
  const nb::gil_scoped_release release;
  with_names_of_python([&] { forces.find(positions.items, is_on_device(positions.array)); });
}

/// Returns an array of float32 (V, 6) of the library of x: torch's, or one that its type makes, as CuPy's does.
nb::object blocks_like(nb::handle x, std::size_t count) {
  const nb::tuple shape = nb::make_tuple(count, 6);
  if (nb::hasattr(x, "new_empty")) return x.attr("new_empty")(shape);
  return x.type()(shape, nb::arg("dtype") = x.attr("dtype"));
}

/// Returns the arrays on the device to which results are written: those of `out`, or new ones.
std::array<nb::object, 3> device_outputs(nb::handle x, const nb::object& out, std::size_t count) {
  if (out.is_none()) return {output_like(x, true, count), output_like(x, true, count), blocks_like(x, count)};
  if (!nb::isinstance<nb::tuple>(out) || nb::len(out) != 3)
    throw nb::type_error("out: a tuple of three arrays is needed: force (V, 3), friction (V, 3), block (V, 6)");
  return {out[0], out[1], out[2]};
}

ContactForceSums evaluate_there(ContactForces& forces, nb::handle x, const Given<Vec3f>& positions,
                                const fast::SlidingResident& sliding, Guard* guard, const nb::object& out) {
  const std::size_t count = positions.items.size();
  const auto arrays = device_outputs(x, out, count);
  const auto written = [&](std::size_t k, const char* name, const char* shape, std::size_t columns) {
    Output output = checked_output(arrays[k], {name, "float32", shape, 2, columns, Place::device});
    expect_vertices(name, output.shape(0), forces.mesh());
    return output;
  };
  const Output force = written(0, "force", "(V, 3)", 3), friction = written(1, "friction", "(V, 3)", 3),
               block = written(2, "block", "(V, 6)", 6);
  const fast::ContactForceArrays to{static_cast<Vec3f*>(force.data()), static_cast<Vec3f*>(friction.data()),
                                    static_cast<fast::ContactBlock*>(block.data())};
  fast::ContactEnergy energy;
  {
    const nb::gil_scoped_release release;
    with_names_of_python([&] {
      forces.with_contacts(guard, [&](fast::ContactForces& of, const fast::FoundContacts& contacts) {
        energy = of.evaluate_resident(contacts, positions.items.data(), sliding, to);
      });
    });
  }
  return {energy, arrays[0], arrays[1], arrays[2]};
}

ContactForceSums evaluate(ContactForces& forces, nb::handle x, nb::handle start, double dt, Guard* guard,
                          const nb::object& out) {
  const Given<Vec3f> positions = given_positions(x, "x", forces.place());
  expect_vertices("x", positions.items.size(), forces.mesh());
  const bool is_there = is_on_device(positions.array);
  Given<Vec3f> begin;
  if (!start.is_none()) {
    begin = given_positions(start, "start", is_there ? Place::device : Place::host);
    expect_vertices("start", begin.items.size(), forces.mesh());
  }
  if (is_there) return evaluate_there(forces, x, positions, {begin.items.data(), dt}, guard, out);
  if (!out.is_none()) throw nb::type_error("out: only for arrays on a device; on the host results are new arrays");
  fast::ContactForceSums sums;
  {
    const nb::gil_scoped_release release;
    with_names_of_python([&] {
      forces.with_contacts(guard, [&](fast::ContactForces& of, const fast::FoundContacts& contacts) {
        sums = of.evaluate(contacts, positions.items, {begin.items, dt});
      });
    });
  }
  return {sums.energy, owned(std::move(sums.force)), owned(std::move(sums.friction)), owned(std::move(sums.block))};
}

void bind_sums(nb::module_& module) {
  using Sums = ContactForceSums;
  nb::class_<Sums>(module, "ContactForceSums",
                   "Energy, forces and blocks of contacts. Arrays are NumPy's, or those of the library of x if x is on "
                   "a device.")
      .def_prop_ro(
          "energy", [](const Sums& sums) { return sums.energy.total(); }, "Σ e_k g(d) over all contacts [J]")
      .def_prop_ro(
          "energy_vertex_facet", [](const Sums& sums) { return sums.energy.vertex_facet; },
          "the part of vertex-facet contacts [J]")
      .def_prop_ro(
          "energy_edge_edge", [](const Sums& sums) { return sums.energy.edge_edge; },
          "the part of edge-edge contacts [J]")
      .def_ro("force", &Sums::force, nb::sig("def force(self) -> typing.Any"),
              "float32 (V, 3): force of contacts and friction together [N]")
      .def_ro("friction", &Sums::friction, nb::sig("def friction(self) -> typing.Any"),
              "float32 (V, 3): force of friction alone [N]; zeros without start")
      .def_ro("block", &Sums::block, nb::sig("def block(self) -> typing.Any"),
              "float32 (V, 6): the symmetric 3×3 block of each vertex, xx, xy, xz, yy, yz, zz [N/m]")
      .def("__repr__", [](const Sums& sums) {
        return "ContactForceSums: energy " + compare::shortest(sums.energy.total()) + " J";
      });
}

}  // namespace

#define OGC_VECTORS OGC_GIVEN("float32", "(None, 3)")

void bind_forces(nb::module_& module) {
  bind_sums(module);
  nb::class_<ContactForces>(
      module, "ContactForces",
      "Energy, forces and blocks of contacts and friction for any solver, as the sweep of the simulation has them "
      "(method.md §4.2-4.4).\n\n"
      "rest: float32 (V, 3), on the host: positions with the rest lengths of edges, which soften contacts of nearly\n"
      "parallel edges [m]. radius: r > 0 [m]. contact_stiffness: k_c > 0 [N/m]. friction: μ ≥ 0 [1].\n"
      "friction_velocity: ε_v > 0; slower sliding has less friction than μ λ [m/s].\n"
      "activation: \"ogc\", \"ogc_as_printed\", \"quadratic\", \"ipc_log\" or \"cubic\".\n"
      "colours: int32 (V,), ≥ 0; vertices with the same number are updated together, which enlarges their blocks.\n"
      "Without it each vertex is updated alone; zeros are for solvers that update all at once.\n\n"
      "TypeError: another dtype, shape, order or device. ValueError: a number out of range.")
      .def("__init__", &init_forces, nb::arg("mesh"), nb::arg("rest").none(), nb::arg("radius"),
           nb::arg("contact_stiffness"), nb::arg("friction") = 0.0, nb::arg("friction_velocity") = 0.01,
           nb::arg("activation") = "ogc", nb::arg("colours") = nb::none(), nb::arg("backend") = "cpu",
           nb::sig("def __init__(self, mesh: Mesh, rest: " OGC_VECTORS
                   ", radius: float, contact_stiffness: float, friction: float = 0.0, friction_velocity: float = 0.01, "
                   "activation: str = 'ogc', colours: " OGC_GIVEN(
                       "int32", "(None,)") " | None = None, backend: str = 'cpu') -> None"))
      .def("find", &find, nb::arg("x").none(), nb::sig("def find(self, x: " OGC_VECTORS ") -> None"),
           "Finds the contacts with d < r at x and keeps them until the next find.\n\n"
           "x: float32 (V, 3), on the host or, for \"cuda\", also on a device [m]. A solver with a Guard needs no "
           "find.")
      .def(
          "evaluate", &evaluate, nb::arg("x").none(), nb::arg("start") = nb::none(), nb::arg("dt") = 0.0,
          nb::arg("guard") = nb::none(), nb::arg("out") = nb::none(),
          nb::sig("def evaluate(self, x: " OGC_VECTORS ", start: " OGC_VECTORS
                  " | None = None, dt: float = 0.0, guard: Guard | None = None, out: tuple | None = None) -> "
                  "ContactForceSums"),
          "Returns energy, forces and blocks at x, of the contacts of the last find.\n\n"
          "x: float32 (V, 3), on the host or, for \"cuda\", also on a device [m]; coordinates on a device are not\n"
          "checked. start, dt: positions at the start of the step, where x is, and the time step > 0 [s], for\n"
          "friction; without start there is none. guard: contacts are those of this guard's last detection; it needs\n"
          "the same mesh, backend and radius. out: for x on a device, a tuple of arrays that receive force, friction\n"
          "and block. A contact that x has left (d ≥ r) has no force, and one that x enters is missing until the next\n"
          "find. The same input gives the same bits.\n\n"
          "ValueError: no contacts were found, a coordinate is not finite, or dt is out of range.");
}

}  // namespace ogc::python

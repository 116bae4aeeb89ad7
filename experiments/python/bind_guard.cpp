// Binds the guard of other people's solvers. Texts are for help() and the stubs.
#include <optional>
#include <span>
#include <string>
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

namespace ogc::python {
namespace {

using compare::Vec3f;

compare::Bounds parse_bounds(std::string_view name) {
  constexpr auto& names = compare::choice_names<compare::Bounds>;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<compare::Bounds>(i);
  throw compare::InputError(compare::unknown_name("bounds", name, names));
}

void init_guard(Guard* self, const Mesh& mesh, nb::handle x, double query_radius, std::string_view bounds,
                double radius, double relaxation, double detection_fraction, std::string_view backend) {
  const Given<Vec3f> positions = given_positions(x, "x");
  const fast::Backend chosen = usable_backend(backend);
  const fast::GuardOptions options{static_cast<float>(radius), static_cast<float>(query_radius), parse_bounds(bounds),
                                   static_cast<float>(relaxation), detection_fraction};
  const nb::gil_scoped_release release;
  with_names_of_python([&] { return new (self) Guard(mesh.mesh(), positions.items, options, chosen); });
}

nb::object step(Guard& guard, nb::handle x, nb::handle dx, nb::object out) {
  const Given<Vec3f> positions = given_positions(x, "x", guard.place());
  const bool is_there = is_on_device(positions.array);
  const Place place = is_there ? Place::device : Place::host;
  const Given<Vec3f> moves = given_positions(dx, "dx", place);
  if (out.is_none()) out = output_like(x, is_there, positions.items.size());
  const Output output = checked_output(out, {"out", "float32", "(V, 3)", 2, 3, place});
  auto* written = static_cast<Vec3f*>(output.data());
  expect_vertices("x", positions.items.size(), guard.mesh());
  expect_vertices("dx", moves.items.size(), guard.mesh());
  expect_vertices("out", output.shape(0), guard.mesh());
  {
    const nb::gil_scoped_release release;
    with_names_of_python([&] {
      if (is_there)
        guard.step_on_device(positions.items.data(), moves.items.data(), written);
      else
        guard.step(positions.items, moves.items, {written, positions.items.size()});
    });
  }
  return out;
}

void bind_report(nb::module_& module) {
  using fast::GuardReport;
  nb::class_<GuardReport>(module, "GuardReport",
                          "What a step of a guard did. p is a vertex's proposal x + dx, s the guard's state before the "
                          "step, x the state after it; sums are over all vertices.")
      .def_ro("cut", &GuardReport::cut, "number of vertices with x ≠ p")
      .def_ro("not_finite", &GuardReport::not_finite,
              "number of vertices whose proposal is not finite; they stay (only arrays on a device can have them)")
      .def_ro("detected", &GuardReport::detected, "whether the step began with a detection")
      .def_ro("asked", &GuardReport::asked, "Σ ‖p − s‖ [m]")
      .def_ro("lost", &GuardReport::lost, "Σ ‖p − x‖ over Σ ‖p − s‖ [1]; 0 if nothing was asked")
      .def_ro("lost_normal", &GuardReport::lost_normal, "part of lost along the normal of what cut the vertex [1]")
      .def_ro("lost_tangential", &GuardReport::lost_tangential, "part of lost across that normal [1]")
      .def_ro("most_restricted", &GuardReport::most_restricted, "vertex with the largest ‖p − x‖; −1 if none was cut")
      .def_ro("most_lost", &GuardReport::most_lost, "its ‖p − x‖ [m]")
      .def("__repr__", [](const GuardReport& report) {
        return "GuardReport: " + std::to_string(report.cut) + " vertices cut, " + compare::shortest(report.lost) +
               " of the motion lost" + (report.detected ? ", after a detection" : "");
      });
}

}  // namespace

#define OGC_VECTORS OGC_GIVEN("float32", "(None, 3)")

void bind_guard(nb::module_& module) {
  bind_report(module);
  nb::class_<Guard>(
      module, "Guard",
      "Keeps the moves of any solver free of intersections: the solver proposes x + dx, the guard "
      "returns how far vertices may go.\n\n"
      "x: float32 (V, 3), on the host, |x| ≤ 2^30, free of intersections [m] (ogc_testbed.audit tells).\n"
      "query_radius: r_q from 2^-40 to 2^20, range of the search; no vertex moves farther than γ_p r_q\n"
      "between two detections [m].\n"
      "bounds: \"planes\" or \"ball\" (method.md §5.6). radius: r of contacts, 0 or from 2^-40 to r_q [m].\n"
      "relaxation: γ_p in (0, 0.5).\n"
      "detection_fraction: γ_e in [0, 1]; a step detects once so large a share of vertices was cut.\n\n"
      "Every returned state and the straight way to it from the state before are proved free of\n"
      "intersections, whatever moves come. A vertex moves only if its proposal does.\n"
      "TypeError: another dtype, shape, order or device. ValueError: a number out of range.")
      .def("__init__", &init_guard, nb::arg("mesh"), nb::arg("x").none(), nb::arg("query_radius"),
           nb::arg("bounds") = "planes", nb::arg("radius") = 0.0, nb::arg("relaxation") = 0.45,
           nb::arg("detection_fraction") = 0.01, nb::arg("backend") = "cpu",
           nb::sig("def __init__(self, mesh: Mesh, x: " OGC_VECTORS ", query_radius: float, bounds: str = 'planes', "
                   "radius: float = 0.0, relaxation: float = 0.45, detection_fraction: float = 0.01, backend: str = "
                   "'cpu') -> None"))
      .def(
          "step", &step, nb::arg("x").none(), nb::arg("dx").none(), nb::arg("out") = nb::none(),
          nb::sig("def step(self, x: " OGC_VECTORS ", dx: " OGC_VECTORS ", out: " OGC_VECTORS
                  " | None = None) -> typing.Any"),
          "Moves each vertex to x + dx, or as near to it as its region allows, and returns the new state.\n\n"
          "x, dx: float32 (V, 3), both on the host or, for \"cuda\", both on a device [m]. out: where the result is\n"
          "written, also x or dx; without it a new array. What the arrays' library has enqueued on its current stream\n"
          "is waited for (DLPack's stream), and the result is complete on return, so any stream may go on with it.\n\n"
          "ValueError: a coordinate on the host is not finite; the state is as before.")
      .def(
          "reset",
          [](Guard& guard, nb::handle x) {
            const Given<Vec3f> positions = given_positions(x, "x", guard.place());
            expect_vertices("x", positions.items.size(), guard.mesh());
            const nb::gil_scoped_release release;
            with_names_of_python([&] { guard.reset(positions.items, is_on_device(positions.array)); });
          },
          nb::arg("x").none(), nb::sig("def reset(self, x: " OGC_VECTORS ") -> None"),
          "Forgets the state and begins anew at x, which must be free of intersections [m].")
      .def("detect", &Guard::detect, nb::call_guard<nb::gil_scoped_release>(),
           "Detects at the guard's state: each vertex has the whole region about it again.")
      .def_prop_ro(
          "positions",
          [](nb::handle self) {
            auto& guard = nb::cast<Guard&>(self);
            return StateView{nb::borrow(self),      &guard,
                             StateField::positions, compare::at(guard.mesh().vertex_count()),
                             guard.device_number(), guard.version()};
          },
          nb::sig("def positions(self) -> StateView"),
          "the guard's state [m], not copied; valid until the next step or reset. positions.cpu() is a copy")
      .def_prop_ro(
          "report", [](const Guard& guard) { return guard.report(); }, nb::sig("def report(self) -> GuardReport"),
          "what the last step did")
      .def_prop_ro(
          "lost", [](const Guard& guard) { return guard.report().lost; },
          "share of the proposed motion that the last step took away [1]")
      .def_prop_ro(
          "most_restricted", [](const Guard& guard) { return guard.report().most_restricted; },
          "the vertex that lost most in the last step; −1 if none was cut");
}

}  // namespace ogc::python

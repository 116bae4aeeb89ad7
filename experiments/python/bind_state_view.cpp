// Binds views of states. Texts are for help() and the stubs.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "experiments/python/arrays.hpp"
#include "experiments/python/module.hpp"
#include "experiments/python/state_view.hpp"

namespace ogc::python {
namespace {

/// Returns the rows for others to read; waits while another thread uses the owner.
const compare::Vec3f* rows_of(const StateView& view) {
  const nb::gil_scoped_release release;
  return view.state->lend_rows(view.field, view.version);
}

nb::object exported(const StateView& view, const nb::kwargs& options) {
  const compare::Vec3f* rows = rows_of(view);
  const nb::object array = view.device < 0 ? lent_on_host<float, 3>(rows, view.count, view.owner)
                                           : lent_on_device<float, 3>(rows, view.count, view.owner, view.device);
  return array.attr("__dlpack__")(**options);
}

nb::object as_numpy(const StateView& view, nb::handle dtype, std::optional<bool> copy) {
  if (view.device >= 0)
    throw nb::type_error(
        "this view is on a CUDA device; call view.cpu() for a copy on the host, or read it there: "
        "torch.from_dlpack(view), cupy.from_dlpack(view)");
  nb::object array = lent<float, 3>(rows_of(view), view.count, view.owner);
  const bool is_cast = !dtype.is_none() &&
                       !nb::module_::import_("numpy").attr("dtype")(dtype).equal(array.attr("dtype"));
  if (is_cast && copy == false) throw nb::value_error("copy=False: the view is float32, another dtype is a copy");
  if (is_cast || copy == true) array = array.attr("astype")(dtype.is_none() ? array.attr("dtype") : nb::borrow(dtype));
  return array;
}

nb::object copied(const StateView& view) {
  std::vector<compare::Vec3f> rows;
  {
    const nb::gil_scoped_release release;
    rows = view.state->copy_rows(view.field, view.version);
  }
  return owned(std::move(rows));
}

}  // namespace

void bind_state_view(nb::module_& module) {
  nb::class_<StateView>(
      module, "StateView",
      "Rows of the state of a Simulation or a Guard, float32 (V, 3), read-only, in the memory where it computes.\n\n"
      "Nothing is copied: numpy.asarray(view) on the host, torch.from_dlpack(view) and others on a device are arrays\n"
      "in that memory, which keep the owner alive. The numbers are complete, so any stream may read them without\n"
      "waiting. A later call that overwrites them first waits for the work that the device has by then. From then on\n"
      "the view refuses to be read (BufferError), and arrays made of it hold other numbers. view.cpu() is a copy.\n"
      "Do not write to arrays on a device: DLPack's flag for read-only memory is not set, since not all libraries\n"
      "accept it.")
      .def("__dlpack__", &exported, nb::arg("options"),
           nb::sig("def __dlpack__(self, *, stream: typing.Any = None, max_version: tuple[int, int] | None = None, "
                   "dl_device: tuple[int, int] | None = None, copy: bool | None = None) -> typing.Any"),
           "DLPack. BufferError: a later call has overwritten the state, or a copy or another device is asked for.")
      .def(
          "__dlpack_device__",
          [](const StateView& view) {
            return view.device < 0 ? nb::make_tuple(nb::device::cpu::value, 0)
                                   : nb::make_tuple(nb::device::cuda::value, view.device);
          },
          nb::sig("def __dlpack_device__(self) -> tuple[int, int]"), "DLPack: where the rows are")
      .def(
          "__array__", &as_numpy, nb::arg("dtype") = nb::none(), nb::arg("copy") = nb::none(),
          nb::sig("def __array__(self, dtype: typing.Any = None, copy: bool | None = None) -> "
                  "numpy.typing.NDArray[typing.Any]"),
          "NumPy: the rows where they lie. BufferError: a later call has overwritten the state. TypeError: they are on "
          "a device.")
      .def("cpu", &copied, nb::sig("def cpu(self) -> " OGC_LENT("float32", "(None, 3)")),
           "Copies the rows to a new array on the host. BufferError: a later call has overwritten the state.")
      .def("__len__", [](const StateView& view) { return view.count; })
      .def_prop_ro(
          "shape", [](const StateView& view) { return nb::make_tuple(view.count, 3); },
          nb::sig("def shape(self) -> tuple[int, int]"), "(V, 3)")
      .def_prop_ro(
          "device",
          [](const StateView& view) { return view.device < 0 ? nb::none() : nb::object(nb::int_(view.device)); },
          nb::sig("def device(self) -> int | None"), "number of the CUDA device; None: the rows are on the host")
      .def("__repr__", [](const StateView& view) {
        return "StateView of float32 (" + std::to_string(view.count) + ", 3) on " +
               (view.device < 0 ? "the host" : "CUDA device " + std::to_string(view.device)) +
               (view.version == view.state->version() ? "" : ", overwritten");
      });
}

}  // namespace ogc::python

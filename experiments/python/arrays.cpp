#include "experiments/python/arrays.hpp"

#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <utility>

#include "compare/problem/error.hpp"
#include "experiments/python/exchange.hpp"
#include "experiments/python/state_view.hpp"

namespace ogc::python {
namespace {

/// Returns NumPy's name of a dtype, "float64".
std::string name_of(nb::dlpack::dtype dtype) {
  if (dtype.lanes != 1) return "another dtype";
  const std::string bits = std::to_string(dtype.bits);
  using Code = nb::dlpack::dtype_code;
  const auto code = static_cast<Code>(dtype.code);
  if (code == Code::Int) return "int" + bits;
  if (code == Code::UInt) return "uint" + bits;
  if (code == Code::Float) return "float" + bits;
  if (code == Code::Bfloat) return "bfloat" + bits;
  if (code == Code::Complex) return "complex" + bits;
  return code == Code::Bool ? "bool" : "another dtype";
}

/// Returns str(value); what UTF-8 can't encode is written as an escape.
std::string text_of(nb::handle value) {
  const nb::bytes text = nb::steal<nb::bytes>(
      PyUnicode_AsEncodedString(nb::str(value).ptr(), "utf-8", "backslashreplace"));
  if (!text.is_valid()) throw nb::python_error();
  return {text.c_str(), text.size()};
}

std::string type_of(nb::handle value) { return text_of(value.type().attr("__name__")); }

/// Returns " of >f4" for an array whose dtype DLPack does not have; nothing where there is no dtype.
std::string of_dtype(nb::handle value) {
  try {
    return nb::hasattr(value, "dtype") ? " of " + text_of(value.attr("dtype")) : "";
  } catch (const nb::python_error&) {
    return "";
  }
}

/// The library that an array is of, by its type.
enum class Library { numpy, torch, cupy, other };

Library library_of(nb::handle value) {
  const std::string module = text_of(value.type().attr("__module__"));
  if (module.starts_with("numpy")) return Library::numpy;
  if (module.starts_with("torch")) return Library::torch;
  if (module.starts_with("cupy")) return Library::cupy;
  return Library::other;
}

/// Returns the call that casts the argument.
std::string cast_of(Library library, const Wanted& wanted) {
  const std::string name = wanted.name, dtype = wanted.dtype;
  switch (library) {
    case Library::numpy: return name + ".astype(np." + dtype + ")";
    case Library::torch: return name + ".to(torch." + dtype + ")";
    case Library::cupy: return name + ".astype(cp." + dtype + ")";
    case Library::other: break;
  }
  return "np.asarray(" + name + ", dtype=np." + dtype + ")";
}

/// Returns the call that lays the argument out in C order.
std::string order_of(Library library, const Wanted& wanted) {
  const std::string name = wanted.name;
  switch (library) {
    case Library::numpy: return "np.ascontiguousarray(" + name + ")";
    case Library::torch: return name + ".contiguous()";
    case Library::cupy: return "cp.ascontiguousarray(" + name + ")";
    case Library::other: break;
  }
  return "np.ascontiguousarray(" + name + ")";
}

/// Returns the call that copies the argument to the host or to a device.
std::string copy_of(Library library, const Wanted& wanted) {
  const std::string name = wanted.name;
  const bool to_device = wanted.place == Place::device;
  switch (library) {
    case Library::torch: return name + (to_device ? ".cuda()" : ".cpu()");
    case Library::cupy: return "cp.asnumpy(" + name + ")";
    case Library::numpy:
      if (to_device) return "torch.from_numpy(" + name + ").cuda() or cp.asarray(" + name + ")";
      break;
    case Library::other: break;
  }
  return std::string("a copy on ") + (to_device ? "a CUDA device" : "the host");
}

std::string place_of(Place place) {
  switch (place) {
    case Place::host: return "on the host";
    case Place::device: return "on a CUDA device";
    case Place::either: break;
  }
  return "on the host or a CUDA device";
}

template <class Offered>
std::string shape_of(const Offered& array) {
  std::string text = "(";
  for (std::size_t i = 0; i < array.ndim(); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(static_cast<std::int64_t>(array.shape(i)));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

std::string dtypes_of(const Wanted& wanted) {
  return wanted.dtype + (wanted.other_dtype == nullptr ? "" : " or " + std::string(wanted.other_dtype));
}

[[noreturn]] void refuse(const Wanted& wanted, const std::string& came, const std::string& remedy) {
  const std::string text = std::string(wanted.name) + ": " + dtypes_of(wanted) + " " + wanted.shape + " in C order " +
                           place_of(wanted.place) + " is needed, but " + came + " came; pass " + remedy;
  throw nb::type_error(text.c_str());
}

/// Throws for a value that offers no array that DLPack or the buffer protocol can describe.
[[noreturn]] void refuse_no_array(nb::handle value, const Wanted& wanted) {
  if (nb::hasattr(value, "requires_grad") && nb::object(value.attr("requires_grad")).is(nb::bool_(true)))
    refuse(wanted, "a tensor that requires a gradient", std::string(wanted.name) + ".detach()");
  refuse(wanted, "a value of type " + type_of(value) + of_dtype(value), cast_of(library_of(value), wanted));
}

template <class Offered>
bool is_c_order(const Offered& array) {
  if (array.size() == 0) return true;
  std::int64_t step = 1;
  for (std::size_t i = array.ndim(); i-- > 0;) {
    if (array.shape(i) > 1 && array.stride(i) != step) return false;
    step *= static_cast<std::int64_t>(array.shape(i));
  }
  return true;
}

/// Returns whether the tensor can be one: no length is negative or beyond our numbers of rows, and its numbers lie
/// somewhere, at an address that is a multiple of their size.
template <class Offered>
bool is_sound(const Offered& array) {
  for (std::size_t i = 0; i < array.ndim(); ++i)
    if (array.shape(i) > static_cast<std::size_t>(std::numeric_limits<compare::Index>::max())) return false;
  return array.size() == 0 || array.data() != nullptr;
}

template <class Offered>
bool is_aligned(const Offered& array) {
  return reinterpret_cast<std::uintptr_t>(array.data()) % array.itemsize() == 0;
}

bool is_cuda(int device_type) {
  return device_type == nb::device::cuda::value || device_type == nb::device::cuda_managed::value;
}

/// Returns whether an object says by DLPack that it lies in the memory of a CUDA device.
bool says_cuda(nb::handle value) {
  if (!nb::hasattr(value.type(), "__dlpack_device__")) return false;
  try {
    return is_cuda(nb::cast<int>(value.attr("__dlpack_device__")()[0]));
  } catch (const std::exception&) {  // nonsense, or an exception of the object's: the array itself will say where it is
    return false;
  }
}

/// Returns the capsule that an object's __dlpack__ makes; none if it raises. stream=1 is CUDA's legacy default stream,
/// with which our streams synchronise: the object makes it wait for the stream that writes the array. Without the
/// argument torch makes no stream wait.
nb::object capsule_of(nb::handle value) {
  nb::dict options;
  if (says_cuda(value)) options["stream"] = 1;
  nb::dict newer = nb::steal<nb::dict>(PyDict_Copy(options.ptr()));
  newer["max_version"] = nb::make_tuple(1, 0);
  const nb::object export_it = value.attr("__dlpack__");
  try {
    return export_it(**newer);
  } catch (const nb::python_error& error) {
    if (!error.matches(PyExc_TypeError)) return nb::none();
  }
  try {
    return export_it(**options);  // the answer of producers from before DLPack 1
  } catch (const nb::python_error&) {
    return nb::none();
  }
}

/// Returns what nanobind shall read: a capsule of DLPack, or a memoryview, because nanobind reads the strides of a
/// buffer without asking whether there are any, and ctypes gives none; none if the object offers neither.
nb::object source_of(nb::handle value) {
  if (PyCapsule_CheckExact(value.ptr())) return nb::borrow(value);
  // Why a view of our own refuses, its user must know.
  if (nb::isinstance<StateView>(value)) return value.attr("__dlpack__")(nb::arg("max_version") = nb::make_tuple(1, 0));
  if (nb::hasattr(value.type(), "__dlpack__") && !nb::isinstance<nb::type_object>(value)) {
    for (nb::object (*const ask)(nb::handle) : {exchanged, capsule_of}) {
      nb::object capsule = ask(value);
      if (PyCapsule_CheckExact(capsule.ptr())) return capsule;
    }
  }
  nb::object view = nb::steal(PyMemoryView_FromObject(value.ptr()));
  if (view.is_valid()) return view;
  PyErr_Clear();
  return nb::none();
}

/// Returns whether `value` offers an array of this kind, and the array.
template <class Offered>
bool offers(nb::handle value, Offered& array) {
  const nb::object source = source_of(value);
  return !source.is_none() && nb::try_cast(source, array, false) && array.is_valid();
}

/// Throws TypeError unless the array that `value` offers is the wanted one.
template <class Offered>
void check(nb::handle value, const Offered& array, const Wanted& wanted) {
  const auto refuse_this = [&](const std::string& how, std::string (*remedy)(Library, const Wanted&)) {
    refuse(wanted, name_of(array.dtype()) + " " + shape_of(array) + how, remedy(library_of(value), wanted));
  };
  const std::string dtype = name_of(array.dtype());
  if (dtype != wanted.dtype && (wanted.other_dtype == nullptr || dtype != wanted.other_dtype)) refuse_this("", cast_of);
  if (!is_sound(array) || array.ndim() != wanted.dimensions ||
      (wanted.columns != 0 && array.shape(array.ndim() - 1) != wanted.columns))
    refuse_this("", [](Library, const Wanted& one) { return "an array of shape " + std::string(one.shape); });
  const bool is_there = is_cuda(array.device_type());
  const bool is_on_host = array.device_type() == nb::device::cpu::value ||
                          array.device_type() == nb::device::cuda_host::value;
  if (wanted.place == Place::device ? !is_there : wanted.place == Place::host ? !is_on_host : !is_there && !is_on_host)
    refuse_this(is_on_host ? " on the host" : " on a device", copy_of);
  if (!is_c_order(array)) refuse_this(" in another order", order_of);
  if (!is_aligned(array))
    refuse_this(" at an odd address", [](Library, const Wanted& one) { return std::string(one.name) + ".copy()"; });
}

}  // namespace

bool is_on_device(const Array& array) { return is_cuda(array.device_type()); }

Array checked(nb::handle value, const Wanted& wanted) {
  Array array;
  if (!offers(value, array)) refuse_no_array(value, wanted);
  check(value, array, wanted);
  return array;
}

Output checked_output(nb::handle value, const Wanted& wanted) {
  if (nb::isinstance<StateView>(value)) refuse(wanted, "a StateView, which is read-only,", "an array of your own");
  Output array;
  if (!offers(value, array)) {
    checked(value, wanted);
    refuse(wanted, "a read-only array", "one that can be written");
  }
  check(value, array, wanted);
  return array;
}

bool is_double(const Array& array) { return name_of(array.dtype()) == "float64"; }

namespace {

/// Returns a NumPy array of float32 that owns these rows.
template <class Row>
nb::object owned_rows(std::vector<Row>&& rows) {
  auto all = std::make_unique<std::vector<Row>>(std::move(rows));
  auto* data = static_cast<float*>(static_cast<void*>(all->data()));
  const std::size_t count = all->size();
  const nb::capsule owner(all.release(), [](void* gone) noexcept { delete static_cast<std::vector<Row>*>(gone); });
  return nb::cast(nb::ndarray<nb::numpy, float, nb::ndim<2>>(data, {count, sizeof(Row) / sizeof(float)}, owner),
                  nb::rv_policy::reference);
}

}  // namespace

nb::object owned(std::vector<compare::Vec3f>&& rows) { return owned_rows(std::move(rows)); }
nb::object owned(std::vector<std::array<float, 6>>&& rows) { return owned_rows(std::move(rows)); }

nb::object output_like(nb::handle x, bool is_there, std::size_t count) {
  if (!is_there) return owned(std::vector<compare::Vec3f>(count));
  if (text_of(x.type().attr("__module__")).starts_with("warp")) return nb::module_::import_("warp").attr("clone")(x);
  for (const char* method : {"clone", "copy"})
    if (nb::hasattr(x, method)) return x.attr(method)();
  throw nb::type_error(("out: a " + type_of(x) + " can't be copied here; give an array to write to").c_str());
}

void translate_errors() {
  nb::register_exception_translator([](const std::exception_ptr& error, void*) {
    try {
      std::rethrow_exception(error);
    } catch (const compare::InputError& wrong) {
      PyErr_SetString(PyExc_ValueError, wrong.what());
    } catch (const compare::ResourceError& missing) {
      PyErr_SetString(PyExc_RuntimeError, missing.what());
    }
  });
}

}  // namespace ogc::python

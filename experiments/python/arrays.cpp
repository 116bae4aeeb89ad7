#include "experiments/python/arrays.hpp"

#include <exception>
#include <memory>
#include <utility>

#include "compare/problem/error.hpp"

namespace ogc::python {
namespace {

/// Returns NumPy's name of a dtype, "float64".
std::string name_of(nb::dlpack::dtype dtype) {
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

std::string text_of(nb::handle value) { return nb::str(value).c_str(); }

std::string type_of(nb::handle value) { return text_of(value.type().attr("__name__")); }

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

std::string shape_of(const Array& array) {
  std::string text = "(";
  for (std::size_t i = 0; i < array.ndim(); ++i) text += (i == 0 ? "" : ", ") + std::to_string(array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

[[noreturn]] void refuse(const Wanted& wanted, const std::string& came, const std::string& remedy) {
  const std::string text = std::string(wanted.name) + ": " + wanted.dtype + " " + wanted.shape + " in C order " +
                           place_of(wanted.place) + " is needed, but " + came + " came; pass " + remedy;
  throw nb::type_error(text.c_str());
}

/// Throws for a value that offers no array that DLPack or the buffer protocol can describe.
[[noreturn]] void refuse_no_array(nb::handle value, const Wanted& wanted) {
  const Library library = library_of(value);
  if (nb::hasattr(value, "requires_grad") && nb::cast<bool>(value.attr("requires_grad")))
    refuse(wanted, "a tensor that requires a gradient", std::string(wanted.name) + ".detach()");
  const std::string dtype = nb::hasattr(value, "dtype") ? " of " + text_of(value.attr("dtype")) : "";
  refuse(wanted, "a value of type " + type_of(value) + dtype, cast_of(library, wanted));
}

bool is_c_order(const Array& array) {
  if (array.size() == 0) return true;
  std::int64_t step = 1;
  for (std::size_t i = array.ndim(); i-- > 0;) {
    if (array.shape(i) > 1 && array.stride(i) != step) return false;
    step *= static_cast<std::int64_t>(array.shape(i));
  }
  return true;
}

}  // namespace

bool is_on_device(const Array& array) {
  return array.device_type() == nb::device::cuda::value || array.device_type() == nb::device::cuda_managed::value;
}

Array checked(nb::handle value, const Wanted& wanted) {
  Array array;
  if (!nb::try_cast(value, array, false) || !array.is_valid()) refuse_no_array(value, wanted);
  const auto refuse_this = [&](const std::string& how, std::string (*remedy)(Library, const Wanted&)) {
    refuse(wanted, name_of(array.dtype()) + " " + shape_of(array) + how, remedy(library_of(value), wanted));
  };
  if (name_of(array.dtype()) != wanted.dtype) refuse_this("", cast_of);
  if (array.ndim() != wanted.dimensions || (wanted.columns != 0 && array.shape(array.ndim() - 1) != wanted.columns))
    refuse_this("", [](Library, const Wanted& one) { return "an array of shape " + std::string(one.shape); });
  const bool is_there = is_on_device(array);
  const bool is_on_host = array.device_type() == nb::device::cpu::value ||
                          array.device_type() == nb::device::cuda_host::value;
  if (wanted.place == Place::device ? !is_there : wanted.place == Place::host ? !is_on_host : !is_there && !is_on_host)
    refuse_this(is_on_host ? " on the host" : " on a device", copy_of);
  if (!is_c_order(array)) refuse_this(" in another order", order_of);
  return array;
}

void* checked_output(nb::handle value, const Wanted& wanted) {
  checked(value, wanted);
  nb::ndarray<> array;
  if (!nb::try_cast(value, array, false) || !array.is_valid())
    refuse(wanted, "a read-only array", "one that can be written");
  return array.data();
}

bool has_dtype(nb::handle value, const char* dtype) {
  Array array;
  return nb::try_cast(value, array, false) && array.is_valid() && name_of(array.dtype()) == dtype;
}

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
  return x.attr(nb::hasattr(x, "clone") ? "clone" : "copy")();
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

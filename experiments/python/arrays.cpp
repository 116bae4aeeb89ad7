#include "experiments/python/arrays.hpp"

#include <exception>

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
  if (wanted.is_on_device)
    return library == Library::torch ? name + ".cuda()" : "torch.from_numpy(" + name + ").cuda()";
  switch (library) {
    case Library::torch: return name + ".cpu()";
    case Library::cupy: return "cp.asnumpy(" + name + ")";
    case Library::numpy:
    case Library::other: break;
  }
  return "a copy on the host, " + name + ".numpy()";
}

std::string shape_of(const Array& array) {
  std::string text = "(";
  for (std::size_t i = 0; i < array.ndim(); ++i) text += (i == 0 ? "" : ", ") + std::to_string(array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

[[noreturn]] void refuse(const Wanted& wanted, const std::string& came, const std::string& remedy) {
  const std::string text = std::string(wanted.name) + ": " + wanted.dtype + " " + wanted.shape + " in C order " +
                           (wanted.is_on_device ? "on a CUDA device" : "on the host") + " is needed, but " + came +
                           " came; pass " + remedy;
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

Array checked(nb::handle value, const Wanted& wanted) {
  Array array;
  if (!nb::try_cast(value, array, false) || !array.is_valid()) refuse_no_array(value, wanted);
  const Library library = library_of(value);
  const std::string dtype = name_of(array.dtype()), what = dtype + " " + shape_of(array);
  if (dtype != wanted.dtype) refuse(wanted, what, cast_of(library, wanted));
  if (array.ndim() != wanted.dimensions || (wanted.columns != 0 && array.shape(array.ndim() - 1) != wanted.columns))
    refuse(wanted, what, "an array of shape " + std::string(wanted.shape));
  const bool is_on_device = array.device_type() == nb::device::cuda::value;
  const bool is_on_host = array.device_type() == nb::device::cpu::value;
  if (wanted.is_on_device ? !is_on_device : !is_on_host)
    refuse(wanted, what + (is_on_host ? " on the host" : " on a device"), copy_of(library, wanted));
  if (!is_c_order(array)) refuse(wanted, what + " in another order", order_of(library, wanted));
  return array;
}

bool has_dtype(nb::handle value, const char* dtype) {
  Array array;
  return nb::try_cast(value, array, false) && array.is_valid() && name_of(array.dtype()) == dtype;
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

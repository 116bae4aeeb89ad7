#include "experiments/python/exchange.hpp"

#include <cstdint>

#include <nanobind/ndarray.h>

namespace ogc::python {
namespace {

namespace nb = nanobind;

/// The layouts of dlpack.h of version 1.
struct Version {
  std::uint32_t major, minor;
};
struct ManagedTensor {
  Version version;
  void* context;
  void (*deleter)(ManagedTensor*);
  std::uint64_t flags;
  nb::dlpack::dltensor tensor;
};
struct ExchangeApi {
  Version version;
  const void* older;
  void (*allocate)();
  int (*give)(void* object, ManagedTensor** tensor);  ///< synchronises no stream; 0, or a Python error is set
  void (*take)();
  void (*show)();
  int (*current_stream)(std::int32_t device_type, std::int32_t device, void** stream);
};

constexpr const char *api_name = "dlpack_exchange_api", *tensor_name = "dltensor_versioned";

/// Returns the interface that the type of an array offers; null if there is none of a version that is known here.
const ExchangeApi* api_of(nb::handle value) {
  const nb::object capsule = nb::getattr(value.type(), "__dlpack_c_exchange_api__", nb::none());
  if (PyCapsule_IsValid(capsule.ptr(), api_name) == 0) return nullptr;
  const auto* api = static_cast<const ExchangeApi*>(PyCapsule_GetPointer(capsule.ptr(), api_name));
  return api->version.major == 1 ? api : nullptr;
}

/// Returns whether __dlpack__ would refuse the tensor, and says why; the C interface does not.
bool has_gradient(nb::handle value) { return nb::getattr(value, "requires_grad", nb::none()).is(nb::bool_(true)); }

void let_go(PyObject* capsule) {
  if (PyCapsule_IsValid(capsule, tensor_name) == 0) return;  // a reader has taken the tensor
  auto* tensor = static_cast<ManagedTensor*>(PyCapsule_GetPointer(capsule, tensor_name));
  if (tensor->deleter != nullptr) tensor->deleter(tensor);
}

/// Returns whether work on CUDA's legacy default stream comes after all that the tensor's library has enqueued.
bool is_in_order(const ExchangeApi& api, const nb::dlpack::device& device) {
  const bool is_cuda = device.device_type == nb::device::cuda::value ||
                       device.device_type == nb::device::cuda_managed::value;
  if (!is_cuda) return true;
  void* stream = nullptr;
  if (api.current_stream(device.device_type, device.device_id, &stream) != 0) {
    PyErr_Clear();
    return false;
  }
  return stream == nullptr;
}

}  // namespace

nb::object exchanged(nb::handle value) {
  const ExchangeApi* api = api_of(value);
  if (api == nullptr || has_gradient(value)) return nb::none();
  ManagedTensor* tensor = nullptr;
  if (api->give(value.ptr(), &tensor) != 0 || tensor == nullptr) {
    PyErr_Clear();
    return nb::none();
  }
  const nb::object capsule = nb::steal(PyCapsule_New(tensor, tensor_name, let_go));
  if (!capsule.is_valid()) {
    if (tensor->deleter != nullptr) tensor->deleter(tensor);
    throw nb::python_error();
  }
  return is_in_order(*api, tensor->tensor.device) ? capsule : nb::none();
}

}  // namespace ogc::python

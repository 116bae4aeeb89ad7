// Implements device memory by the CUDA driver's interface, so that a host build can judge a CUDA plug-in, too. The few
// needed functions are declared by hand; they have not changed since CUDA 4. The context is the primary one, which the
// plug-in's runtime library uses.
#include <dlfcn.h>

#include <cstring>
#include <stdexcept>
#include <string>

#include "experiments/plugins/memory.hpp"

namespace ogc::experiments {

namespace {

using DevicePointer = unsigned long long;

/// Holds the functions of libcuda.so.1 that are needed; each returns 0 or an error number.
struct Driver {
  int (*init)(unsigned) = nullptr;
  int (*device_get)(int*, int) = nullptr;
  int (*retain)(void**, int) = nullptr;
  int (*set_current)(void*) = nullptr;
  int (*synchronize)() = nullptr;
  int (*allocate)(DevicePointer*, std::size_t) = nullptr;
  int (*free)(DevicePointer) = nullptr;
  int (*to_device)(DevicePointer, const void*, std::size_t) = nullptr;
  int (*to_host)(void*, DevicePointer, std::size_t) = nullptr;
  int (*error_name)(int, const char**) = nullptr;

  Driver() {
    void* const library = dlopen("libcuda.so.1", RTLD_NOW);
    if (!library)
      throw std::runtime_error("it asks for device memory, and there is no NVIDIA driver here (libcuda.so.1)");
    find(library, "cuInit", init);
    find(library, "cuDeviceGet", device_get);
    find(library, "cuDevicePrimaryCtxRetain", retain);
    find(library, "cuCtxSetCurrent", set_current);
    find(library, "cuCtxSynchronize", synchronize);
    find(library, "cuMemAlloc_v2", allocate);
    find(library, "cuMemFree_v2", free);
    find(library, "cuMemcpyHtoD_v2", to_device);
    find(library, "cuMemcpyDtoH_v2", to_host);
    find(library, "cuGetErrorName", error_name);
    void* context = nullptr;
    int device = 0;
    check(init(0), "the device can't be used");
    check(device_get(&device, 0), "the device can't be used");
    check(retain(&context, device), "the device can't be used");
    check(set_current(context), "the device can't be used");
  }

  void check(int error, const char* what) const {
    if (error == 0) return;
    const char* name = nullptr;
    error_name(error, &name);
    throw std::runtime_error(std::string(what) + ": " + (name ? name : "CUDA error " + std::to_string(error)));
  }

 private:
  template <class Function>
  static void find(void* library, const char* name, Function& function) {
    void* const symbol = dlsym(library, name);
    if (!symbol)
      throw std::runtime_error(std::string("the NVIDIA driver here lacks ") + name + "; a newer one is needed");
    std::memcpy(&function, &symbol, sizeof symbol);
  }
};

class DeviceMemory final : public PluginMemory {
 public:
  ~DeviceMemory() override {
    try {
      release();
    } catch (const std::runtime_error&) {  // a device that reports an error when the process ends
    }
  }

  const void* input(Bytes content) override {
    const DevicePointer at = take(content.size());
    inputs_.push_back(at);
    if (!content.empty())
      driver_.check(driver_.to_device(at, content.data(), content.size()), "copying to the device failed");
    return reinterpret_cast<const void*>(at);
  }

  void* output(std::size_t bytes, std::size_t unit) override {
    const Output output{take(bytes + 2 * guard_bytes), bytes};
    outputs_.push_back(output);
    const std::vector<std::byte> zone = pattern(guard_bytes, 4), fill = pattern(bytes, unit);
    put(output.base, zone);
    put(output.base + guard_bytes, fill);
    put(output.base + guard_bytes + bytes, zone);
    return reinterpret_cast<void*>(output.base + guard_bytes);
  }

  void synchronize() override { driver_.check(driver_.synchronize(), "the device reports an error"); }

  Damage damage(std::size_t k) override {
    const Output& output = outputs_[k];
    const std::vector<std::byte> zone = pattern(guard_bytes, 4);
    if (get(output.base, guard_bytes) != zone) return Damage::before;
    return get(output.base + guard_bytes + output.bytes, guard_bytes) == zone ? Damage::none : Damage::behind;
  }

  std::vector<std::byte> content(std::size_t k, std::size_t bytes) override {
    return get(outputs_[k].base + guard_bytes, bytes);
  }

  void release() override {
    for (const DevicePointer at : inputs_) driver_.check(driver_.free(at), "freeing device memory failed");
    for (const Output& output : outputs_) driver_.check(driver_.free(output.base), "freeing device memory failed");
    inputs_.clear();
    outputs_.clear();
  }

  bool can_go_on() override { return driver_.synchronize() == 0; }

 private:
  struct Output {
    DevicePointer base;
    std::size_t bytes;
  };
  DevicePointer take(std::size_t bytes) {
    DevicePointer at = 0;
    driver_.check(driver_.allocate(&at, bytes > 0 ? bytes : 1), "device memory is not to be had");
    return at;
  }
  void put(DevicePointer at, const std::vector<std::byte>& bytes) {
    if (!bytes.empty())
      driver_.check(driver_.to_device(at, bytes.data(), bytes.size()), "copying to the device failed");
  }
  std::vector<std::byte> get(DevicePointer at, std::size_t bytes) {
    std::vector<std::byte> copy(bytes);
    if (bytes > 0) driver_.check(driver_.to_host(copy.data(), at, bytes), "copying from the device failed");
    return copy;
  }
  Driver driver_;
  std::vector<DevicePointer> inputs_;
  std::vector<Output> outputs_;
};

}  // namespace

std::unique_ptr<PluginMemory> device_memory() { return std::make_unique<DeviceMemory>(); }

}  // namespace ogc::experiments

// A correct plug-in on the device: the kernel of activation.cpp over arrays that already lie in device memory
// (OGC_DEVICE_MEMORY).
//
//   nvcc -O2 -std=c++17 -shared -Xcompiler -fPIC -I INCLUDE activation.cu -o activation_cuda.so
//   ogc compare activation --plugin ./activation_cuda.so --backend cuda
//
// --backend selects the backend whose time is printed beside yours.
#include "compare/plugin.h"

OGC_PLUGIN("activation example, CUDA", OGC_DEVICE_MEMORY)

namespace {

// Holds g, g' and g'' of one case; d < r.
struct Activation {
  float energy, slope, curvature;
};

// Returns the activation of Eq. 18 with its two branches; `inner` is k'_c. At d = tau the quadratic branch holds. No
// term squares d, because d squared could underflow.
__device__ Activation two_stages(float d, float r, float k, float tau, float inner) {
  if (d >= tau) return {0.5f * k * (r - d) * (r - d), -k * (r - d), k};
  return {0.5f * k * (r - tau) * (r - tau) + inner * logf(tau / d), -inner / d, inner / d / d};
}

__device__ Activation activation_at(int64_t kind, float d, float r, float k) {
  const float tau = 0.5f * r, depth = r - d, share = depth / d, slope = 2 * k / r;
  switch (kind) {
    case OGC_ACTIVATION_OGC_AS_PRINTED: return two_stages(d, r, k, tau, tau * k * (tau - r) * (tau - r));
    case OGC_ACTIVATION_QUADRATIC: return {0.5f * k * depth * depth, -k * depth, k};
    case OGC_ACTIVATION_IPC_LOG: {  // log1p, because r/d approaches 1
      const float log = log1pf(share);
      return {k * depth * (depth * log), -k * depth * (2 * log + share), k * (2 * log + share * (4 + share))};
    }
    case OGC_ACTIVATION_CUBIC: return {slope / 3 * depth * depth * depth, -slope * depth * depth, 2 * slope * depth};
    default: return two_stages(d, r, k, tau, tau * k * (r - tau));
  }
}

__global__ void activation(ogc_activation_in in, ogc_activation_out out) {
  const int64_t i = blockIdx.x * int64_t{blockDim.x} + threadIdx.x;
  if (i >= in.n) return;
  const float d = in.distance[i], r = in.contact_radius[i];
  const Activation g = d < r ? activation_at(in.activation[i], d, r, in.stiffness[i]) : Activation{};
  out.energy[i] = g.energy;
  out.slope[i] = g.slope;
  out.curvature[i] = g.curvature;
}

}  // namespace

int ogc_activation(const ogc_activation_in* in, ogc_activation_out* out) {
  constexpr unsigned threads = 256;
  const auto blocks = static_cast<unsigned>((in->n + threads - 1) / threads);
  // both structures are in host memory; the launch copies them as arguments
  if (blocks > 0) activation<<<blocks, threads>>>(*in, *out);
  return cudaGetLastError();
}

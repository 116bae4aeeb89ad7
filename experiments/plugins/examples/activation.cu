// A correct plug-in on the device: the kernel of activation.cpp over arrays that already lie in device memory (OGC_DEVICE_MEMORY).
//
//   nvcc -O2 -std=c++17 -shared -Xcompiler -fPIC -I INCLUDE activation.cu -o activation_cuda.so
//   ogc compare activation --plugin ./activation_cuda.so --backend cuda
//
// --backend says whose time is printed beside yours.
#include "compare/plugin.h"

OGC_PLUGIN("activation example, CUDA", OGC_DEVICE_MEMORY)

namespace {

__global__ void activation(ogc_activation_in in, ogc_activation_out out) {
  const int64_t i = blockIdx.x * int64_t{blockDim.x} + threadIdx.x;
  if (i >= in.n) return;
  const float d = in.distance[i], r = in.contact_radius[i], k = in.stiffness[i], tau = 0.5f * r;
  float energy = 0, slope = 0, curvature = 0;
  if (d < r && d >= tau) {  // the quadratic part holds at d = tau, too
    energy = 0.5f * k * (r - d) * (r - d);
    slope = -k * (r - d);
    curvature = k;
  } else if (d < tau) {
    const float inner = tau * k * (r - tau);
    energy = 0.5f * k * (r - tau) * (r - tau) + inner * logf(tau / d);
    slope = -inner / d;
    curvature = inner / d / d;  // d squared could underflow
  }
  out.energy[i] = energy;
  out.slope[i] = slope;
  out.curvature[i] = curvature;
}

}  // namespace

int ogc_activation(const ogc_activation_in* in, ogc_activation_out* out) {
  constexpr unsigned threads = 256;
  const auto blocks = static_cast<unsigned>((in->n + threads - 1) / threads);
  if (blocks > 0) activation<<<blocks, threads>>>(*in, *out);  // the two structures are in host memory, and are copied as arguments
  return cudaGetLastError();
}

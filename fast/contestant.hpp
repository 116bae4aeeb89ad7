// The fast path as a contestant: single precision, as fast as the machine allows.
#pragma once

#include <string>

#include "compare/problem/contestant.hpp"

namespace ogc::fast {

enum class Backend { cpu, cuda };

/// All stages that the backend has. Throws compare::ResourceError for Backend::cuda where the program was built without CUDA, or where no usable
/// device is found, and says which.
compare::Contestant contestant(Backend backend);

/// Whether the program was built with the backend, and whether it can run here; the reason where it can't.
struct BackendInfo {
  bool built = false, usable = false;
  std::string description;  ///< "2 threads", "NVIDIA H200, CUDA 13.0", or why not
};
BackendInfo backend_info(Backend backend);

/// What one iteration of the sweep has to do on a scene, whatever the machine: operations counted in the kernels' source, bytes if each array is moved once
/// (fast/work.cpp says how both are counted).
struct SweepWork {
  int vertices = 0, colours = 0;              ///< free vertices
  double flop = 0, bytes = 0;                 ///< without contacts
  double flop_vertex_facet = 0, flop_edge_edge = 0, bytes_contact = 0;  ///< of a contact more, all of whose vertices are free
};
SweepWork sweep_work(const compare::Scene& scene);

}  // namespace ogc::fast

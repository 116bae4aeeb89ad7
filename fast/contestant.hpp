// The fast path as a contestant: single precision, as fast as the machine allows.
#pragma once

#include <span>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::fast {

enum class Backend { cpu, cuda };

/// How the launches on a device are cut. No answer depends on it, which tests of determinism try out: with it one
/// device launches as another would.
struct LaunchShape {
  int block_threads = 128;  ///< of launches that are one thread an item, or searches of a warp: 32, 64, 96 or 128
  int multiprocessors = 0;  ///< that a launch reckons with; 0: those of the device
};

/// All stages that the backend has. Throws compare::ResourceError for Backend::cuda where the program was built without
/// CUDA, or where no usable device is found, and says which.
compare::Contestant contestant(Backend backend, const LaunchShape& shape = {});

/// Whether the program was built with the backend, and whether it can run here; the reason where it can't.
struct BackendInfo {
  bool built = false, usable = false;
  std::string description;  ///< "2 threads", "NVIDIA H200, CUDA 13.0", or why not
};
BackendInfo backend_info(Backend backend);

/// What one iteration of the sweep has to do on a scene, whatever the machine: operations counted in the kernels'
/// source, bytes if each array is moved once (fast/work.cpp says how both are counted).
struct SweepWork {
  int vertices = 0, colours = 0;  ///< free vertices
  double flop = 0, bytes = 0;     ///< without contacts
  /// of a contact more, all of whose vertices are free
  double flop_vertex_facet = 0, flop_edge_edge = 0, bytes_contact = 0;
};
SweepWork sweep_work(const compare::Scene& scene);

/// What the searches of one detection have to do at a state, counted by carrying them out on the host, one after the
/// other, with the functors of both backends. A device that shares them out finds some distances later, so its searches
/// open a few nodes more. Refit, lists and bounds are not in it.
struct SearchWork {
  double nodes = 0;       ///< of four boxes, opened
  double candidates = 0;  ///< primitives that searches were offered
  double distances = 0;   ///< pairs that no cheaper test could reject: double-precision distances
  /// bytes of nodes, candidates and distances as often as they are read: from the cache at best
  double flop = 0, bytes = 0;
};
/// `query_radius`: r_q [m]. Throws std::invalid_argument where there are not as many positions as vertices.
SearchWork search_work(const compare::Scene& scene, std::span<const compare::Vec3f> positions, float query_radius);

}  // namespace ogc::fast

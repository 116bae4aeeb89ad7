// The fast path as a contestant: single precision, as fast as the machine allows.
#pragma once

#include <span>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::fast {

/// What computes: the host's threads, or one CUDA device.
enum class Backend { cpu, cuda };

/// How launches are divided into blocks. No answer depends on it; tests of determinism let one device launch as another
/// would.
struct LaunchShape {
  int block_threads = 128;  ///< of launches that are one thread an item, or searches of a warp: 32, 64, 96 or 128
  int multiprocessors = 0;  ///< that a launch reckons with; 0: those of the device
};

/// All stages that the backend has. Throws compare::ResourceError for Backend::cuda where the program was built without
/// CUDA, or where no usable device is found, and says which.
compare::Contestant contestant(Backend backend, const LaunchShape& shape = {});

/// Whether the program was built with the backend, and whether it can run here; the reason where it can't.
struct BackendInfo {
  bool built = false, usable = false;  ///< compiled in; and found on this machine
  std::string description;             ///< "2 threads", "NVIDIA H200, CUDA 13.0", or why not
};
/// Of this program on this machine.
BackendInfo backend_info(Backend backend);

/// The work of one iteration of the sweep on any machine: operations counted in the kernels' source, bytes if each
/// array is moved once (fast/work.cpp says how).
struct SweepWork {
  int vertices = 0, colours = 0;  ///< free vertices
  double flop = 0, bytes = 0;     ///< without contacts
  /// of a contact more, all of whose vertices are free
  double flop_vertex_facet = 0, flop_edge_edge = 0, bytes_contact = 0;
};
/// Of a scene at rest.
SweepWork sweep_work(const compare::Scene& scene);

/// The work of the searches of one detection, counted while the host carries them out one after the other with the
/// functors of both backends. Parallel searches learn some distances later and open a few nodes more. Refit, lists and
/// bounds are not counted.
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

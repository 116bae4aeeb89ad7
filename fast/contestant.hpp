// Offers the fast path as a contestant: single precision, as fast as the machine allows.
#pragma once

#include <span>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::fast {

/// Selects what computes: the host's threads, or one CUDA device.
enum class Backend { cpu, cuda };

/// Says how launches are divided into blocks. No result depends on it; tests of determinism let one device launch as
/// another would.
struct LaunchShape {
  int block_threads = 128;  ///< of launches with one thread an item, or of searches by warps: 32, 64, 96 or 128
  int multiprocessors = 0;  ///< multiprocessors that a launch counts on; 0: those of the device
};

/// Returns a contestant with all stages that the backend has. Throws compare::ResourceError for Backend::cuda if the
/// program was built without CUDA, or if no usable device is found, and says which.
compare::Contestant contestant(Backend backend, const LaunchShape& shape = {});

/// Tells whether the program was built with the backend, and whether it can run here; if it can't, the reason.
struct BackendInfo {
  bool built = false, usable = false;  ///< compiled in; and found on this machine
  std::string description;             ///< "2 threads", "NVIDIA H200, CUDA 13.0", or why not
};
/// Returns the information on a backend of this program on this machine.
BackendInfo backend_info(Backend backend);

/// The work of one iteration of the sweep on any machine: operations counted in the kernels' source, and bytes if each
/// array is moved once (fast/work.cpp explains the counting).
struct SweepWork {
  int vertices = 0, colours = 0;  ///< `vertices`: free ones
  double flop = 0, bytes = 0;     ///< without contacts
  /// for each further contact, if all of its vertices are free
  double flop_vertex_facet = 0, flop_edge_edge = 0, bytes_contact = 0;
};
/// Returns the work for a scene at rest.
SweepWork sweep_work(const compare::Scene& scene);

/// The work of the searches of one detection, counted while the host carries them out one after the other with the
/// functors of both backends. Parallel searches learn some distances later and open a few nodes more. Refit, lists and
/// bounds are not counted.
struct SearchWork {
  double nodes = 0;       ///< opened nodes, of four boxes each
  double candidates = 0;  ///< primitives that searches were offered
  double distances = 0;   ///< pairs that no cheaper test could reject: double-precision distances
  /// `bytes`: of nodes, candidates and distances, counted each time they are read; a cache serves most of them
  double flop = 0, bytes = 0;
};
/// Returns the work of the searches at these positions; `query_radius`: r_q [m]. Throws std::invalid_argument if there
/// are not as many positions as vertices.
SearchWork search_work(const compare::Scene& scene, std::span<const compare::Vec3f> positions, float query_radius);

}  // namespace ogc::fast

// Offers the fast path as a contestant: single precision, as fast as the machine allows.
#pragma once

#include <span>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::fast {

/// Selects where to compute: on the host's threads, or on one CUDA device.
enum class Backend { cpu, cuda };

/// Sets how work is divided. No result depends on it. Tests of determinism use it to launch on one
/// device with the shape of another device.
struct LaunchShape {
  /// threads of a block: 32, 64, 96 or 128; teams, scans and sorts have other sizes
  int block_threads = 128;
  int multiprocessors = 0;  ///< multiprocessors for which launches are divided; 0: those of the device
  /// devices that divide a simulation (Contestant::start); on the host, parts that divide it. Stages use one
  int devices = 1;
};

/// Returns a contestant with all stages that the backend has. For Backend::cuda, throws compare::ResourceError if the
/// program was built without CUDA or finds no usable device; the message says which.
compare::Contestant contestant(Backend backend, const LaunchShape& shape = {});

/// Tells whether the program was built with the backend, and whether the backend can run here.
struct BackendInfo {
  bool built = false, usable = false;  ///< built into the program; found on this machine
  std::string description;             ///< "2 threads", "NVIDIA H200, CUDA 13.0", or the reason why it cannot run
};
/// Returns the information on a backend of this program on this machine.
BackendInfo backend_info(Backend backend);

/// The work of one iteration of the sweep: operations counted in the kernels' source, and bytes if each array is moved
/// once. A machine cannot avoid these in any order of work. `launches`, `warp_instructions` and `sector_bytes` are what
/// the teams and colours of a device cannot avoid (fast/work.cpp explains all counts).
struct SweepWork {
  int vertices = 0, launches = 0;                  ///< `vertices`: free vertices
  double flop = 0, bytes = 0;                      ///< without contacts
  double warp_instructions = 0, sector_bytes = 0;  ///< without contacts
  /// work that each contact adds if all of its vertices are free; `bytes_contact` adds to `bytes` and `sector_bytes`
  double flop_vertex_facet = 0, flop_edge_edge = 0, bytes_contact = 0;
  double warp_instructions_vertex_facet = 0, warp_instructions_edge_edge = 0;
};
/// Returns the work for a scene at rest. `multiprocessors` of the device decide its teams; an H200 has 132.
SweepWork sweep_work(const compare::Scene& scene, int multiprocessors = 132);

/// The work of the searches of one detection. The host counts it while it runs the searches one after the other with
/// the kernels of both backends. Parallel searches learn some distances later and open a few more nodes. Refit, lists
/// and bounds are not counted.
struct SearchWork {
  double nodes = 0;       ///< nodes opened; each has four boxes
  double candidates = 0;  ///< primitives that leaves offered to searches
  double distances = 0;   ///< pairs that needed a distance in double precision, because no cheaper test rejected them
  /// `bytes`: bytes of the nodes, candidates and distances, counted at each read, although a cache serves most reads
  double flop = 0, bytes = 0;
};
/// Returns the work of the searches at these positions; `query_radius`: r_q [m]. Throws std::invalid_argument if there
/// are not as many positions as vertices.
SearchWork search_work(const compare::Scene& scene, std::span<const compare::Vec3f> positions, float query_radius);

}  // namespace ogc::fast

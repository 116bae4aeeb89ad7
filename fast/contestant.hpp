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

}  // namespace ogc::fast

// Identifies this program. The build rewrites the file with these data whenever the commit changes (version.cmake). A
// program therefore never names the older commit at which its build folder was configured.
#pragma once

#include <string>

namespace ogc::experiments {

/// Holds the versions of the sources and tools from which this program was built.
struct BuildInfo {
  std::string version;   ///< "0.1.0"
  std::string commit;    ///< commit of the checkout; "unknown" outside a checkout
  bool dirty = false;    ///< the checkout had uncommitted changes
  std::string compiler;  ///< "GNU 12.2.0"
  std::string cuda;      ///< version of the CUDA toolkit; "none" without CUDA
};

/// Returns the data, which the file written by version.cmake contains.
BuildInfo build_info();

/// Returns the output of `ogc --version`: these data and, for each backend, its device or the reason why it is not
/// usable.
std::string version_text();

}  // namespace ogc::experiments

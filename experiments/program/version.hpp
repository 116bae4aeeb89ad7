// Identifies this program. The build rewrites the file with these data whenever the commit changes (version.cmake), so
// that a program never names the commit of the day on which its build folder was configured.
#pragma once

#include <string>

namespace ogc::experiments {

/// Holds the sources and tools from which this program was built.
struct BuildInfo {
  std::string version;   ///< "0.1.0"
  std::string commit;    ///< of the checkout that was built; "unknown" outside one
  bool dirty = false;    ///< the checkout had changes that are not committed
  std::string compiler;  ///< "GNU 12.2.0"
  std::string cuda;      ///< version of the CUDA toolkit; "none" if it was left out
};

/// Returns the data; the file that version.cmake writes defines it.
BuildInfo build_info();

/// Returns what `ogc --version` prints: these data, and for each backend its device or the reason why it is not usable.
std::string version_text();

}  // namespace ogc::experiments

// Which program this is. The data come from a file that the build writes anew whenever the commit changes
// (version.cmake), so that a program never names the commit of the day on which its build folder was configured.
#pragma once

#include <string>

namespace ogc::experiments {

/// What this program was made from, and with what.
struct BuildInfo {
  std::string version;   ///< "0.1.0"
  std::string commit;    ///< of the checkout that was built; "unknown" outside one
  bool dirty = false;    ///< the checkout had changes that are not committed
  std::string compiler;  ///< "GNU 12.2.0"
  std::string cuda;      ///< version of the CUDA toolkit; "none" where it was left out
};

/// Defined in the file that version.cmake writes.
BuildInfo build_info();

/// What `ogc --version` prints: the above, and each backend with where it would run, or why it can't.
std::string version_text();

}  // namespace ogc::experiments

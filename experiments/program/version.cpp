#include "experiments/program/version.hpp"

#include "fast/contestant.hpp"

namespace ogc::experiments {

namespace {

std::string backend_line(const std::string& name, fast::Backend backend) {
  const fast::BackendInfo info = fast::backend_info(backend);
  const std::string state = !info.built ? "not built" : info.usable ? "usable" : "built, not usable here";
  return "  " + name + ": " + state + (info.description.empty() ? "" : " (" + info.description + ")") + "\n";
}

}  // namespace

std::string version_text() {
  const BuildInfo info = build_info();
  return "OGC Testbed " + info.version + "\ncommit " + info.commit +
         (info.dirty ? " (dirty: with changes that are not committed)" : "") + "\ncompiler " + info.compiler +
         "\nCUDA " + info.cuda + "\nbackends\n" + backend_line("cpu", fast::Backend::cpu) +
         backend_line("cuda", fast::Backend::cuda) +
         "Apache-2.0; binaries that link CHOLMOD's GPL parts are passed on under the GPL.";
}

}  // namespace ogc::experiments

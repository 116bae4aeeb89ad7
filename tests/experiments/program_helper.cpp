#include "tests/experiments/program.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace ogc::tests {

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

const char* const crossing_triangles_obj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 -0.5\nv 0.3 0.2 0.5\nv 0.2 0.3 0.5\nf 1 2 3\nf 4 5 6\n";
const char* const parallel_triangles_obj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0.001\nv 1 0 0.001\nv 0 1 0.001\nf 1 2 3\nf 4 5 6\n";

TemporaryFolder::TemporaryFolder() {
  static std::atomic<int> count{0};
  path_ = std::filesystem::temp_directory_path() /
          ("ogc-test-" + std::to_string(getpid()) + "-" + std::to_string(count++));
  std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name) << text;
  return path_ / name;
}

ProgramResult run_ogc(const std::string& arguments, const std::string& before) {
  const TemporaryFolder folder;
  const std::string out = (folder / "out").string(), err = (folder / "err").string();
  // If the tests run from a bundle, an environment variable has the path of the program.
  const char* elsewhere = std::getenv("OGC_PROGRAM");
  const std::string program = elsewhere == nullptr ? OGC_PROGRAM : elsewhere;
  const std::string command = "{ " + before + "'" + program + "' " + arguments + "; } > '" + out + "' 2> '" + err + "'";
  const int code = std::system(command.c_str());
  ProgramResult result;
  result.status = WIFEXITED(code) ? WEXITSTATUS(code) : 128 + WTERMSIG(code);
  result.out = text_of(out);
  result.err = text_of(err);
  return result;
}

bool contains(const std::string& text, std::initializer_list<std::string> parts) {
  return std::ranges::all_of(parts, [&](const std::string& part) { return text.find(part) != std::string::npos; });
}

}  // namespace ogc::tests

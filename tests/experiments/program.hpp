// Runs the built program as a user would, in a folder of its own.
#pragma once

#include <filesystem>
#include <string>

namespace ogc::tests {

/// A fresh folder that is removed with its content.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// Writes a text file and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

struct ProgramResult {
  int status = -1;  ///< exit status; 128 + signal where one ended it
  std::string out, err;
};

/// `ogc ARGUMENTS` through the shell; `before` is shell text put in front ("ulimit -f 8; ").
ProgramResult run_ogc(const std::string& arguments, const std::string& before = "");

/// Whether all of `parts` stand in `text`, in any order.
bool contains(const std::string& text, std::initializer_list<std::string> parts);

/// Two triangles that cross: edges of the second pass through the first.
extern const char* const crossing_triangles_obj;
/// Two parallel triangles, 1 mm apart.
extern const char* const parallel_triangles_obj;

}  // namespace ogc::tests

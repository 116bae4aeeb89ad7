// Runs the built program through the shell, in a separate folder.
#pragma once

#include <filesystem>
#include <string>

namespace ogc::tests {

/// A new folder, which the destructor removes.
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
  int status = -1;  ///< exit status; 128 + signal if a signal ended it
  std::string out, err;
};

/// Runs `ogc ARGUMENTS` through the shell. `before` is shell text before the command, for example "ulimit -f 8; ".
ProgramResult run_ogc(const std::string& arguments, const std::string& before = "");

/// Returns whether `text` contains all of `parts`, in any order.
bool contains(const std::string& text, std::initializer_list<std::string> parts);

/// An OBJ mesh of two triangles. Edges of the second triangle pass through the first triangle.
extern const char* const crossing_triangles_obj;
/// An OBJ mesh of two parallel triangles, 1 mm apart.
extern const char* const parallel_triangles_obj;

}  // namespace ogc::tests

// Reads a large binary file piece by piece, because caches of frames have gigabytes and an audit needs one frame at a
// time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

namespace ogc::compare {

/// An open binary file and the position in it.
class InputFile {
 public:
  /// Opens the file. Throws InputError that names it if it is missing, no regular file, or unreadable.
  explicit InputFile(const std::filesystem::path& path);
  const std::string& name() const { return name_; }     ///< its name in messages
  std::uint64_t size() const { return size_; }          ///< size when it was opened [bytes]
  std::uint64_t position() const { return position_; }  ///< position of the next byte
  /// Fills `bytes` from the current position. If the file ends earlier, throws InputError that names `what` and the
  /// byte.
  void read(std::span<char> bytes, const std::string& what);

 private:
  std::string name_;
  std::uint64_t size_ = 0, position_ = 0;
  std::ifstream stream_;
};

}  // namespace ogc::compare

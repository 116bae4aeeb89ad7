// A large binary file, read piece by piece: caches of frames are gigabytes, and one frame is all that an audit needs at
// a time.
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
  /// Throws InputError that names the file: missing, no regular file, unreadable.
  explicit InputFile(const std::filesystem::path& path);
  const std::string& name() const { return name_; }     ///< as messages name it
  std::uint64_t size() const { return size_; }          ///< [bytes], when it was opened
  std::uint64_t position() const { return position_; }  ///< of the next byte
  /// Fills `bytes` from the position on. Throws InputError that names `what` and the byte where the file ends before.
  void read(std::span<char> bytes, const std::string& what);

 private:
  std::string name_;
  std::uint64_t size_ = 0, position_ = 0;
  std::ifstream stream_;
};

}  // namespace ogc::compare

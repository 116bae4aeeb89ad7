#include "compare/files/frames/input_file.hpp"

#include <system_error>

#include "compare/files/bytes.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {

InputFile::InputFile(const std::filesystem::path& path) : name_(path.string()) {
  expect_regular_file(path);
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  stream_.open(path, std::ios::binary);
  if (error || !stream_) throw InputError(name_ + ": can't be read; check its permissions");
}

void InputFile::read(std::span<char> bytes, const std::string& what) {
  if (bytes.size() > size_ - position_)
    throw InputError(name_ + ": " + what + ": the file ends at byte " + std::to_string(size_) + ", " +
                     std::to_string(bytes.size()) + " bytes from byte " + std::to_string(position_) +
                     " on were announced; it is truncated");
  if (!stream_.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw InputError(name_ + ": " + what + ": can't be read from byte " + std::to_string(position_) +
                     " on; check the disk");
  position_ += bytes.size();
}

}  // namespace ogc::compare

// Reads members of a .zip archive one after the other, and unpacks them piece by piece.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ogc::compare {

/// An open archive. One member at a time can be read.
class ZipFile {
 public:
  /// Opens the archive. Throws InputError if the file is no archive, ResourceError if this program was built without
  /// minizip.
  explicit ZipFile(const std::filesystem::path& path);
  ~ZipFile();
  ZipFile(const ZipFile&) = delete;
  ZipFile& operator=(const ZipFile&) = delete;
  const std::vector<std::string>& members() const { return members_; }  ///< names in the archive's order
  /// Opens a member at its beginning; only the last opened member can be read. Throws InputError.
  void open(const std::string& member);
  /// Fills `bytes` from the open member. If the member ends earlier or is damaged, throws InputError that names the
  /// archive, the member, `what` and the byte. The checksum is compared at the member's end.
  void read(std::span<char> bytes, const std::string& what);
  /// Returns the size of the open member, unpacked [bytes].
  std::uint64_t size() const { return size_; }

 private:
  void check_end(const std::string& what);
  struct Handle;
  std::string name_, member_;
  std::unique_ptr<Handle> handle_;
  std::vector<std::string> members_;
  std::uint64_t size_ = 0, position_ = 0;
};

}  // namespace ogc::compare

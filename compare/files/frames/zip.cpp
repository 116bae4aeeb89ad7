#include "compare/files/frames/zip.hpp"

#include <algorithm>
#include <system_error>

#include "compare/files/bytes.hpp"
#include "compare/problem/error.hpp"

#ifdef OGC_HAS_MINIZIP
#include <unzip.h>
#endif

namespace ogc::compare {

#ifdef OGC_HAS_MINIZIP

/// Two bits of deflated data give at most 258 bytes. A member that claims a larger ratio is damaged and is rejected
/// before memory is allocated.
constexpr std::uint64_t most_deflated = 258 * 8 / 2;

struct ZipFile::Handle {
  explicit Handle(unzFile opened) : file(opened) {}
  ~Handle() {
    if (file != nullptr) unzClose(file);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  unzFile file;
};

ZipFile::ZipFile(const std::filesystem::path& path) : name_(path.string()) {
  expect_regular_file(path);
  handle_ = std::make_unique<Handle>(unzOpen64(name_.c_str()));
  if (handle_->file == nullptr)
    throw InputError(name_ + ": is no zip archive, or is truncated (the list of its members stands at its end)");
  for (int status = unzGoToFirstFile(handle_->file); status == UNZ_OK; status = unzGoToNextFile(handle_->file)) {
    unz_file_info64 info;
    if (unzGetCurrentFileInfo64(handle_->file, &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK) break;
    std::string member(info.size_filename, '\0');
    unzGetCurrentFileInfo64(handle_->file, &info, member.data(), info.size_filename, nullptr, 0, nullptr, 0);
    members_.push_back(std::move(member));
  }
}

void ZipFile::open(const std::string& member) {
  member_ = member;
  position_ = 0;
  unz_file_info64 info;
  if (unzLocateFile(handle_->file, member.c_str(), 1) != UNZ_OK || unzOpenCurrentFile(handle_->file) != UNZ_OK ||
      unzGetCurrentFileInfo64(handle_->file, &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK)
    throw InputError(name_ + ": '" + member +
                     "' can't be read; it is missing, damaged, or packed by another method than deflate");
  size_ = info.uncompressed_size;
  std::error_code error;
  const std::uintmax_t whole = std::filesystem::file_size(name_, error);
  if (error || info.compressed_size > whole || size_ / most_deflated > info.compressed_size)
    throw InputError(name_ + ": '" + member_ + "' announces " + std::to_string(size_) + " bytes from " +
                     std::to_string(info.compressed_size) + " packed ones, more than deflate can pack; it is damaged");
}

void ZipFile::read(std::span<char> bytes, const std::string& what) {
  if (bytes.size() > size_ - position_)
    throw InputError(name_ + ": '" + member_ + "', " + what + ": ends at byte " + std::to_string(size_) + ", " +
                     std::to_string(bytes.size()) + " bytes from byte " + std::to_string(position_) +
                     " on were announced; it is truncated");
  while (!bytes.empty()) {
    constexpr std::size_t most = 1 << 30;  // minizip counts bytes in int
    const int got = unzReadCurrentFile(handle_->file, bytes.data(),
                                       static_cast<unsigned>(std::min(bytes.size(), most)));
    if (got <= 0)
      throw InputError(name_ + ": '" + member_ + "', " + what + ": can't be unpacked from byte " +
                       std::to_string(position_) + " on; it is damaged");
    bytes = bytes.subspan(static_cast<std::size_t>(got));
    position_ += static_cast<std::uint64_t>(got);
  }
  if (position_ == size_) check_end(what);
}

/// Checks the checksum of a member that was read to its end; minizip compares it when the member is closed.
void ZipFile::check_end(const std::string& what) {
  if (unzCloseCurrentFile(handle_->file) == UNZ_CRCERROR)
    throw InputError(name_ + ": '" + member_ + "', " + what + ": its checksum is wrong; the archive is damaged");
}

#else

struct ZipFile::Handle {};

ZipFile::ZipFile(const std::filesystem::path& path) : name_(path.string()) {
  throw ResourceError(
      name_ +
      ": this program was built without minizip, which reads .npz archives; install libminizip-dev and build again, "
      "or store the frames as .npy (numpy.save)");
}

void ZipFile::open(const std::string&) {}
void ZipFile::read(std::span<char>, const std::string&) {}
void ZipFile::check_end(const std::string&) {}

#endif

ZipFile::~ZipFile() = default;

}  // namespace ogc::compare

#include "compare/files/frames/mesh_sequence.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <system_error>
#include <utility>

#include "compare/files/frames/natural_order.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

class MeshFiles : public MeshSequence {
 public:
  MeshFiles(std::vector<std::filesystem::path> files, MeshReader read)
      : files_(std::move(files)), read_(std::move(read)) {}
  std::size_t size() const override { return files_.size(); }
  std::string name(std::size_t i) const override { return files_.at(i).string(); }
  LoadedMesh next() override { return read_(files_.at(next_++)); }

 private:
  std::vector<std::filesystem::path> files_;
  MeshReader read_;
  std::size_t next_ = 0;
};

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

std::unique_ptr<MeshSequence> mesh_files_sequence(std::vector<std::filesystem::path> files, MeshReader read) {
  return std::make_unique<MeshFiles>(std::move(files), std::move(read));
}

std::vector<std::filesystem::path> mesh_files_in(const std::filesystem::path& folder,
                                                 const std::vector<std::string>& extensions) {
  std::map<std::string, std::vector<std::filesystem::path>> by_extension;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string extension = lower_extension(entry->path());
    if (std::ranges::count(extensions, extension) > 0) by_extension[extension].push_back(entry->path());
  }
  if (error) throw InputError(folder.string() + ": can't be read: " + error.message());
  std::string kinds;
  for (const auto& [extension, files] : by_extension)
    kinds += (kinds.empty() ? "" : ", ") + std::to_string(files.size()) + " " + extension;
  if (by_extension.size() > 1)
    throw InputError(folder.string() + ": holds meshes of several kinds (" + kinds + "); name those of one: '" +
                     folder.string() + "/*" + by_extension.begin()->first + "'");
  if (by_extension.empty()) {
    std::string known;
    for (const std::string& extension : extensions) known += (known.empty() ? "" : ", ") + extension;
    throw InputError(folder.string() + ": is no run folder (it holds no run.json), and holds no mesh (" + known + ")");
  }
  std::vector<std::filesystem::path> files = std::move(by_extension.begin()->second);
  std::ranges::sort(files, [](const auto& a, const auto& b) { return natural_less(a.native(), b.native()); });
  return files;
}

}  // namespace ogc::compare

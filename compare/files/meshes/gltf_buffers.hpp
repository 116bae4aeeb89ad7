// Finds the numbers of a glTF file. An accessor refers to a view, and a view to a buffer. A buffer is in the file
// itself, in base64, or in a file beside it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "compare/files/json_reader.hpp"

namespace ogc::compare {

/// Holds the JSON of a glTF file and its buffers; indices and lengths are checked before a number is read.
class GltfBuffers {
 public:
  /// Opens a .gltf file, or a .glb file, which contains JSON and one buffer. `name` is the file's path, for errors and
  /// for buffers beside it. Throws InputError if the file is neither, has another version than 2, or is truncated.
  GltfBuffers(std::string_view bytes, const std::string& name);

  const Json& root() const { return json_; }  ///< the whole document
  /// Returns entry `i` of one of the document's lists ("meshes"); the error for a missing entry names `user`, the
  /// object that refers to it.
  const Json& entry(const std::string& list, std::size_t i, const std::string& user) const;
  /// Returns the whole number under `key`, or `otherwise` if the object lacks the key; errors call the object `owner`.
  std::size_t whole(const Json& object, const char* key, const std::string& owner, std::size_t otherwise) const;
  /// Returns the whole number under `key`, which must exist.
  std::size_t whole(const Json& object, const char* key, const std::string& owner) const;

  /// Returns all components of accessor `i`, entry after entry. Throws InputError if the accessor's type is not `type`
  /// ("VEC3", "SCALAR"), if it is sparse or compressed, or if it exceeds its view or buffer. For errors, `user` names
  /// the object that refers to the accessor.
  std::vector<double> read(std::size_t i, const std::string& type, const std::string& user);

  std::size_t bytes_beside() const { return bytes_beside_; }  ///< size of the buffers in other files that were read

  /// Throws InputError "FILE: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string_view buffer(std::size_t i, const std::string& user);
  std::string_view view_of(const Json& accessor, std::size_t& stride, const std::string& user);
  void open_container(std::string_view bytes);
  std::string read_beside(const std::string& uri, const std::string& owner);

  std::string name_;
  Json json_;
  std::string_view binary_;                     ///< the buffer of a .glb file
  std::size_t bytes_beside_ = 0;                ///< size of the buffers in other files
  bool has_binary_ = false;                     ///< whether there is a buffer in the .glb
  std::map<std::size_t, std::string> buffers_;  ///< buffers of base64 and of other files, loaded on demand
};

}  // namespace ogc::compare

// Where the numbers of a glTF file are: accessors into views into buffers, which stand in the file itself, in base64,
// or in files beside it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "compare/files/json_reader.hpp"

namespace ogc::compare {

/// The JSON of a glTF file and its buffers, whose indices and lengths are checked before a number is read.
class GltfBuffers {
 public:
  /// Of a .gltf or .glb file: the latter is a container of JSON and one buffer. `name` is the file's, for errors and
  /// for buffers beside it. Throws InputError where it is neither, of another version than 2, or truncated.
  GltfBuffers(std::string_view bytes, const std::string& name);

  const Json& root() const { return json_; }  ///< the whole document
  /// Entry `i` of one of the document's lists ("meshes"); `user` names who asks, for the error where there is none.
  const Json& entry(const std::string& list, std::size_t i, const std::string& user) const;
  /// The whole number of that key, or `otherwise` where it has none; `owner` names the object in errors.
  std::size_t whole(const Json& object, const char* key, const std::string& owner, std::size_t otherwise) const;
  /// The same where it must be there.
  std::size_t whole(const Json& object, const char* key, const std::string& owner) const;

  /// All components of accessor `i`, entry after entry, of its type ("VEC3", "SCALAR"). Throws InputError where it is
  /// of another type, sparse, compressed, or beyond its view or buffer.
  std::vector<double> read(std::size_t i, const std::string& type, const std::string& user);

  std::size_t bytes_beside() const { return bytes_beside_; }  ///< of buffers in other files, as far as they were read

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
  std::size_t bytes_beside_ = 0;                ///< of buffers in other files
  bool has_binary_ = false;                     ///< whether it has one
  std::map<std::size_t, std::string> buffers_;  ///< of base64 and of other files, as they are asked for
};

}  // namespace ogc::compare

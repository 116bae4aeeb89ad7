// Reads JSON strictly: an unknown key is an error, and every error names its line or the path of the value. Problems
// are collected, so that one run lists all of them.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "compare/problem/validate.hpp"

namespace ogc::compare {

using Json = nlohmann::ordered_json;

/// Parses one JSON document. Throws InputError that names `file` and the line for bad syntax, a repeated key in one
/// object, a number beyond double, or more than 64 levels of arrays and objects.
Json parse_json(std::string_view text, const std::string& file);

/// A value, its path in the document ("/bodies/0/material"), and the list for its problems.
class JsonNode {
 public:
  JsonNode(const Json& value, std::string file, std::string path, std::vector<Problem>& problems);

  /// Adds a problem at this node.
  void fail(const std::string& what, const std::string& remedy) const;
  /// Returns "FILE: PATH".
  std::string where() const;
  const std::string& path() const { return path_; }

  /// Read the value into `target`. For a wrong type, each overload adds a problem and leaves the target unchanged.
  void read(bool& target) const;
  void read(std::string& target) const;
  void read(double& target) const;
  void read(std::int64_t& target) const;
  void read(Index& target) const;
  void read(Vec3& target) const;

  /// Return whether the value is an object or an array; add a problem if not.
  bool expect_object() const;
  bool expect_array() const;

  std::size_t size() const { return value_->size(); }  ///< number of children
  JsonNode child(std::size_t i) const;                 ///< element of an array
  JsonNode child(const std::string& key) const;        ///< value of an object's key
  const Json& value() const { return *value_; }        ///< the JSON value itself

 private:
  void wrong_type(const std::string& wanted) const;
  const Json* value_;
  std::string file_, path_;
  std::vector<Problem>* problems_;
};

/// Reads the keys of an object one after another; `finish` reports keys that were not read.
class JsonObject {
 public:
  explicit JsonObject(const JsonNode& node);

  /// Calls `use` with the key's value if the key exists.
  void optional(const std::string& key, const std::function<void(const JsonNode&)>& use);
  /// Calls `use` with the key's value; adds a problem if the key does not exist.
  void required(const std::string& key, const std::function<void(const JsonNode&)>& use);
  template <class Target>
  void optional_value(const std::string& key, Target& target) {
    optional(key, [&](const JsonNode& node) { node.read(target); });
  }
  template <class Target>
  void required_value(const std::string& key, Target& target) {
    required(key, [&](const JsonNode& node) { node.read(target); });
  }
  bool has(const std::string& key) const;  ///< whether the object has the key
  void finish() const;                     ///< adds a problem for each key that was not read

 private:
  JsonNode node_;
  bool is_object_;
  std::vector<std::string> asked_;
};

}  // namespace ogc::compare

// Distinguishes whole numbers as JSON writes them: 40 is a whole number, 40.0 is not. So a count with a fraction is an
// error and is not truncated.
#include "compare/files/json_reader.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "compare/problem/error.hpp"
#include "compare/problem/settings.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {

Json parse_json(std::string_view text, const std::string& file) {
  // Our formats need far fewer levels. Visiting a value recurses, so the depth must have a limit.
  constexpr int most_levels = 64;
  std::vector<std::set<std::string>> open_objects;
  const auto refuse_repeated_keys = [&](int level, Json::parse_event_t event, Json& parsed) {
    if (level > most_levels)
      throw InputError(file + ": nests arrays and objects more than " + std::to_string(most_levels) +
                       " levels deep; no format has so many");
    if (event == Json::parse_event_t::object_start) open_objects.emplace_back();
    if (event == Json::parse_event_t::object_end) open_objects.pop_back();
    if (event == Json::parse_event_t::key && !open_objects.back().insert(parsed.get<std::string>()).second) {
      throw InputError(file + ": the key '" + parsed.get<std::string>() +
                       "' stands twice in one object; keep one of them");
    }
    return true;
  };
  try {
    return Json::parse(text, refuse_repeated_keys);
  } catch (const Json::exception& error) {
    constexpr std::size_t most_shown = 200;  // the library's message repeats the number, which may have any length
    throw InputError(file + ": no valid JSON: " + shown(error.what(), most_shown));
  }
}

JsonNode::JsonNode(const Json& value, std::string file, std::string path, std::vector<Problem>& problems)
    : value_(&value), file_(std::move(file)), path_(std::move(path)), problems_(&problems) {}

std::string JsonNode::where() const { return file_ + ": " + (path_.empty() ? "/" : path_); }

void JsonNode::fail(const std::string& what, const std::string& remedy) const {
  problems_->push_back({where(), what, remedy});
}

void JsonNode::wrong_type(const std::string& wanted) const {
  constexpr std::size_t most_shown = 40;
  const std::string text = value_->dump();
  fail("is " + (text.size() > most_shown ? value_->type_name() : text), "give " + wanted);
}

void JsonNode::read(bool& target) const {
  value_->is_boolean() ? void(target = value_->get<bool>()) : wrong_type("true or false");
}

void JsonNode::read(std::string& target) const {
  value_->is_string() ? void(target = value_->get<std::string>()) : wrong_type("a text in quotes");
}

void JsonNode::read(double& target) const {
  value_->is_number() ? void(target = value_->get<double>()) : wrong_type("a number");
}

void JsonNode::read(std::int64_t& target) const {
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  const bool too_large = value_->is_number_unsigned() && value_->get<std::uint64_t>() > most;
  if (!value_->is_number_integer() || too_large) return wrong_type("a whole number");
  target = value_->get<std::int64_t>();
}

void JsonNode::read(Index& target) const {
  std::int64_t wide = -1;
  read(wide);
  if (!value_->is_number_integer()) return;
  if (wide < 0 || wide > std::numeric_limits<Index>::max()) return wrong_type("an index, from 0");
  target = static_cast<Index>(wide);
}

void JsonNode::read(Vec3& target) const {
  const bool three = value_->is_array() && value_->size() == 3 &&
                     std::all_of(value_->begin(), value_->end(), [](const Json& x) { return x.is_number(); });
  if (!three) return wrong_type("three numbers, [x, y, z]");
  target = {(*value_)[0].get<double>(), (*value_)[1].get<double>(), (*value_)[2].get<double>()};
}

bool JsonNode::expect_object() const {
  if (!value_->is_object()) wrong_type("an object, { … }");
  return value_->is_object();
}

bool JsonNode::expect_array() const {
  if (!value_->is_array()) wrong_type("an array, [ … ]");
  return value_->is_array();
}

JsonNode JsonNode::child(std::size_t i) const {
  return {(*value_)[i], file_, path_ + "/" + std::to_string(i), *problems_};
}

JsonNode JsonNode::child(const std::string& key) const {
  return {value_->at(key), file_, path_ + "/" + key, *problems_};
}

JsonObject::JsonObject(const JsonNode& node) : node_(node), is_object_(node.expect_object()) {}

bool JsonObject::has(const std::string& key) const { return is_object_ && node_.value().contains(key); }

void JsonObject::optional(const std::string& key, const std::function<void(const JsonNode&)>& use) {
  asked_.push_back(key);
  if (has(key)) use(node_.child(key));
}

void JsonObject::required(const std::string& key, const std::function<void(const JsonNode&)>& use) {
  optional(key, use);
  if (is_object_ && !has(key)) node_.fail("has no '" + key + "'", "add it; `ogc scenes --schema` describes each key");
}

void JsonObject::finish() const {
  if (!is_object_) return;
  const std::vector<std::string_view> known(asked_.begin(), asked_.end());
  for (const auto& [key, value] : node_.value().items()) {
    if (std::ranges::find(known, key) != known.end()) continue;
    const std::string_view now = renamed_setting(key);
    const bool has_now = std::ranges::find(known, now) != known.end();
    node_.child(key).fail(has_now ? unknown_setting(key, known) : unknown_name("key", key, known),
                          "rename or remove it");
  }
}

}  // namespace ogc::compare

#include "compare/judge/report/case_hdf5.hpp"

#include <algorithm>
#include <cctype>

#include "compare/files/bytes.hpp"
#include "compare/files/hdf5.hpp"
#include "compare/files/json_reader.hpp"
#include "compare/judge/engine/numbers_json.hpp"

namespace ogc::compare {

namespace {

enum class Leaf { none, single, real, integer };

constexpr std::array<std::string_view, 4> leaf_names{"", "float", "double", "integer"};

/// Checks whether text is a number of single precision (compare/judge/engine/numbers_json.hpp).
bool is_hexadecimal(const std::string& text) { return text.starts_with("0x") || text.starts_with("-0x"); }

Leaf leaf_of(const Json& json) {
  if (json.is_number_float()) return Leaf::real;
  if (json.is_number_integer()) return Leaf::integer;
  return json.is_string() && is_hexadecimal(json.get_ref<const std::string&>()) ? Leaf::single : Leaf::none;
}

/// A table: an array of numbers, or of arrays of equal length. `leaf` is the common type of its numbers; `none` if the
/// JSON is no table of one type.
struct Table {
  Leaf leaf = Leaf::none;
  std::size_t columns = 0;  ///< 0: an array of numbers
};

Table table_of(const Json& json) {
  if (!json.is_array() || json.empty()) return {};
  const bool nested = json[0].is_array();
  const Table table{nested && !json[0].empty() ? leaf_of(json[0][0]) : leaf_of(json[0]), nested ? json[0].size() : 0};
  const auto fits = [&](const Json& x) { return leaf_of(x) == table.leaf; };
  const bool same = std::all_of(json.begin(), json.end(), [&](const Json& row) {
    return nested ? row.is_array() && row.size() == table.columns && std::all_of(row.begin(), row.end(), fits)
                  : fits(row);
  });
  return same ? table : Table{};
}

template <class T>
T value_of(const Json& json) {
  if constexpr (std::is_same_v<T, float>)
    return number(json);
  else
    return json.get<T>();
}

template <class T>
Json json_of(T value) {
  if constexpr (std::is_same_v<T, float>)
    return hexadecimal(value);
  else
    return value;
}

template <class T>
void write_table(Hdf5File& file, const std::string& name, const Json& json, std::size_t columns) {
  std::vector<T> values;
  for (const Json& row : json) {
    if (columns == 0)
      values.push_back(value_of<T>(row));
    else
      for (const Json& x : row) values.push_back(value_of<T>(x));
  }
  file.write<T>(name, values, columns);
}

template <class T>
Json read_table(const Hdf5File& file, const std::string& name) {
  const std::vector<T> values = file.read<T>(name);
  const std::vector<std::size_t> shape = file.shape(name);
  Json json = Json::array();
  if (shape.size() < 2) {
    for (const T value : values) json.push_back(json_of(value));
    return json;
  }
  for (std::size_t i = 0; i < values.size(); i += shape[1]) {
    Json row = Json::array();
    for (std::size_t k = 0; k < shape[1]; ++k) row.push_back(json_of(values[i + k]));
    json.push_back(std::move(row));
  }
  return json;
}

/// Moves the tables of the JSON into datasets and returns the rest.
Json put_away(Hdf5File& file, const std::string& name, const Json& json) {
  if (const Table table = table_of(json); table.leaf != Leaf::none) {
    if (table.leaf == Leaf::single)
      write_table<float>(file, name, json, table.columns);
    else if (table.leaf == Leaf::real)
      write_table<double>(file, name, json, table.columns);
    else
      write_table<std::int64_t>(file, name, json, table.columns);
    return "@" + std::string(leaf_names[static_cast<std::size_t>(table.leaf)]) + ":" + name;
  }
  if (!json.is_structured()) return json;
  Json rest = json;
  std::size_t i = 0;
  for (auto& [key, value] : rest.items()) {
    const std::string part = json.is_array() ? std::to_string(i++) : key;
    value = put_away(file, name.empty() ? part : name + "." + part, value);
  }
  return rest;
}

Json taken_out(const Hdf5File& file, const Json& json) {
  if (json.is_string() && json.get_ref<const std::string&>().starts_with("@")) {
    const std::string text = json.get<std::string>();
    const std::size_t colon = text.find(':');
    const std::string leaf = text.substr(1, colon - 1), name = colon == std::string::npos ? "" : text.substr(colon + 1);
    if (leaf == leaf_names[1]) return read_table<float>(file, name);
    if (leaf == leaf_names[2]) return read_table<double>(file, name);
    if (leaf == leaf_names[3]) return read_table<std::int64_t>(file, name);
    throw InputError("'" + text + "' names no dataset");
  }
  if (!json.is_structured()) return json;
  Json whole = json;
  for (auto& value : whole) value = taken_out(file, value);
  return whole;
}

}  // namespace

void write_case_hdf5(const std::filesystem::path& path, const Json& json) {
  Hdf5File file = Hdf5File::create_in_memory(path);
  Json rest = json;
  rest["data"] = put_away(file, "", json.at("data"));
  file.write_text("case", rest.dump(1));
  write_bytes(path, file.image());
}

Json read_case_hdf5(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::open(path);
  return taken_out(file, parse_json(file.read_text("case"), path.string()));
}

}  // namespace ogc::compare

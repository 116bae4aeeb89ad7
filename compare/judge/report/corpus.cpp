#include "compare/judge/report/corpus.hpp"

#include <sstream>

#include "compare/files/bytes.hpp"
#include "compare/files/json_reader.hpp"
#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/engine/numbers_json.hpp"
#include "compare/judge/report/case_hdf5.hpp"
#include "compare/judge/report/shape.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {

nlohmann::ordered_json case_to_json(const TestCase& test, const std::string& message) {
  return {{"format", case_format_version},
          {"problem", print_problem(test.name)},
          {"message", message},
          {"data", traits_of(test.name.stage).write(test.data)}};
}

std::filesystem::path save_case(const std::filesystem::path& folder, const TestCase& test, const std::string& message) {
  const CaseName& name = test.name;
  std::string stem = std::string(stage_name(name.stage)) + "." + name.generator + "." + std::to_string(name.seed) +
                     "." + std::to_string(name.index);
  for (const Override& parameter : name.overrides) stem += "." + parameter.name + "=" + hexadecimal(parameter.value);
  const std::filesystem::path path = folder / (stem + ".h5");
  write_case_hdf5(path, case_to_json(test, message));
  const Shape shape = shape_of(test);
  if (shape.points.empty()) return path;
  if (const std::string mesh = print_shape_obj(shape); !mesh.empty()) write_bytes(folder / (stem + ".obj"), mesh);
  write_bytes(folder / (stem + ".svg"), print_shape_svg(shape, print_problem(name) + ": " + message));
  return path;
}

TestCase load_case(const std::filesystem::path& path) {
  const bool is_text = path.extension() == ".json";
  const std::string text = is_text ? read_bytes(path) : "";
  try {
    const Json json = is_text ? parse_json(text, path.string()) : read_case_hdf5(path);
    const int format = json.at("format").get<int>();
    if (format != case_format_version)
      throw InputError("has format " + std::to_string(format) + ", and this program reads format " +
                       std::to_string(case_format_version));
    TestCase test{parse_problem(json.at("problem").get<std::string>()), {}};
    test.data = traits_of(test.name.stage).read(json.at("data"));
    return test;
  } catch (const nlohmann::json::exception& problem) {
    throw InputError(path.string() + ": " + problem.what());
  } catch (const InputError& problem) {
    throw InputError(path.string() + ": " + problem.what());
  } catch (const std::out_of_range& problem) {
    throw InputError(path.string() + ": mesh: " + problem.what());
  }
}

std::vector<CaseName> load_batch(const std::filesystem::path& path) {
  std::istringstream file(read_bytes(path));
  std::vector<CaseName> names;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#') continue;
    try {
      names.push_back(parse_problem(line));
    } catch (const InputError& problem) {
      throw InputError(path.string() + ", line " + std::to_string(number) + ": " + problem.what());
    }
  }
  return names;
}

}  // namespace ogc::compare

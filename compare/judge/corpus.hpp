// Cases as files: JSON with hexadecimal floats, so that every bit comes back whatever becomes of the generators, and an OBJ mesh to look at.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/judge/cases.hpp"

namespace ogc::compare {

inline constexpr int case_format_version = 1;

/// Writes folder/STAGE.GENERATOR.SEED.INDEX.json and, where the case has a shape, .obj beside it. Returns the path of the JSON file. Throws
/// ResourceError where the disk does not take it.
std::filesystem::path save_case(const std::filesystem::path& folder, const TestCase& test, const std::string& message);

/// Reads a saved case. Throws InputError that names the file and the key that is missing or wrong.
TestCase load_case(const std::filesystem::path& file);

/// Reads a batch file: one problem string a line; empty lines and lines that begin with # are skipped. Throws InputError that names file and line.
std::vector<CaseName> load_batch(const std::filesystem::path& file);

}  // namespace ogc::compare

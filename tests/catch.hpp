// Gives Catch2 2 (Debian 12) and 3 (Ubuntu 24.04) the same names.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
using Catch::Matchers::ContainsSubstring;
#else
#include <catch2/catch.hpp>
/// Matches texts that contain `part`.
inline auto ContainsSubstring(const std::string& part) { return Catch::Contains(part); }
#endif

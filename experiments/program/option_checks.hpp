// Checks numbers on the command line. A check adds the option's range to the help and refuses all other texts, also
// not-a-number, infinity and numbers beyond the range of a double. Its message names the option, the text and the
// range.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

namespace ogc::experiments {

/// Upper limit of counts, such as steps, repetitions and lengths of lists; settings have the same limit
/// (compare/problem/settings.cpp).
inline constexpr std::uint64_t most_counted = 1 << 30;
/// Upper limit of --devices: more than a machine has.
inline constexpr std::uint64_t most_devices = 64;
/// Upper limit of --worlds.
inline constexpr std::uint64_t most_worlds = 1 << 20;

/// Accepts integers from `least` to `most`.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);

/// Accepts numbers from `least` to `most` in `unit`; with `or_zero` also 0.
CLI::Validator real_number(double least, double most, const std::string& unit, bool or_zero = false);

/// Adds --threads, the number of CPU threads. `threads` stays 0 without the option.
void add_threads_option(CLI::App& command, int& threads);
/// Limits the CPU to this many threads during the lifetime of the result. Returns null for 0, which means no limit.
std::unique_ptr<tbb::global_control> limited_threads(int threads);

}  // namespace ogc::experiments

// Checks numbers on the command line. A check adds the option's range to its help and refuses every other text; the
// message names the option, the text and the range. Refused are also not-a-number, infinity and numbers that a double
// can't hold.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

namespace ogc::experiments {

/// Upper limit of counts, such as steps, repetitions and entries of a list; settings have the same limit
/// (compare/problem/settings.cpp).
inline constexpr std::uint64_t most_counted = 1 << 30;

/// Accepts a whole number from `least` to `most`.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);

/// Accepts a number from `least` to `most`, in `unit`; with `or_zero` also 0.
CLI::Validator real_number(double least, double most, const std::string& unit, bool or_zero = false);

/// Adds --threads, the number of CPU threads; `threads` stays 0 without the option.
void add_threads_option(CLI::App& command, int& threads);
/// Limits the CPU to this many threads for the lifetime of the result; returns null for 0, which means no limit.
std::unique_ptr<tbb::global_control> limited_threads(int threads);

}  // namespace ogc::experiments

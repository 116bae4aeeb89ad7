// What a number on the command line may be. A check puts the option's range into its help, and refuses any other text
// by the option's name, the text and the range; not-a-number, infinity and what a double can't hold are such texts.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

namespace ogc::experiments {

/// Steps, repetitions, entries of a list: what settings count to (compare/problem/settings.cpp).
inline constexpr std::uint64_t most_counted = 1 << 30;

/// A whole number from `least` to `most`.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);

/// A number from `least` to `most`, in `unit`; with `or_zero` 0, too.
CLI::Validator real_number(double least, double most, const std::string& unit, bool or_zero = false);

/// Adds --threads, the number of the CPU's threads; 0 stays where it is not given.
void add_threads_option(CLI::App& command, int& threads);
/// Holds the CPU to so many threads while it lives; null for 0: to none.
std::unique_ptr<tbb::global_control> limited_threads(int threads);

}  // namespace ogc::experiments

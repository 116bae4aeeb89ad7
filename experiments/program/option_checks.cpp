#include "experiments/program/option_checks.hpp"

#include <charconv>
#include <optional>
#include <string_view>

#include "compare/problem/text.hpp"

namespace ogc::experiments {

namespace {

/// Largest number of threads: more than machines have, but few enough to be created.
constexpr std::uint64_t most_threads = 1024;

template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Returns a check whose name is `range`. `accepts` gets the text without a leading plus sign, like the option's own
/// parser.
template <class Accepts>
CLI::Validator check(const std::string& range, Accepts accepts) {
  return {[range, accepts](std::string& text) -> std::string {
            const std::string given = compare::shown(text);
            if (text.starts_with("+")) text.erase(0, 1);
            return accepts(text) ? "" : "'" + given + "' is not " + range;
          },
          range};
}

}  // namespace

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  return check("a whole number from " + std::to_string(least) + " to " + std::to_string(most),
               [=](const std::string& text) {
                 const auto value = parsed<std::uint64_t>(text);
                 return value && *value >= least && *value <= most;
               });
}

CLI::Validator real_number(double least, double most, const std::string& unit, bool or_zero) {
  const std::string range = compare::shortest(least) + " to " + compare::shortest(most) + " " + unit;
  return check((or_zero ? "0 or from " : "a number from ") + range, [=](const std::string& text) {
    const auto value = parsed<double>(text);
    return value && ((*value >= least && *value <= most) || (or_zero && *value == 0));
  });
}

void add_threads_option(CLI::App& command, int& threads) {
  command
      .add_option("--threads", threads,
                  "The CPU works with so many threads (default: all), which changes no bit of the result")
      ->check(whole_number(1, most_threads));
}

std::unique_ptr<tbb::global_control> limited_threads(int threads) {
  if (threads == 0) return nullptr;
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                               static_cast<std::size_t>(threads));
}

}  // namespace ogc::experiments

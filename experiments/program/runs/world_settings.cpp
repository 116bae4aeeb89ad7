#include "experiments/program/runs/world_settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "compare/files/bytes.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "experiments/program/option_checks.hpp"
#include "experiments/program/runs/run_options.hpp"
#include "experiments/program/runs/solvers.hpp"

namespace ogc::experiments {

namespace {

using compare::InputError;

constexpr std::string_view seed_column = "jitter_seed";

/// What all worlds share, and why.
struct Shared {
  std::string_view column, reason;
};
constexpr std::array<Shared, 3> shared{
    Shared{"data", "all worlds have one mesh; give it with --set data=…"},
    Shared{"body_contact", "all worlds have one kind of bodies; give it with --set body_contact=…"},
    Shared{"frame_steps", "all worlds are audited after the same steps; give it with --set frame_steps=…"}};

std::string trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == text.npos ? "" : std::string(text.substr(first, text.find_last_not_of(blanks) + 1 - first));
}

/// Returns the cells of a line.
std::vector<std::string> cells(std::string_view line) {
  std::vector<std::string> result;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    result.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  return result;
}

std::uint64_t seed_of(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc{} || end != text.data() + text.size())
    throw InputError("'" + compare::shown(text) + "' is no whole number from 0 on");
  return seed;
}

/// Reads the lines of one table.
class Table {
 public:
  Table(const std::filesystem::path& file, const RunRequest& request)
      : name_(file.string()), text_(compare::read_bytes(file)), request_(request) {
    if (!next()) fail("is empty; its first line names settings, each other line has the values of one world");
    columns_ = cells(line_);
    for (std::size_t c = 0; c < columns_.size(); ++c) check_column(c);
  }

  /// Returns the world of the next line; nothing after the last one.
  std::optional<World> world(std::size_t number) {
    if (!next()) return std::nullopt;
    const std::vector<std::string> values = cells(line_);
    if (values.size() != columns_.size())
      fail("line " + std::to_string(line_number_) + ": has " + counted(values.size(), "value") +
           ", but the first line names " + counted(columns_.size(), "column") +
           "; an empty value between commas keeps the scene's");
    World world{
        .scene = request_.scene,
        .jitter_seed = request_.jitter.seed + number,
        .name = "world " + std::to_string(number) + " (" + name_ + ", line " + std::to_string(line_number_) + ")"};
    std::vector<std::string> assigned;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (columns_[c] != seed_column) world.settings.emplace_back(columns_[c], values[c]);
      if (values[c].empty()) continue;
      if (columns_[c] != seed_column) assigned.push_back(columns_[c] + "=" + values[c]);
      at(c, [&] { set(world, columns_[c], values[c]); });
    }
    try {
      require_settings(parse_solver(request_.solver), assigned, world.scene.settings);
      check_jitter(request_.jitter, world.scene.settings);
    } catch (const InputError& error) {
      fail("line " + std::to_string(line_number_) + ": " + error.what());
    }
    return world;
  }

  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

 private:
  /// Goes to the next line that is not blank.
  bool next() {
    while (at_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      line_ = std::string_view(text_).substr(at_, end - at_);
      at_ = end + 1;
      ++line_number_;
      if (!trimmed(line_).empty()) return true;
    }
    return false;
  }

  void check_column(std::size_t c) const {
    const std::string& column = columns_[c];
    at(c, [&] {
      if (std::count(columns_.begin(), columns_.end(), column) > 1) throw InputError("occurs twice; leave one out");
      for (const Shared& own : shared)
        if (column == own.column) throw InputError(std::string(own.reason));
      if (column == seed_column && request_.jitter.largest == 0)
        throw InputError("is the seed of --jitter; give --jitter, too");
      if (column != seed_column) expect_setting(column);
    });
  }

  static void set(World& world, const std::string& column, const std::string& value) {
    if (column == seed_column)
      world.jitter_seed = seed_of(value);
    else
      set_in_scene(world.scene, column, value);
  }

  /// Calls f, whose InputError then names the line and the column.
  template <class F>
  void at(std::size_t column, F f) const {
    try {
      f();
    } catch (const InputError& error) {
      fail("line " + std::to_string(line_number_) + ", column '" + compare::shown(columns_[column]) +
           "': " + error.what());
    }
  }

  std::string name_, text_;
  const RunRequest& request_;
  std::vector<std::string> columns_;
  std::string_view line_;
  std::size_t at_ = 0, line_number_ = 0;
};

}  // namespace

std::vector<World> equal_worlds(const RunRequest& request, std::size_t count) {
  std::vector<World> worlds;
  for (std::size_t w = 0; w < count; ++w)
    worlds.push_back({.jitter_seed = request.jitter.seed + w, .name = "world " + std::to_string(w)});
  return worlds;
}

std::vector<World> read_worlds(const std::filesystem::path& file, const RunRequest& request, std::size_t count) {
  Table table(file, request);
  std::vector<World> worlds;
  while (std::optional<World> world = table.world(worlds.size())) {
    worlds.push_back(std::move(*world));
    if (worlds.size() > most_worlds) table.fail("has more than " + std::to_string(most_worlds) + " worlds");
  }
  if (worlds.empty()) table.fail("has no line behind its first; each line has the values of one world");
  if (count > 0 && count != worlds.size())
    table.fail("has " + counted(worlds.size(), "world") + ", --worlds says " + std::to_string(count) +
               "; leave --worlds out, or give as many lines");
  return worlds;
}

}  // namespace ogc::experiments

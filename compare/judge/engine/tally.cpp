#include "compare/judge/engine/tally.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "compare/judge/cases/generators.hpp"

namespace ogc::compare {

namespace {

constexpr std::size_t bin_count = 1u << 15;

std::size_t bin_of(double value) {
  const float x = static_cast<float>(std::min(value, double{std::numeric_limits<float>::max()}));
  return std::bit_cast<std::uint32_t>(x) >> 16;
}

void accumulate(GeneratorTally& sum, const GeneratorTally& row) {
  sum.cases += row.cases;
  sum.decisions += row.decisions;
  sum.grey += row.grey;
  sum.near += row.near;
  sum.mismatches += row.mismatches;
  sum.not_exact += row.not_exact;
}

}  // namespace

void Histogram::add(double value) {
  bins_.resize(bin_count);
  ++bins_[bin_of(value)];
  ++count_;
  maximum_ = std::max(maximum_, value);
}

void Histogram::add(const Histogram& other) {
  if (other.count_ == 0) return;
  bins_.resize(bin_count);
  for (std::size_t i = 0; i < bin_count; ++i) bins_[i] += other.bins_[i];
  count_ += other.count_;
  maximum_ = std::max(maximum_, other.maximum_);
}

double Histogram::quantile(double q) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_)));
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    below += bins_[i];
    if (below >= wanted && below > 0)
      return std::min(maximum_, double{std::bit_cast<float>(static_cast<std::uint32_t>(i) << 16)});
  }
  return 0;
}

std::vector<Histogram::Octave> Histogram::octaves(int lowest) const {
  std::vector<Octave> octaves;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    if (bins_[i] == 0) continue;
    const double edge = std::bit_cast<float>(static_cast<std::uint32_t>(i) << 16);
    const int exponent = edge > 0 ? std::max(lowest, std::ilogb(edge)) : lowest;
    while (octaves.empty() || octaves.back().exponent < exponent)
      octaves.push_back({octaves.empty() ? exponent : octaves.back().exponent + 1, 0});
    octaves.back().count += bins_[i];
  }
  return octaves;
}

Tally::Tally(Stage of) : stage(of), metrics(compare::metrics(of).size()) {}

void Tally::begin(const CaseName& name) {
  if (!row_ || current_.generator != name.generator) row_ = &generators[name.generator];
  current_ = name;
}

void Tally::count(std::uint64_t cases, std::uint64_t decisions, std::uint64_t grey, std::uint64_t near) {
  row_->cases += cases;
  row_->decisions += decisions;
  row_->grey += grey;
  row_->near += near;
}

std::optional<std::string> Tally::note_error(std::size_t metric, double value) {
  if (std::isnan(value)) value = std::numeric_limits<double>::infinity();
  MetricTally& tally = metrics[metric];
  const MetricInfo& info = compare::metrics(stage)[metric];
  if (tally.errors.count() == 0 || value > tally.errors.maximum()) tally.worst = current_;
  tally.errors.add(value);
  if (value <= info.tolerance) return std::nullopt;
  char numbers[128];
  std::snprintf(numbers, sizeof numbers, ": off by %.4g units of ", value);
  char accepted[64];
  std::snprintf(accepted, sizeof accepted, ", %g accepted", info.tolerance);
  return std::string(info.name) + numbers + std::string(info.unit) + accepted + "; ";
}

void Tally::mismatch(std::string message) {
  ++mismatched;
  if (++row_->mismatches <= listed) mismatches.push_back({current_, std::move(message)});
}

void Tally::add(const Tally& other) {
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    if (metrics[i].errors.count() == 0 || other.metrics[i].errors.maximum() > metrics[i].errors.maximum())
      metrics[i].worst = other.metrics[i].worst;
    metrics[i].errors.add(other.metrics[i].errors);
  }
  std::map<std::string, std::uint64_t> kept;
  for (const auto& [name, row] : generators) kept[name] = std::min(row.mismatches, listed);
  for (const Mismatch& item : other.mismatches)
    if (++kept[item.name.generator] <= listed) mismatches.push_back(item);
  for (const auto& [name, row] : other.generators) accumulate(generators[name], row);
  mismatched += other.mismatched;
  questions += other.questions;
  failures += other.failures;
  contestant_seconds += other.contestant_seconds;
  authority_seconds += other.authority_seconds;
}

GeneratorTally Tally::total() const {
  GeneratorTally sum;
  for (const auto& [name, row] : generators) accumulate(sum, row);
  return sum;
}

GeneratorTally Tally::generic_total() const {
  GeneratorTally sum;
  for (const auto& [name, row] : generators)
    if (find_generator(stage, name).generic) accumulate(sum, row);
  return sum;
}

std::vector<std::string> Tally::confined_to() const {
  std::vector<std::pair<std::uint64_t, std::string>> failing;
  std::uint64_t passing = 0, passing_groups = 0;
  for (const auto& [name, row] : generators) {
    if (row.mismatches > 0) {
      failing.emplace_back(row.mismatches, name);
    } else {
      passing += row.cases;
      ++passing_groups;
    }
  }
  if (failing.size() > std::min<std::size_t>(most_confined, passing_groups) || passing < least_passing) return {};
  std::ranges::sort(failing, std::greater{}, &std::pair<std::uint64_t, std::string>::first);
  std::vector<std::string> names;
  for (auto& [count, name] : failing) names.push_back(std::move(name));
  return names;
}

double Tally::grey_share() const {
  const GeneratorTally sum = generic_total();
  return sum.decisions > 0 ? static_cast<double>(sum.grey) / static_cast<double>(sum.decisions) : 0;
}

double Tally::near_share() const {
  const GeneratorTally sum = total();
  return sum.cases > 0 ? static_cast<double>(sum.near) / static_cast<double>(sum.cases) : 0;
}

bool Tally::grey_within_limit() const {
  const GeneratorTally sum = generic_total();
  const double mean = static_cast<double>(sum.decisions) * grey_share_limit;
  return static_cast<double>(sum.grey) <= mean + 3 * std::sqrt(mean) + 3;
}

}  // namespace ogc::compare

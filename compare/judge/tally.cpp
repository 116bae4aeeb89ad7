#include "compare/judge/tally.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>

#include "compare/judge/generators.hpp"
#include "compare/problem/contestant.hpp"

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

constexpr std::array<MetricInfo, 3> face_metrics{{{"distance", "u max(d, Σ|δ|)", closest_face_distance_tolerance},
                                                  {"weights", "u cond", closest_face_weight_tolerance},
                                                  {"distance_below", "u max(d, Σ|δ|)", closest_face_below_tolerance}}};
constexpr std::array<MetricInfo, 3> points_metrics{
    {{"contact_distance", "u max(d, Σ|δ|)", closest_points_distance_tolerance},
     {"parameters", "u cond", closest_points_parameter_tolerance},
     {"distance_below", "u max(d, Σ|δ|)", closest_points_below_tolerance}}};
constexpr std::array<MetricInfo, 2> facet_metrics{{{"d_min_vertex", "u max(d, Σ|δ|)", detect_below_tolerance},
                                                   {"d_min_triangle", "u max(d, Σ|δ|)", detect_below_tolerance}}};
constexpr std::array<MetricInfo, 1> edge_metrics{{{"d_min_edge", "u max(d, Σ|δ|)", detect_below_tolerance}}};
constexpr std::array<MetricInfo, 1> bound_metrics{{{"bound", "u b", bound_below_tolerance}}};
constexpr std::array<MetricInfo, 3> activation_metrics{{{"energy", "u scale", activation_tolerance},
                                                        {"slope", "u scale", activation_tolerance},
                                                        {"curvature", "u scale", activation_tolerance}}};
constexpr std::array<MetricInfo, 1> truncate_metrics{{{"position", "u (|x_prev| + b)", truncate_position_tolerance}}};
constexpr std::array<MetricInfo, 2> contact_metrics{
    {{"force", "u cond", contact_force_tolerance}, {"block", "u cond", contact_block_tolerance}}};
constexpr std::array<MetricInfo, 2> friction_metrics{
    {{"force", "u cond", friction_force_tolerance}, {"block", "u cond", friction_block_tolerance}}};
constexpr std::array<MetricInfo, 2> membrane_metrics{
    {{"force", "u cond", membrane_force_tolerance}, {"block", "u cond", membrane_block_tolerance}}};
constexpr std::array<MetricInfo, 3> step_metrics{{{"query_radius", "u r_q", step_query_radius_tolerance},
                                                  {"target", "u scale", initial_guess_target_tolerance},
                                                  {"velocity", "u |x − xᵗ|/h", step_velocity_tolerance}}};
constexpr std::array<MetricInfo, 1> sweep_metrics{{{"position", "accepted error", 1}}};
constexpr std::array<MetricInfo, 2> bending_metrics{
    {{"force", "u cond", bending_force_tolerance}, {"block", "u cond", bending_block_tolerance}}};
constexpr std::array<MetricInfo, 2> spring_metrics{
    {{"force", "u cond", spring_force_tolerance}, {"block", "u cond", spring_block_tolerance}}};

constexpr std::array<MetricInfo, 8> rest_state_metrics{{{"mass", "u cond", rest_state_tolerance},
                                                        {"area", "u cond", rest_state_tolerance},
                                                        {"gradient", "u cond", rest_state_tolerance},
                                                        {"edge_length_squared", "u cond", rest_state_tolerance},
                                                        {"rest_angle", "u cond", rest_state_angle_tolerance},
                                                        {"stiffness", "u cond", rest_state_tolerance},
                                                        {"weight", "u cond", rest_state_tolerance},
                                                        {"meeting", "u value", rest_state_tolerance}}};
constexpr std::array<MetricInfo, 2> initial_guess_metrics{
    {{"target", "u scale", initial_guess_target_tolerance},
     {"position", "u (|x_prev| + b)", truncate_position_tolerance}}};

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

std::span<const MetricInfo> metrics(Stage stage) {
  switch (stage) {
    case Stage::closest_face: return face_metrics;
    case Stage::closest_points: return points_metrics;
    case Stage::detect_vertex_facet: return facet_metrics;
    case Stage::detect_edge_edge: return edge_metrics;
    case Stage::rest_state: return rest_state_metrics;
    case Stage::block: return {};
    case Stage::initial_guess: return initial_guess_metrics;
    case Stage::bound: return bound_metrics;
    case Stage::activation: return activation_metrics;
    case Stage::contact_force: return contact_metrics;
    case Stage::friction_force: return friction_metrics;
    case Stage::membrane: return membrane_metrics;
    case Stage::bending: return bending_metrics;
    case Stage::spring: return spring_metrics;
    case Stage::sweep: return sweep_metrics;
    case Stage::step: return step_metrics;
    default: return truncate_metrics;
  }
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

// Counts for the judge. Tallies of batches add up in the order of the batches, so a report is the same on any number of
// threads.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/stage_traits.hpp"

namespace ogc::compare {

/// Errors ≥ 0 in bins of 1 % (the top 15 bits of a float), so that quantiles need neither memory nor an order.
class Histogram {
 public:
  void add(double value);                         ///< infinite values count at the end
  void add(const Histogram& other);               ///< adds all of its values
  std::uint64_t count() const { return count_; }  ///< number of values
  double maximum() const { return maximum_; }     ///< exact; 0 where there are none
  /// Returns the smallest bin edge below which the share `q` of the values lies (within 1 %); 0 where there are none.
  double quantile(double q) const;
  /// The number of values in [2^exponent, 2^(exponent+1)). Octaves ascend without gaps; values below 2^lowest, also 0,
  /// count in the lowest one.
  struct Octave {
    int exponent = 0;         ///< of the lower end
    std::uint64_t count = 0;  ///< number of values
  };
  std::vector<Octave> octaves(int lowest) const;  ///< from octave `lowest` on

 private:
  std::vector<std::uint64_t> bins_;
  std::uint64_t count_ = 0;
  double maximum_ = 0;
};

/// A tolerance is loose where it is at least this many times the largest error: a kernel could become that much worse
/// and pass. A loose tolerance is tightened, or MetricInfo::loose_because gives the reason; a test finds loose
/// tolerances without a reason, and reasons without a loose tolerance.
inline constexpr double loose_factor = 50;

/// The errors of one metric.
struct MetricTally {
  Histogram errors;  ///< in units of the metric
  CaseName worst;    ///< case of the largest error
  /// Returns the factor by which the largest error stays below the tolerance; infinite where all errors are 0.
  double room(const MetricInfo& info) const { return info.tolerance / errors.maximum(); }
  bool is_loose(const MetricInfo& info) const { return errors.count() > 0 && !(room(info) <= loose_factor); }
};

/// A wrong answer.
struct Mismatch {
  CaseName name;        ///< the case
  std::string message;  ///< which element of the answer is wrong, and how
};

/// Counts of one generator, or of several.
struct GeneratorTally {
  /// counts that Tally::count takes, and mismatches
  std::uint64_t cases = 0, decisions = 0, grey = 0, near = 0, mismatches = 0;
  /// grey decisions whose accepted answer is not the exact one, or not one of its side of a jump
  std::uint64_t not_exact = 0;
};

/// Counts of one stage. A case of a mesh stage is one vertex (rest_state, bound, detect_vertex_facet), edge
/// (detect_edge_edge) or question (block), of step one vertex at one event.
class Tally {
 public:
  explicit Tally(Stage stage);
  /// Assigns all that follows to this case, until the next call.
  void begin(const CaseName& name);
  /// Adds counts. `near` is the number of cases within 2¹⁰ ulp of a decision boundary (near_factor), where the stage
  /// has one.
  void count(std::uint64_t cases, std::uint64_t decisions, std::uint64_t grey, std::uint64_t near = 0);
  /// Adds an error in units of the metric. Beyond the tolerance it is a mismatch, described by the numbers and `where`,
  /// which is called only then.
  template <class Where>
  void error(std::size_t metric, double value, const Where& where) {
    if (const auto excess = note_error(metric, value)) mismatch(*excess + where());
  }
  void mismatch(std::string message);  ///< notes a wrong answer to the present case
  /// Counts grey decisions whose accepted answer is not the exact one.
  void answered_not_exactly(std::uint64_t count = 1) { row_->not_exact += count; }
  void add(const Tally& other);

  Stage stage;                                       ///< the stage of the cases
  std::vector<MetricTally> metrics;                  ///< in the order of metrics(stage)
  std::map<std::string, GeneratorTally> generators;  ///< by name
  std::vector<Mismatch> mismatches;                  ///< the first ones of each generator, at most `listed`
  std::uint64_t mismatched = 0;                      ///< number of all mismatches
  std::uint64_t questions = 0;                       ///< generated cases: in a mesh stage meshes, sweeps or steps
  std::uint64_t failures = 0;  ///< number of those to which the contestant gave no answer (ContestantFailure)
  double contestant_seconds = 0, authority_seconds = 0;  ///< time of each side's answers alone
  static constexpr std::uint64_t listed = 20;            ///< largest number of mismatches kept of each generator

  GeneratorTally total() const;  ///< sum over all generators
  /// Returns the sum over the generic generators.
  GeneratorTally generic_total() const;
  /// Returns the few generators that all mismatches come from, worst first, if other generators have enough cases that
  /// pass (`least_passing`); empty where failures are spread, or there are none.
  std::vector<std::string> confined_to() const;
  static constexpr std::size_t most_confined = 3;      ///< largest number that counts as few
  static constexpr std::uint64_t least_passing = 100;  ///< cases of other generators
  /// Returns the share of grey decisions among all decisions of the generic generators.
  double grey_share() const;
  /// Returns the share of cases within 2¹⁰ ulp of a decision boundary.
  double near_share() const;
  /// Checks whether the share is compatible with grey_share_limit: of n decisions m = n · limit may be grey, and chance
  /// may add 3 √m + 3 (a Poisson count of mean m lies higher in less than one run of a hundred).
  bool grey_within_limit() const;

 private:
  /// Adds an error; returns a text where it lies beyond the tolerance.
  std::optional<std::string> note_error(std::size_t metric, double value);

  CaseName current_;
  GeneratorTally* row_ = nullptr;
};

}  // namespace ogc::compare

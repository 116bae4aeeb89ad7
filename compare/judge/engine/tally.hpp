// Counts the judge's results. Tallies of batches are added in the order of the batches, so a report does not depend on
// the number of threads.
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

/// Counts errors ≥ 0 in bins of 1 % (the top 15 bits of a float), so that quantiles do not need a list of errors.
class Histogram {
 public:
  void add(double value);                         ///< counts infinite values in the last bin
  void add(const Histogram& other);               ///< adds all counts of another histogram
  std::uint64_t count() const { return count_; }  ///< number of values
  double maximum() const { return maximum_; }     ///< exact; 0 if there are no values
  /// Returns the `q`-quantile of the values, as a bin edge (within 1 %); 0 if there are no values.
  double quantile(double q) const;
  /// The number of values in [2^exponent, 2^(exponent+1)). Octaves ascend without gaps. The lowest octave also counts
  /// all smaller values, including 0.
  struct Octave {
    int exponent = 0;         ///< exponent of the octave's lower end
    std::uint64_t count = 0;  ///< number of values
  };
  std::vector<Octave> octaves(int lowest) const;  ///< begins at octave `lowest`

 private:
  std::vector<std::uint64_t> bins_;
  std::uint64_t count_ = 0;
  double maximum_ = 0;
};

/// A tolerance is loose if it is at least this many times the largest error, because a kernel could get that much worse
/// and still pass. A loose tolerance is tightened, or MetricInfo::loose_because states the reason. A test finds loose
/// tolerances without a reason, and reasons for tolerances that are not loose.
inline constexpr double loose_factor = 50;

/// The errors of one metric.
struct MetricTally {
  Histogram errors;  ///< in units of the metric
  CaseName worst;    ///< case of the largest error
  /// Returns the tolerance divided by the largest error; infinite if all errors are 0.
  double room(const MetricInfo& info) const { return info.tolerance / errors.maximum(); }
  bool is_loose(const MetricInfo& info) const { return errors.count() > 0 && !(room(info) <= loose_factor); }
};

/// A wrong answer.
struct Mismatch {
  CaseName name;        ///< wrong case
  std::string message;  ///< the wrong element of the answer, and the error
};

/// Counts of one generator, or of several.
struct GeneratorTally {
  /// counts as in Tally::count, and the number of mismatches
  std::uint64_t cases = 0, decisions = 0, grey = 0, near = 0, mismatches = 0;
  /// grey decisions whose accepted answer is not the exact one
  std::uint64_t not_exact = 0;
};

/// Counts of one stage. In a mesh stage a case is
/// - a vertex (rest_state, bound, detect_vertex_facet), an edge (detect_edge_edge) or a question (block),
/// - in stage step a vertex at one event, that is, after one detection, guess round or sweep.
class Tally {
 public:
  explicit Tally(Stage stage);
  /// Assigns all following counts to this case, until the next call.
  void begin(const CaseName& name);
  /// Adds counts. `near` is the number of cases within 2¹⁰ ulp of a decision boundary (near_factor); 0 in a stage
  /// without decision boundaries.
  void count(std::uint64_t cases, std::uint64_t decisions, std::uint64_t grey, std::uint64_t near = 0);
  /// Adds an error in units of the metric. An error above the tolerance is a mismatch. The message of the mismatch has
  /// the numbers and the text of `where`, which is called only for a mismatch.
  template <class Where>
  void error(std::size_t metric, double value, const Where& where) {
    if (const auto excess = note_error(metric, value)) mismatch(*excess + where());
  }
  void mismatch(std::string message);  ///< notes a wrong answer to the current case
  /// Counts grey decisions whose accepted answer is not the exact one.
  void answered_not_exactly(std::uint64_t count = 1) { row_->not_exact += count; }
  void add(const Tally& other);

  Stage stage;                                       ///< stage of the cases
  std::vector<MetricTally> metrics;                  ///< in the order of metrics(stage)
  std::map<std::string, GeneratorTally> generators;  ///< by name
  std::vector<Mismatch> mismatches;                  ///< the first mismatches of each generator, at most `listed`
  std::uint64_t mismatched = 0;                      ///< number of all mismatches
  std::uint64_t questions = 0;  ///< generated cases; in a mesh stage these are meshes, sweeps or steps
  std::uint64_t failures = 0;   ///< questions to which the contestant gave no answer (ContestantFailure)
  double contestant_seconds = 0, authority_seconds = 0;  ///< time of the answers of each
  static constexpr std::uint64_t listed = 20;            ///< largest number of listed mismatches for each generator

  GeneratorTally total() const;  ///< sum over all generators
  /// Returns the sum over the generic generators.
  GeneratorTally generic_total() const;
  /// Returns the generators with mismatches, the one with the most mismatches first. Returns an empty list if they are
  /// more than `most_confined` or more than the other generators, or if these have fewer than `least_passing` cases.
  std::vector<std::string> confined_to() const;
  static constexpr std::size_t most_confined = 3;      ///< largest number of generators in the list
  static constexpr std::uint64_t least_passing = 100;  ///< fewest passing cases of other generators
  /// Returns the share of grey decisions among all decisions of the generic generators.
  double grey_share() const;
  /// Returns the share of cases within 2¹⁰ ulp of a decision boundary.
  double near_share() const;
  /// Checks whether grey_share() is compatible with grey_share_limit. On average m = n · limit of n decisions may be
  /// grey. 3 √m + 3 more are allowed, because a Poisson count of mean m exceeds this number in less than one run of a
  /// hundred.
  bool grey_within_limit() const;

 private:
  /// Adds an error; returns a text if the error is above the tolerance.
  std::optional<std::string> note_error(std::size_t metric, double value);

  CaseName current_;
  GeneratorTally* row_ = nullptr;
};

}  // namespace ogc::compare

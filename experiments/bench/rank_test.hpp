// Decides whether two sets of times differ beyond noise, without a model of the noise. The Mann–Whitney test computes
// how often a random order of all times would separate the two sets as clearly as they are separated. Percentages are
// no criterion: a change of 1 % may be certain, and one of 30 % may be noise.
#pragma once

#include <span>
#include <vector>

namespace ogc::experiments {

/// Returns the probability that U is at least as far from its mean as measured, if both sets come from one
/// distribution; 1 if a set is empty. U is the number of pairs whose value in `after` exceeds that in `before`. The
/// result is exact, by counting orders, if no two values are equal and each set has at most 50 values. Otherwise it is
/// the normal approximation with corrections for ties and continuity.
double mann_whitney(std::span<const double> before, std::span<const double> after);

/// Returns the smallest probability that mann_whitney can return for sets of n = `before` and m = `after` values: 2 /
/// (n + m choose n), at most 1.
double smallest_probability(std::size_t before, std::size_t after);

/// Returns the probabilities with Holm's correction for several tests, at most 1, in the order of the input. If each
/// result is compared with a level, the chance of any false alarm is below this level.
std::vector<double> holm(std::span<const double> probabilities);

/// Returns the median of all quotients after / before (Hodges and Lehmann's estimate, for logarithms); not-a-number if
/// a set is empty.
double typical_ratio(std::span<const double> before, std::span<const double> after);

/// Returns the median; for an even number of values, the mean of the middle two. Not-a-number if there are no values.
double median(std::vector<double> values);

}  // namespace ogc::experiments

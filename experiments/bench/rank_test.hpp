// Decides whether two sets of times differ beyond noise, without a model of the noise: the Mann–Whitney test computes
// how often a random order of all times would separate the two sets as well as they are separated. It does not use
// percentages: a change of 1 % may be certain, one of 30 % noise.
#pragma once

#include <span>
#include <vector>

namespace ogc::experiments {

/// Returns the probability, under the hypothesis that both sets come from one distribution, of a U statistic at least
/// as far from its mean. It is exact, by counting orders, while no two values are equal and the sets have at most 50
/// values each; otherwise the normal approximation with the correction for ties and for continuity. 1 if a set is
/// empty.
double mann_whitney(std::span<const double> before, std::span<const double> after);

/// Returns the smallest probability that sets of these sizes can have: 2 / (n + m choose n), at most 1.
double smallest_probability(std::size_t before, std::size_t after);

/// Applies Holm's correction: the i-th probability is multiplied so that among all of them the chance of one false
/// alarm stays below the level that the result is compared with. In the order of the input, at most 1.
std::vector<double> holm(std::span<const double> probabilities);

/// Returns the median of all quotients after / before (Hodges and Lehmann's shift, in logarithms). Not-a-number if a
/// set is empty.
double typical_ratio(std::span<const double> before, std::span<const double> after);

/// Returns the median; the mean of the middle two of an even number. Not-a-number if there are no values.
double median(std::vector<double> values);

}  // namespace ogc::experiments

// Projects symmetric matrices to positive semidefinite ones, several matrices side by side. For one matrix most of the
// time is a chain of dependent roots and quotients; side by side the chains of several matrices hide each other's
// latency.
//
// The method is Householder's reduction to a tridiagonal matrix, then QL with implicit shifts (Bowdler, Martin, Reinsch
// and Wilkinson 1968). Each lane works on its own part of its matrix; the rotations of a finished lane are identities.
// Reduction and QL are changes of basis, so the eigenvalues are off by at most some roundings of the largest one. QL
// neglects entries beside the diagonal that are below 2⁻⁵³ of the largest entry.
#pragma once

#include "reference/energies/stencils/lanes.hpp"

namespace ogc::reference {
inline namespace OGC_LANES {

/// Rows of the lower triangle, in the order of Second::bend.
template <std::size_t N, class Number>
using LowerTriangle = std::array<Number, N*(N + 1) / 2>;

constexpr std::size_t lower(std::size_t i, std::size_t j) { return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i; }

/// Holds the eigenvalues of symmetric matrices, one matrix per lane, with N rows and entries of at most 1. column[k] is
/// the eigenvector of value[k].
template <std::size_t N, std::size_t Packs>
class Eigensystem {
 public:
  using L = Lanes<Packs>;
  using M = Mask<Packs>;
  std::array<L, N> value;
  std::array<std::array<L, N>, N> column;

  explicit Eigensystem(LowerTriangle<N, L> a) {
    reduce(a);
    for (std::size_t k = 0; k < N; ++k) value[k] = a[lower(k, k)];
    for (std::size_t first = 0; first + 1 < N; ++first)
      for (int sweep = 0; sweep < most_sweeps; ++sweep)
        if (!turn(first)) break;
  }

 private:
  static constexpr int most_sweeps = 30;         ///< sweeps of one eigenvalue; two are usual
  static constexpr double negligible = 0x1p-53;  ///< largest neglected entry beside the diagonal
  static constexpr double nothing = 0x1p-400;    ///< squares below it belong to entries that are negligible beside 1

  std::array<L, N> beside_;  ///< entries beside the diagonal: entry i couples i and i + 1; the last one is not read

  /// Reduces `a` to a tridiagonal matrix and writes the basis of this matrix to `column`.
  void reduce(LowerTriangle<N, L>& a) {
    std::array<std::array<L, N>, N> mirror;  // v of each reflection I − β v vᵀ
    std::array<L, N> beta;
    for (std::size_t k = 0; k + 2 < N; ++k) {
      L tail(0.0);
      for (std::size_t i = k + 2; i < N; ++i) tail += a[lower(i, k)] * a[lower(i, k)];
      const L head = a[lower(k + 1, k)], size = sqrt(head * head + tail), turned = select(head > L(0.0), -size, size);
      const M acts = tail > L(nothing);
      std::array<L, N>& v = mirror[k];
      v[k + 1] = head - turned;
      for (std::size_t i = k + 2; i < N; ++i) v[i] = a[lower(i, k)];
      beta[k] = select(acts, L(1.0) / select(acts, size * (size + abs(head)), L(1.0)), L(0.0));
      beside_[k] = select(acts, turned, head);
      std::array<L, N> w;
      L along(0.0);
      for (std::size_t i = k + 1; i < N; ++i) {
        L sum(0.0);
        for (std::size_t j = k + 1; j < N; ++j) sum += a[lower(i, j)] * v[j];
        w[i] = beta[k] * sum;
        along += v[i] * w[i];
      }
      const L half = L(0.5) * beta[k] * along;
      for (std::size_t i = k + 1; i < N; ++i) w[i] -= half * v[i];
      for (std::size_t i = k + 1; i < N; ++i)
        for (std::size_t j = k + 1; j <= i; ++j) a[lower(i, j)] -= v[i] * w[j] + w[i] * v[j];
    }
    if constexpr (N > 1) beside_[N - 2] = a[lower(N - 1, N - 2)];
    beside_[N - 1] = L(0.0);
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j < N; ++j) column[i][j] = L(i == j ? 1.0 : 0.0);
    for (std::size_t k = N - 2; k-- > 0;)
      for (std::size_t j = k + 1; j < N; ++j) {
        L sum(0.0);
        for (std::size_t i = k + 1; i < N; ++i) sum += mirror[k][i] * column[j][i];
        sum *= beta[k];
        for (std::size_t i = k + 1; i < N; ++i) column[j][i] -= sum * mirror[k][i];
      }
  }

  /// Does one QL sweep for the eigenvalue `first`. In each lane the sweep runs from the last row of a block to the
  /// block's first row, `first`. The block ends at the first negligible entry beside the diagonal. Returns false if
  /// this eigenvalue is already found in all lanes.
  bool turn(std::size_t first) {
    L last(static_cast<double>(N - 1));
    for (std::size_t k = N - 1; k-- > first;)
      last = select(abs(beside_[k]) <= L(negligible), L(static_cast<double>(k)), last);
    const M runs = last > L(static_cast<double>(first));
    if (!runs.any()) return false;
    L end(0.0);
    for (std::size_t k = first + 1; k < N; ++k) end = select(last == L(static_cast<double>(k)), value[k], end);
    const L next = select(runs, beside_[first], L(1.0)), slope = (value[first + 1] - value[first]) / (L(2.0) * next);
    const L root = sqrt(slope * slope + L(1.0));
    L g = end - value[first] + next / (slope + select(slope < L(0.0), -root, root)), sine(1.0), cosine(1.0), p(0.0);
    M goes = runs;
    for (std::size_t i = N - 1; i-- > first;) {
      const M at_work = goes && L(static_cast<double>(i)) < last;
      if (!at_work.any()) continue;
      const L f = sine * beside_[i], b = cosine * beside_[i], square = f * f + g * g;
      // r/r² is 1/r up to a rounding, and the processor computes root and quotient in parallel.
      const L r = sqrt(square), inverse = r * (L(1.0) / square);
      const M turns = at_work && square > L(nothing), ends = at_work && !turns;
      const L s = f * inverse, c = g * inverse, before = value[i + 1] - p, t = (value[i] - before) * s + L(2.0) * c * b,
              q = s * t;
      beside_[i + 1] = select(turns, r, select(ends, L(0.0), beside_[i + 1]));
      value[i + 1] = select(turns, before + q, select(ends, before, value[i + 1]));
      g = select(turns, c * t - b, g);
      p = select(turns, q, p);
      sine = select(turns, s, sine);
      cosine = select(turns, c, cosine);
      goes = goes && !ends;
      const L across = select(turns, s, L(0.0)), keeps = select(turns, c, L(1.0));
      for (std::size_t k = 0; k < N; ++k) {
        const L upper = column[i + 1][k], here = column[i][k];
        column[i + 1][k] = across * here + keeps * upper;
        column[i][k] = keeps * here - across * upper;
      }
    }
    value[first] = select(goes, value[first] - p, value[first]);
    beside_[first] = select(goes, g, beside_[first]);
    for (std::size_t k = first; k < N; ++k)
      beside_[k] = select(runs && last == L(static_cast<double>(k)), L(0.0), beside_[k]);
    return true;
  }
};

/// Returns the lanes whose matrix needs no projection: all pivots of Gaussian elimination are positive, or all entries
/// are 0. This costs a hundredth of computing the eigenvalues.
template <std::size_t N, std::size_t Packs>
Mask<Packs> needs_none(LowerTriangle<N, Lanes<Packs>> a, const Lanes<Packs>& largest) {
  using L = Lanes<Packs>;
  Mask<Packs> definite = largest == largest;
  for (std::size_t k = 0; k < N; ++k) {
    const L pivot = a[lower(k, k)];
    definite = definite && pivot > L(0.0);
    const L inverse = L(1.0) / pivot;
    for (std::size_t i = k + 1; i < N; ++i) {
      const L share = a[lower(i, k)] * inverse;
      for (std::size_t j = k + 1; j <= i; ++j) a[lower(i, j)] -= share * a[lower(j, k)];
    }
  }
  return definite || largest == L(0.0);
}

/// Replaces each negative eigenvalue by 0 or, with `absolute`, by its modulus; leaves matrices without negative
/// eigenvalues unchanged, to the bit.
template <std::size_t N, std::size_t Packs>
[[gnu::noinline]] void project(LowerTriangle<N, Lanes<Packs>>& h, bool absolute) {
  using L = Lanes<Packs>;
  L largest(0.0);
  for (const L& entry : h) largest = max(abs(entry), largest);
  const Mask<Packs> stays = needs_none<N, Packs>(h, largest);
  if (stays.all()) return;
  const L inverse = L(1.0) / select(stays, L(1.0), largest);
  LowerTriangle<N, L> scaled;
  for (std::size_t k = 0; k < h.size(); ++k) scaled[k] = select(stays, L(0.0), h[k] * inverse);
  const Eigensystem<N, Packs> system(scaled);
  const L factor = select(stays, L(0.0), (absolute ? L(-2.0) : L(-1.0)) * largest);
  for (std::size_t k = 0; k < N; ++k) {
    const Mask<Packs> negative = system.value[k] < L(0.0);
    if (!negative.any()) continue;
    const L missing = select(negative, factor * system.value[k], L(0.0));
    for (std::size_t i = 0; i < N; ++i) {
      const L row = missing * system.column[k][i];
      for (std::size_t j = 0; j <= i; ++j) h[lower(i, j)] += row * system.column[k][j];
    }
  }
}

}  // namespace OGC_LANES
}  // namespace ogc::reference

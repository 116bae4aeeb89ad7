// Differentiates a batch of stencils in three passes. The first differentiates the energies, one pack of lanes after
// another. The second projects the Hessians of the whole batch. The third transforms the derivatives back to the
// vertices. Files that are compiled for several machines include this file.
#pragma once

#include <utility>

#include "reference/energies/stencils/projection.hpp"
#include "reference/energies/stencils/stencil_kernels.hpp"

namespace ogc::reference {
inline namespace OGC_LANES {

using One = Lanes<1>;

/// Fills the lanes; `of(lane)` returns the value of a lane.
template <class Of>
void pack(One& to, Of of) {
  for (std::size_t lane = 0; lane < One::width; ++lane) to.part[0][lane] = of(lane);
}
template <class T, std::size_t N, class Of>
void pack(std::array<T, N>& to, Of of) {
  for (std::size_t i = 0; i < N; ++i)
    pack(
        to[i], [&](std::size_t lane) -> const auto& { return of(lane)[i]; });
}

using LaneNumbers = std::array<std::size_t, One::width>;

/// Returns the constants of some stencils of a batch, one stencil in each lane.
template <template <class> class TermOf, class Terms>
TermOf<One> packed(const Terms& terms, const LaneNumbers& stencil) {
  TermOf<One> all;
  all.kinds() = terms[stencil[0]]->kinds();
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (pack(
         std::get<I>(all.numbers()),
         [&](std::size_t lane) -> const auto& { return std::get<I>(terms[stencil[lane]]->numbers()); }),
     ...);
  }
  (std::make_index_sequence<std::tuple_size_v<decltype(all.numbers())>>{});
  return all;
}

/// A kind of stencil whose energy depends on the differences of its `Count` vertices.
template <template <class> class Term, std::size_t Count>
struct ByDifferences {
  template <class Number>
  using TermOf = Term<Number>;
  static constexpr std::size_t count = Count, moving = Count - 1;
  template <class Corners>
  struct Coordinates {
    Coordinates(const Term<One>&, const Corners&) {}
    /// Returns the factor of vertex k in coordinate d, a linear combination of the vertices. The factor is 0 for k > d
    /// + 1.
    double share(std::size_t k, std::size_t d) const { return q[k][d]; }
    static constexpr auto q = without_translation<Count>();
  };
  template <class Corners>
  static auto energy(const Term<One>& term, const Corners& x, const Coordinates<Corners>& at) {
    std::array<Triple<Second<3 * moving, One>>, Count> variables;
    for (std::size_t k = 0; k < Count; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        variables[k][axis].value = x[k][axis];
        for (std::size_t d = 0; d < moving; ++d) variables[k][axis].slope[3 * d + axis] = at.share(k, d);
      }
    return term.energy(variables);
  }
};

/// A kind of stencil whose energy depends only on Σ wᵢ xᵢ. The only coordinate is Σ wᵢ xᵢ/‖w‖.
template <template <class> class Term>
struct ByWeights {
  template <class Number>
  using TermOf = Term<Number>;
  static constexpr std::size_t count = 4, moving = 1;
  template <class Corners>
  struct Coordinates {
    Coordinates(const Term<One>& term, const Corners&) : weight(term.weight) {
      One squared(0.0);
      for (const One& w : weight) squared += w * w;
      size = sqrt(squared);
      for (One& w : weight) w = w / size;
    }
    const One& share(std::size_t k, std::size_t) const { return weight[k]; }
    std::array<One, 4> weight;
    One size;
  };
  template <class Corners>
  static auto energy(const Term<One>& term, const Corners& x, const Coordinates<Corners>& at) {
    Triple<Second<3, One>> apart;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      apart[axis].value = term.weight[0] * x[0][axis];
      for (std::size_t k = 1; k < 4; ++k) apart[axis].value += term.weight[k] * x[k][axis];
      apart[axis].slope[axis] = at.size;
    }
    return term.energy_between(apart);
  }
};

template <class Kind>
class SideBySide {
 public:
  using Term = typename Kind::template TermOf<double>;
  static constexpr std::size_t count = Kind::count, size = 3 * Kind::moving;

  static void differentiate(const Batch<Term, count>& batch, HessianProjection projection) {
    SideBySide(batch, projection);
  }

 private:
  using Corners = std::array<Triple<One>, count>;
  using Coordinates = typename Kind::template Coordinates<Corners>;
  static constexpr std::size_t packs = batch_width / One::width;
  using Wide = Lanes<packs>;

  SideBySide(const Batch<Term, count>& batch, HessianProjection projection) : batch_(batch) {
    for (std::size_t first = 0; first < batch_width; first += One::width) evaluate(first);
    if (projection != HessianProjection::none) project_all(projection);
    for (std::size_t first = 0; first < batch.size; first += One::width) expand(first);
  }

  /// Returns the index of the stencil in each lane of a pack, from `first` on. Lanes beyond the end of the batch repeat
  /// its last stencil.
  LaneNumbers stencils(std::size_t first) const {
    LaneNumbers numbers;
    for (std::size_t lane = 0; lane < One::width; ++lane)
      numbers[lane] = first + lane < batch_.size ? first + lane : batch_.size - 1;
    return numbers;
  }
  Corners corners(const LaneNumbers& stencil) const {
    Corners x;
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        pack(x[k][axis], [&](std::size_t lane) {
          return batch_.corner[stencil[lane]][k][axis] - batch_.corner[stencil[lane]][0][axis];
        });
    return x;
  }
  bool is_uniform(const LaneNumbers& stencil) const {
    for (const std::size_t i : stencil)
      if (batch_.term[i]->kinds() != batch_.term[stencil[0]]->kinds()) return false;
    return true;
  }
  auto energy(const LaneNumbers& stencil) const {
    const auto term = packed<Kind::template TermOf>(batch_.term, stencil);
    const Corners x = corners(stencil);
    return Kind::energy(term, x, Coordinates(term, x));
  }

  /// Evaluates a pack of stencils together, or one by one if they take different branches.
  void evaluate(std::size_t first) {
    if (first >= batch_.size) return clear(first);
    const LaneNumbers all = stencils(first);
    lanes_differ = !is_uniform(all);
    if (!lanes_differ) store(energy(all), first);
    if (!lanes_differ) return;
    for (std::size_t lane = 0; lane < One::width && first + lane < batch_.size; ++lane) {
      LaneNumbers alone;
      alone.fill(all[lane]);
      const auto e = energy(alone);
      energy_[first + lane] = e.value.part[0][0];
      for (std::size_t i = 0; i < size; ++i) slope_[i][first + lane] = e.slope[i].part[0][0];
      for (std::size_t i = 0; i < bend_.size(); ++i) bend_[i][first + lane] = e.bend(i).part[0][0];
    }
  }
  void store(const Second<size, One>& e, std::size_t first) {
    e.value.store(&energy_[first]);
    for (std::size_t i = 0; i < size; ++i) e.slope[i].store(&slope_[i][first]);
    for (std::size_t i = 0; i < bend_.size(); ++i) e.bend(i).store(&bend_[i][first]);
  }
  void clear(std::size_t first) { store(Second<size, One>(0.0), first); }

  void project_all(HessianProjection projection) {
    LowerTriangle<size, Wide> h;
    for (std::size_t i = 0; i < h.size(); ++i) h[i] = Wide::load(bend_[i].data());
    project<size, packs>(h, projection == HessianProjection::absolute);
    for (std::size_t i = 0; i < h.size(); ++i) h[i].store(bend_[i].data());
  }

  /// Transforms derivatives from the coordinates back to the vertices.
  void expand(std::size_t first) {
    const LaneNumbers stencil = stencils(first);
    const Coordinates at(packed<Kind::template TermOf>(batch_.term, stencil), Corners{});
    const auto bend = [&](std::size_t i, std::size_t j) { return One::load(&bend_[lower(i, j)][first]); };
    std::array<double, 3 * count * One::width> gradient;
    std::array<double, lower(3 * count, 0) * One::width> hessian;
    for (std::size_t row = 0; row < 3 * count; ++row) {
      const std::size_t k = row / 3, axis = row % 3;
      One along(0.0);
      std::array<One, size> half;
      half.fill(One(0.0));
      for (std::size_t d = first_coordinate(k); d < Kind::moving; ++d) {
        along += at.share(k, d) * One::load(&slope_[3 * d + axis][first]);
        for (std::size_t j = 0; j < size; ++j) half[j] += at.share(k, d) * bend(3 * d + axis, j);
      }
      along.store(&gradient[row * One::width]);
      for (std::size_t column = 0; column <= row; ++column) {
        One entry(0.0);
        for (std::size_t d = first_coordinate(column / 3); d < Kind::moving; ++d)
          entry += half[3 * d + column % 3] * at.share(column / 3, d);
        entry.store(&hessian[lower(row, column) * One::width]);
      }
    }
    for (std::size_t lane = 0; lane < One::width && first + lane < batch_.size; ++lane)
      scatter(first + lane, gradient.data() + lane, hessian.data() + lane);
  }
  static constexpr std::size_t first_coordinate(std::size_t vertex) {
    return Kind::moving == count - 1 && vertex > 0 ? vertex - 1 : 0;
  }

  /// Writes the derivatives of one lane. In `gradient` and `hessian`, the entries of a lane are One::width apart.
  void scatter(std::size_t stencil, const double* gradient, const double* hessian) const {
    StencilDerivatives& to = *batch_.result[stencil];
    to.energy = energy_[stencil];
    const auto write = [&](auto place) {
      for (std::size_t row = 0; row < 3 * count; ++row) {
        const std::size_t to_row = 3 * place(row / 3) + row % 3;
        to.gradient[to_row] = gradient[row * One::width];
        for (std::size_t column = 0; column <= row; ++column) {
          const std::size_t to_column = 3 * place(column / 3) + column % 3;
          to.hessian[12 * to_row + to_column] = to.hessian[12 * to_column + to_row] =
              hessian[lower(row, column) * One::width];
        }
      }
    };
    if constexpr (count < 4) {
      to.gradient.fill(0);
      to.hessian.fill(0);
      const auto& place = batch_.place[stencil];
      write([&](std::size_t k) { return std::size_t{place[k]}; });
    } else {
      // All four places are used, so the corners are in the order of the places.
      write([](std::size_t k) { return k; });
    }
  }

  const Batch<Term, count>& batch_;
  std::array<double, batch_width> energy_;
  std::array<std::array<double, batch_width>, size> slope_;
  std::array<std::array<double, batch_width>, size*(size + 1) / 2> bend_;
};

}  // namespace OGC_LANES
}  // namespace ogc::reference

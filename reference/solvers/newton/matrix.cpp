#include "reference/solvers/newton/matrix.hpp"

#include <algorithm>
#include <iterator>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace ogc::reference {
namespace {

std::uint64_t key(std::uint64_t column, std::uint64_t row) { return column << 32 | row; }
std::size_t column_of(std::uint64_t block) { return block >> 32; }
std::size_t row_of(std::uint64_t block) { return block & 0xffffffff; }

/// A kept pattern is replaced by a smaller one if it has more than this many times the needed blocks. Replacing it
/// costs a new symbolic factorisation.
constexpr double most_spare = 1.25;

}  // namespace

BlockMatrix::BlockMatrix(const std::vector<Mobility>& mobility) : number_(mobility.size(), -1) {
  for (std::size_t v = 0; v < mobility.size(); ++v) {
    if (mobility[v] != Mobility::free) continue;
    number_[v] = static_cast<std::int32_t>(free_.size());
    free_.push_back(v);
  }
}

bool BlockMatrix::earlier(const Share& a, const Share& b) {
  return a.block != b.block ? a.block < b.block : a.stencil != b.stencil ? a.stencil < b.stencil : a.row < b.row;
}

std::vector<BlockMatrix::Share> BlockMatrix::shares_of(std::span<const StencilVertices> stencils,
                                                       std::size_t first) const {
  std::vector<Share> shares;
  for (std::size_t i = first; i < stencils.size(); ++i) {
    const StencilVertices& vertex = stencils[i];
    for (std::uint8_t k = 0; k < 4 && vertex[k] >= 0; ++k)
      for (std::uint8_t l = 0; l < 4 && vertex[l] >= 0; ++l) {
        const std::int32_t row = number_[static_cast<std::size_t>(vertex[k])],
                           column = number_[static_cast<std::size_t>(vertex[l])];
        if (column >= 0 && row >= column)
          shares.push_back({key(static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row)),
                            static_cast<std::uint32_t>(i), k, l});
      }
  }
  tbb::parallel_sort(shares.begin(), shares.end(), earlier);
  return shares;
}

/// Returns the keys of all blocks to which stencils or the diagonal are added, ascending.
std::vector<std::uint64_t> BlockMatrix::needed_blocks() const {
  std::vector<std::uint64_t> shared, diagonal, needed;
  for (const Share& share : shares_)
    if (shared.empty() || shared.back() != share.block) shared.push_back(share.block);
  for (std::size_t i = 0; i < free_.size(); ++i) diagonal.push_back(key(i, i));
  std::set_union(shared.begin(), shared.end(), diagonal.begin(), diagonal.end(), std::back_inserter(needed));
  return needed;
}

bool BlockMatrix::set_stencils(std::span<const StencilVertices> stencils, std::size_t steady) {
  if (steady != steady_) {
    steady_shares_ = shares_of(stencils.first(steady), 0);
    steady_ = steady;
  }
  const std::vector<Share> others = shares_of(stencils, steady);
  shares_.clear();
  std::merge(steady_shares_.begin(), steady_shares_.end(), others.begin(), others.end(), std::back_inserter(shares_),
             earlier);
  std::vector<std::uint64_t> needed = needed_blocks();
  const bool holds = std::includes(blocks_.begin(), blocks_.end(), needed.begin(), needed.end()) &&
                     static_cast<double>(blocks_.size()) <= most_spare * static_cast<double>(needed.size());
  if (!holds) set_pattern(std::move(needed));
  share_begin_.assign(blocks_.size() + 1, shares_.size());
  for (std::size_t block = 0, share = 0; block < blocks_.size(); ++block) {
    while (share < shares_.size() && shares_[share].block < blocks_[block]) ++share;
    share_begin_[block] = share;
  }
  return !holds;
}

void BlockMatrix::set_pattern(std::vector<std::uint64_t> blocks) {
  blocks_ = std::move(blocks);
  block_begin_.assign(free_.size() + 1, blocks_.size());
  for (std::size_t b = blocks_.size(); b-- > 0;) block_begin_[column_of(blocks_[b])] = b;
  column_begin_.assign(1, 0);
  row_index_.clear();
  for (std::size_t column = 0; column < free_.size(); ++column)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t b = block_begin_[column]; b < block_begin_[column + 1]; ++b)
        for (std::size_t r = b == block_begin_[column] ? axis : 0; r < 3; ++r)
          row_index_.push_back(static_cast<std::int32_t>(3 * row_of(blocks_[b]) + r));
      column_begin_.push_back(static_cast<std::int32_t>(row_index_.size()));
    }
  values_.assign(row_index_.size(), 0);
}

void BlockMatrix::assemble(std::span<const double> diagonal, std::span<const StencilDerivatives> stencils) {
  tbb::parallel_for(std::size_t{0}, free_.size(),
                    [&](std::size_t column) { assemble_column(column, diagonal, stencils); });
}

void BlockMatrix::assemble_column(std::size_t column, std::span<const double> diagonal,
                                  std::span<const StencilDerivatives> stencils) {
  for (std::size_t b = block_begin_[column]; b < block_begin_[column + 1]; ++b) {
    const bool on_diagonal = b == block_begin_[column];
    std::array<std::array<double, 3>, 3> sum{};
    if (on_diagonal)
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis][axis] = diagonal[free_[column]];
    for (std::size_t s = share_begin_[b]; s < share_begin_[b + 1]; ++s) {
      const Share& share = shares_[s];
      const auto& hessian = stencils[share.stencil].hessian;
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) sum[r][c] += hessian[12 * (3 * share.row + r) + 3 * share.column + c];
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const auto begin = static_cast<std::size_t>(column_begin_[3 * column + c]);
      const std::size_t first = on_diagonal ? begin - c : begin + 3 * (b - block_begin_[column]) - c;
      for (std::size_t r = on_diagonal ? c : 0; r < 3; ++r) values_[first + r] = sum[r][c];
    }
  }
}

void BlockMatrix::add_to_diagonal(std::size_t row, double value) {
  for (std::size_t c = 0; c < 3; ++c) values_[static_cast<std::size_t>(column_begin_[3 * row + c])] += value;
}

std::vector<double> BlockMatrix::times(const std::vector<double>& x) const {
  std::vector<double> y(x.size(), 0);
  for (std::size_t column = 0; column < x.size(); ++column)
    for (auto k = static_cast<std::size_t>(column_begin_[column]);
         k < static_cast<std::size_t>(column_begin_[column + 1]); ++k) {
      const auto row = static_cast<std::size_t>(row_index_[k]);
      y[row] += values_[k] * x[column];
      if (row != column) y[column] += values_[k] * x[row];
    }
  return y;
}

}  // namespace ogc::reference

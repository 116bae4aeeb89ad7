// The sparse system matrix of Newton's method: the lower triangle of a symmetric matrix of 3×3 blocks, with one row of
// blocks for each free vertex, in CHOLMOD's compressed columns. The pattern is kept while it holds all blocks that the
// stencils need. One thread sums each value in the order of the stencils, so the number of threads changes no bit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// Vertices of a stencil in the order of its derivatives; unused entries are −1.
using StencilVertices = std::array<compare::Index, 4>;

/// The matrix of the free vertices, lower triangle, by columns.
class BlockMatrix {
 public:
  /// Makes a row of blocks for each free vertex.
  explicit BlockMatrix(const std::vector<Mobility>& mobility);

  /// Finds the blocks of these stencils; returns whether the pattern changed. The first `steady` stencils must be the
  /// same in every call with this value of `steady`.
  bool set_stencils(std::span<const StencilVertices> stencils, std::size_t steady = 0);
  /// Forgets the pattern, so that the next stencils get a minimal one. A kept pattern may hold more blocks than needed,
  /// and it decides the order of elimination. The last bits of a step would then depend on earlier steps, and a
  /// continued run would differ from an uninterrupted one.
  void forget_pattern() { blocks_.clear(); }
  /// Sums the stencils' Hessians, and the vertices' terms of the diagonal (m/h²) [N/m].
  void assemble(std::span<const double> diagonal, std::span<const StencilDerivatives> stencils);

  /// Adds `value` ≥ 0 to the diagonal of the block row `row`, until the next assemble. A positive definite matrix stays
  /// so.
  void add_to_diagonal(std::size_t row, double value);

  /// Returns the number of scalar rows, three for each free vertex.
  std::size_t rows() const { return 3 * free_.size(); }
  /// Returns the first entry of each column in CHOLMOD's format.
  const std::vector<std::int32_t>& column_begin() const { return column_begin_; }
  /// Returns the row of each entry.
  const std::vector<std::int32_t>& row_index() const { return row_index_; }
  /// Returns the entries [N/m].
  std::vector<double>& values() { return values_; }
  const std::vector<double>& values() const { return values_; }
  /// Returns the vertex of each row of blocks.
  const std::vector<std::size_t>& free_vertices() const { return free_; }
  /// Returns A x; x and the result are ordered like the rows.
  std::vector<double> times(const std::vector<double>& x) const;

 private:
  /// A block of a stencil's Hessian at places `row` and `column` of the stencil, and the matrix block to which it is
  /// added.
  struct Share {
    std::uint64_t block = 0;  ///< column · 2³² + row
    std::uint32_t stencil = 0;
    std::uint8_t row = 0, column = 0;
  };
  static bool earlier(const Share& a, const Share& b);
  /// Returns the shares of the stencils from `first` on, sorted.
  std::vector<Share> shares_of(std::span<const StencilVertices> stencils, std::size_t first) const;
  std::vector<std::uint64_t> needed_blocks() const;
  void set_pattern(std::vector<std::uint64_t> blocks);
  void assemble_column(std::size_t column, std::span<const double> diagonal,
                       std::span<const StencilDerivatives> stencils);

  std::vector<std::size_t> free_;
  std::vector<std::int32_t> number_;                    ///< number among the free vertices, or −1
  std::vector<std::uint64_t> blocks_;                   ///< ascending
  std::vector<std::size_t> block_begin_, share_begin_;  ///< by column; by block
  std::vector<Share> shares_, steady_shares_;
  std::size_t steady_ = 0;  ///< number of stencils in steady_shares_
  std::vector<std::int32_t> column_begin_, row_index_;
  std::vector<double> values_;
};

}  // namespace ogc::reference

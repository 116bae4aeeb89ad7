// The sparse system matrix of Newton's method: a symmetric matrix of 3×3 blocks with one row of blocks for each free
// vertex. Its lower triangle is stored by columns in CHOLMOD's compressed format. The pattern is kept as long as it
// contains all blocks that the stencils need. One thread sums each value in the order of the stencils, so the bits do
// not depend on the number of threads.
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
  /// Takes the mobility of each vertex; free vertices have rows.
  explicit BlockMatrix(const std::vector<Mobility>& mobility);

  /// Finds the blocks of these stencils; returns whether the pattern changed. The blocks of the first `steady` stencils
  /// are found only once. So these stencils must be the same in every call with the same `steady`.
  bool set_stencils(std::span<const StencilVertices> stencils, std::size_t steady = 0);
  /// Discards the pattern, so that the next stencils get a minimal one. A kept pattern may have more blocks than
  /// needed, and the pattern determines the order of elimination. If it were kept, the last bits of a step would depend
  /// on earlier steps, and a resumed run would differ from an uninterrupted one.
  void forget_pattern() { blocks_.clear(); }
  /// Sums the stencils' Hessians and adds `diagonal`, the terms m/h² of the vertices [N/m].
  void assemble(std::span<const double> diagonal, std::span<const StencilDerivatives> stencils);

  /// Adds `value` ≥ 0 to the diagonal of the block row `row`; the next call of `assemble` removes it. The matrix stays
  /// positive definite.
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
  /// Returns A x. x and the result have one entry for each scalar row.
  std::vector<double> times(const std::vector<double>& x) const;

 private:
  /// A block of a stencil's Hessian, at places `row` and `column` of the stencil. It is added to the matrix block with
  /// the key `block`.
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

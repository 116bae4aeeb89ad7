// Compresses stored arrays with zlib, outside of HDF5 and thus on any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ogc::compare {

/// Returns the CRC-32 (ISO 3309, as in zlib and PNG) of `bytes`. If `before` is the CRC of preceding bytes, returns the
/// CRC of these bytes and `bytes` together. It detects damage, but no forgery.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

/// Largest and smallest number of rows of a chunk. With 3 floats per row, the largest chunk has 768 KiB, which fits
/// HDF5's default chunk cache of 1 MiB. If chunks had fewer rows than the smallest, their index would take more space
/// than compression saves.
inline constexpr std::size_t largest_chunk_rows = 1 << 16, smallest_chunk_rows = 1 << 10;

/// Returns a / b, rounded up.
constexpr std::size_t divide_up(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

/// Returns the number of rows of each chunk if `rows` rows are cut evenly; at least 1.
std::size_t even_chunk_rows(std::size_t rows);

/// A range of rows of an array, as a file stores it.
struct PackedChunk {
  bool packed = false;  ///< true: shuffled and deflated; false: plain values
  std::string bytes;    ///< bytes in the file
};

/// An array as an HDF5 dataset stores it.
struct PackedArray {
  std::size_t rows = 0, columns = 0;  ///< columns 0: one-dimensional
  std::size_t chunk_rows = 0;         ///< rows of each chunk; zeros fill the last one
  std::vector<PackedChunk> chunks;    ///< one after another
  std::size_t byte_count() const;     ///< size of all chunks
};

/// Packs rows of `columns` values (0: single values). Each chunk is shuffled (the first bytes of all values, then all
/// second bytes, …, so that exponents are adjacent) and deflated at level 1. Higher levels take longer and save only 2
/// % on positions. A chunk stays plain if packing makes it no shorter, or if the array has few rows.
PackedArray pack(std::span<const float> values, std::size_t columns = 0);

}  // namespace ogc::compare

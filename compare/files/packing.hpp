// What zlib does for stored arrays, outside of HDF5 and thus on any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ogc::compare {

/// CRC-32 (ISO 3309, as zlib and PNG have it) of bytes that follow those with the CRC `before`. Tells damage, not a
/// forgery.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

/// Chunks of at most so many rows: 3 floats a row make 768 KiB, which fits HDF5's default chunk cache of 1 MiB. Below
/// the smallest number the index of the chunks weighs more than compression saves.
inline constexpr std::size_t largest_chunk_rows = 1 << 16, smallest_chunk_rows = 1 << 10;

/// Rows of each chunk of an array of so many rows, cut evenly; 1 at least.
std::size_t even_chunk_rows(std::size_t rows);

/// A part of an array as a file holds it.
struct PackedChunk {
  bool packed = false;  ///< shuffled and deflated; else the values as they are
  std::string bytes;    ///< as they stand in the file
};

/// An array as an HDF5 dataset stores it.
struct PackedArray {
  std::size_t rows = 0, columns = 0;  ///< columns 0: one-dimensional
  std::size_t chunk_rows = 0;         ///< of each chunk; zeros fill the last one
  std::vector<PackedChunk> chunks;    ///< one after another
  std::size_t byte_count() const;     ///< of all chunks
};

/// Packs rows of `columns` values (0: single values). Each chunk is shuffled (first bytes of all values,
/// then all second bytes, …: exponents lie side by side) and deflated at level 1, higher ones take longer and gain
/// 2 % on positions; it stays as it is where that makes it no shorter, and where the array has few rows.
PackedArray pack(std::span<const float> values, std::size_t columns = 0);

}  // namespace ogc::compare

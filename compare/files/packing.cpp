#include "compare/files/packing.hpp"

#include <zlib.h>

#include <algorithm>
#include <new>

namespace ogc::compare {
namespace {

constexpr int level = 1;

/// Returns the bytes in the order of HDF5's shuffle filter: the first bytes of all values, then all second bytes, ….
std::string shuffled(std::string_view bytes) {
  constexpr std::size_t size = sizeof(float);
  const std::size_t count = bytes.size() / size;
  std::string result(bytes.size(), '\0');
  for (std::size_t b = 0; b < size; ++b)
    for (std::size_t i = 0; i < count; ++i) result[b * count + i] = bytes[size * i + b];
  return result;
}

/// Returns the bytes in zlib's format, as HDF5's filter writes them; an empty string if compression saves nothing.
std::string deflated(const std::string& bytes) {
  std::string result(bytes.size(), '\0');
  uLongf size = result.size();
  const int code = compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                             reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), level);
  if (code == Z_MEM_ERROR) throw std::bad_alloc();
  if (code != Z_OK) return {};
  result.resize(size);
  return result;
}

PackedChunk packed_chunk(std::string bytes) {
  std::string packed = deflated(shuffled(bytes));
  const bool shorter = !packed.empty() && packed.size() < bytes.size();
  return {shorter, shorter ? std::move(packed) : std::move(bytes)};
}

}  // namespace

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::size_t even_chunk_rows(std::size_t rows) {
  return rows == 0 ? 1 : divide_up(rows, divide_up(rows, largest_chunk_rows));
}

std::size_t PackedArray::byte_count() const {
  std::size_t count = 0;
  for (const PackedChunk& chunk : chunks) count += chunk.bytes.size();
  return count;
}

PackedArray pack(std::span<const float> values, std::size_t columns) {
  const std::size_t row_values = std::max<std::size_t>(columns, 1);
  PackedArray array{values.size() / row_values, columns, 0, {}};
  array.chunk_rows = even_chunk_rows(array.rows);
  const std::string_view all(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  const std::size_t chunk_bytes = array.chunk_rows * row_values * sizeof(float);
  for (std::size_t begin = 0; begin < all.size(); begin += chunk_bytes) {
    std::string bytes(all.substr(begin, chunk_bytes));
    bytes.resize(chunk_bytes, '\0');
    const bool few = array.rows < smallest_chunk_rows;
    array.chunks.push_back(few ? PackedChunk{false, std::move(bytes)} : packed_chunk(std::move(bytes)));
  }
  return array;
}

}  // namespace ogc::compare

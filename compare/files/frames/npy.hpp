// Reads NumPy's array files: a header in Python's syntax, then the numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "compare/files/scalars.hpp"

namespace ogc::compare {

/// The header of a .npy file.
struct NpyHeader {
  ScalarType type = ScalarType::float64;    ///< type of the elements
  std::endian order = std::endian::little;  ///< their byte order
  std::vector<std::uint64_t> shape;         ///< extent of each dimension
  bool fortran_order = false;               ///< whether the first dimension varies fastest; otherwise the last
};

/// Fills a span with the next bytes or throws InputError. The text names what is read.
using ByteSource = std::function<void(std::span<char>, const std::string&)>;

/// Reads the header from `source` up to the first number. Throws InputError that begins with `where` if this is no .npy
/// file, its version is unknown, or its type is no number.
NpyHeader read_npy_header(const ByteSource& source, const std::string& where);

/// Returns "[100, 64, 3]".
std::string shape_text(std::span<const std::uint64_t> shape);

}  // namespace ogc::compare

// NumPy's array files: a header in Python's syntax, then the numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "compare/files/scalars.hpp"

namespace ogc::compare {

/// What the header of a .npy file says.
struct NpyHeader {
  ScalarType type = ScalarType::float64;    ///< of the elements
  std::endian order = std::endian::little;  ///< of their bytes
  std::vector<std::uint64_t> shape;         ///< entries by dimension
  bool fortran_order = false;               ///< the first dimension changes from number to number; else the last
};

/// Fills a span with the next bytes, or throws InputError; the text says what for.
using ByteSource = std::function<void(std::span<char>, const std::string&)>;

/// Reads the header from `source` and leaves it at the first number. Throws InputError that begins with `where`: no
/// .npy file, an unknown version, a type that is no number.
NpyHeader read_npy_header(const ByteSource& source, const std::string& where);

/// "[100, 64, 3]".
std::string shape_text(std::span<const std::uint64_t> shape);

}  // namespace ogc::compare

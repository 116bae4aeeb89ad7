// Reads numbers in the binary formats of other programs, of any width and byte order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

namespace ogc::compare {

/// The types of numbers in other programs' files.
enum class ScalarType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

inline constexpr std::array<std::size_t, 10> scalar_sizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};  ///< by ScalarType [bytes]
/// Returns the size of one number [bytes].
inline std::size_t size_of(ScalarType type) { return scalar_sizes[static_cast<std::size_t>(type)]; }
/// Returns whether the type is a floating-point type.
inline bool is_floating(ScalarType type) { return type == ScalarType::float32 || type == ScalarType::float64; }

/// Returns the number of this type at `bytes`, in byte order `order`.
template <class Number>
Number number_at(const char* bytes, std::endian order) {
  std::array<char, sizeof(Number)> raw;
  std::copy_n(bytes, raw.size(), raw.begin());
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Number>(raw);
}

/// Returns the number at `bytes` as a double, which is exact except for integers beyond 2⁵³.
inline double scalar_at(const char* bytes, ScalarType type, std::endian order) {
  switch (type) {
    case ScalarType::int8: return number_at<std::int8_t>(bytes, order);
    case ScalarType::uint8: return number_at<std::uint8_t>(bytes, order);
    case ScalarType::int16: return number_at<std::int16_t>(bytes, order);
    case ScalarType::uint16: return number_at<std::uint16_t>(bytes, order);
    case ScalarType::int32: return number_at<std::int32_t>(bytes, order);
    case ScalarType::uint32: return number_at<std::uint32_t>(bytes, order);
    case ScalarType::int64: return static_cast<double>(number_at<std::int64_t>(bytes, order));
    case ScalarType::uint64: return static_cast<double>(number_at<std::uint64_t>(bytes, order));
    case ScalarType::float32: return number_at<float>(bytes, order);
    case ScalarType::float64: return number_at<double>(bytes, order);
  }
  return 0;
}

}  // namespace ogc::compare

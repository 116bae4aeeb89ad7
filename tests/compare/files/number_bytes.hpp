// Writes numbers in the byte orders of files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace ogc::tests {

template <class Number>
void append_number(std::string& bytes, Number value, std::endian order = std::endian::little) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

}  // namespace ogc::tests

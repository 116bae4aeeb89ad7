// Writes NumPy's files without NumPy, so that tests need no Python and can damage each byte.
#pragma once

#include <zlib.h>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/compare/files/scratch.hpp"

namespace ogc::tests {

template <class Number>
std::string raw(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

/// Returns a .npy file of version 1; `type` is for example "<f8".
inline std::string npy(const std::string& type, const std::string& shape, bool fortran, const std::string& numbers) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': (" +
                       shape + "), }";
  header.resize((header.size() + 11 + 63) / 64 * 64 - 10, ' ');
  header.back() = '\n';
  const auto length = static_cast<unsigned>(header.size());
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(length % 256) + static_cast<char>(length / 256) +
         header + numbers;
}

/// Returns `value` in little-endian order.
inline std::string word(std::uint64_t value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> (8 * k) & 255);
  return text;
}

/// One member of an archive, stored without compression.
struct Member {
  std::string name, bytes;
};

/// Returns a .zip archive whose members are stored without compression.
inline std::string zip(const std::vector<Member>& members) {
  std::string all, list;
  for (const auto& [name, bytes] : members) {
    const auto crc = ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
    const std::string common = word(20, 2) + word(0, 2) + word(0, 2) + word(0, 4) + word(crc, 4) +
                               word(bytes.size(), 4) + word(bytes.size(), 4) + word(name.size(), 2) + word(0, 2);
    list += "PK\x01\x02" + word(20, 2) + common + word(0, 2) + word(0, 2) + word(0, 2) + word(0, 4) +
            word(all.size(), 4) + name;
    all += "PK\x03\x04" + common + name + bytes;
  }
  return all + list + "PK\x05\x06" + word(0, 4) + word(members.size(), 2) + word(members.size(), 2) +
         word(list.size(), 4) + word(all.size(), 4) + word(0, 2);
}

inline std::filesystem::path written(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

}  // namespace ogc::tests

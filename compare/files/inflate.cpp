#include "compare/files/inflate.hpp"

#include <zlib.h>

#include "compare/problem/error.hpp"

namespace ogc::compare {

std::string inflate(std::string_view packed, std::size_t size, const std::string& where) {
  constexpr std::size_t most_a_byte = 1032;  // from zlib's documentation of deflate
  if (size / most_a_byte > packed.size())
    throw InputError(where + ": " + std::to_string(packed.size()) + " compressed bytes can't hold the " +
                     std::to_string(size) + " that are announced; the file is damaged");
  std::string bytes(size, '\0');
  uLongf got = static_cast<uLongf>(size);
  const int status = ::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &got,
                                  reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
  if (status != Z_OK || got != size)
    throw InputError(where + ": the compressed data don't unpack to the " + std::to_string(size) +
                     " bytes that are announced; the file is damaged");
  return bytes;
}

}  // namespace ogc::compare

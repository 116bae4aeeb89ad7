// What zlib does for stored arrays, outside of HDF5 and thus on any thread.
#pragma once

#include <cstdint>
#include <string_view>

namespace ogc::compare {

/// CRC-32 (ISO 3309, as zlib and PNG have it) of bytes that follow those with the CRC `before`. Tells damage, not a
/// forgery.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

}  // namespace ogc::compare

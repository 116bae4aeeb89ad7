// zlib's streams, unpacked into memory whose size is known before.
#pragma once

#include <string>
#include <string_view>

namespace ogc::compare {

/// The `size` bytes that the zlib stream `packed` holds. Throws InputError that begins with `where`: damaged, or of
/// another size. Deflate packs no more than 1032 bytes into one, so that an absurd size is refused before memory is
/// taken for it.
std::string inflate(std::string_view packed, std::size_t size, const std::string& where);

}  // namespace ogc::compare

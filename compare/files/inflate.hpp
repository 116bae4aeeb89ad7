// Unpacks zlib streams of known size.
#pragma once

#include <string>
#include <string_view>

namespace ogc::compare {

/// Returns the `size` bytes of the zlib stream `packed`. Throws InputError that begins with `where` if it is damaged or
/// has another size. Deflate packs at most 1032 bytes into one, so an absurd size is refused before memory is
/// allocated.
std::string inflate(std::string_view packed, std::size_t size, const std::string& where);

}  // namespace ogc::compare

// Unpacks zlib streams of known size.
#pragma once

#include <string>
#include <string_view>

namespace ogc::compare {

/// Returns the `size` bytes of the zlib stream `packed`. If the stream is damaged or has another size, throws
/// InputError that begins with `where`. Deflate packs at most 1032 bytes into one, so an impossible size is rejected
/// before memory is allocated.
std::string inflate(std::string_view packed, std::size_t size, const std::string& where);

}  // namespace ogc::compare

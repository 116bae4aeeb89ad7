// Pictures as PNG.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ogc::experiments {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue: sRGB

/// Rows from the top, pixels from the left.
struct Image {
  std::size_t width = 0, height = 0;  ///< [pixels]
  std::vector<Colour> pixels;         ///< row after row
};

/// Whether this program was built with libpng.
bool has_png();

/// The bytes of a PNG file, 8 bits a channel. Throws ResourceError where it was built without libpng.
std::string png_bytes(const Image& image);

}  // namespace ogc::experiments

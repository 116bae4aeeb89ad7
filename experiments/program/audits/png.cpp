#include "experiments/program/audits/png.hpp"

#include "compare/problem/error.hpp"

#ifdef OGC_HAS_PNG
#include <png.h>
#endif

namespace ogc::experiments {

#ifdef OGC_HAS_PNG

bool has_png() { return true; }

std::string png_bytes(const Image& image) {
  static_assert(sizeof(Colour) == 3, "libpng reads three bytes a pixel");
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  const auto write = [&](void* memory) {
    return png_image_write_to_memory(&header, memory, &size, 0, image.pixels.data(), 0, nullptr);
  };
  std::string bytes;
  if (write(nullptr) != 0) {
    bytes.resize(size);
    if (write(bytes.data()) != 0) return bytes;
  }
  throw compare::ResourceError(std::string("the picture can't be packed: ") + header.message);
}

#else

bool has_png() { return false; }

std::string png_bytes(const Image&) {
  throw compare::ResourceError("this program was built without libpng; install libpng-dev and build again");
}

#endif

}  // namespace ogc::experiments

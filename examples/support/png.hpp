#pragma once
/// \file
/// Writes an image as PNG.

#include "scree/core/error.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/io/image.hpp"

#include <png.h>

#include <filesystem>
#include <string>

namespace scree::examples {

/// Replaces `file` in one step by `image`.
/// \throws Error naming the file if it cannot be written.
inline void write_png(const std::filesystem::path& file, const Image& image) {
  static_assert(sizeof(Rgb) == 3, "libpng reads the pixels as packed bytes");
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width());
  png.height = static_cast<png_uint_32>(image.height());
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.pixels().data(), 0, nullptr) == 0) {
    throw Error(message(file.string(), ": cannot be encoded: ", static_cast<const char*>(png.message)));
  }
  bytes.resize(size);
  write_atomically(file, bytes);
}

} // namespace scree::examples

// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/png_file.hpp"

#include <png.h>

#include <string>

#include "core/check.hpp"
#include "core/error.hpp"

namespace carpus::cli {

void write_png(const std::filesystem::path& file, const Picture& picture) {
  CARPUS_CHECK(picture.rgb.size() == std::size_t{3} * picture.width * picture.height);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = picture.width;
  image.height = picture.height;
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, file.c_str(), 0, picture.rgb.data(), 0, nullptr) == 0) {
    throw IoError(file.string() + ": cannot be written (" + image.message +
                  "); check the folder and the disk");
  }
}

}  // namespace carpus::cli

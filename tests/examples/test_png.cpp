#include "scree/core/random.hpp"
#include "support/png.hpp"
#include "support/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <png.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <vector>

using namespace scree;
using scree::test::ScratchFolder;

TEST_CASE("an image comes back from its PNG file") {
  const ScratchFolder folder;
  const auto file = folder / "view.png";
  for (const int width : {1, 97, 256}) {
    Image image{width, 61};
    Random random{4};
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const auto byte = [&] { return static_cast<std::uint8_t>(random.index(256)); };
        image.at(x, y) = {byte(), byte(), byte()};
      }
    }
    examples::write_png(file, image);

    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&png, file.c_str()) != 0);
    CHECK(png.width == static_cast<png_uint_32>(width));
    CHECK(png.height == 61);
    png.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(png));
    REQUIRE(png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr) != 0);
    REQUIRE(bytes.size() == 3 * image.pixels().size());
    CHECK(std::memcmp(bytes.data(), image.pixels().data(), bytes.size()) == 0);
  }
  CHECK_FALSE(std::filesystem::exists(file.string() + ".part"));
}

TEST_CASE("an image that cannot be written says so") {
  const ScratchFolder folder;
  const auto nowhere = folder / "missing" / "view.png";
  CHECK_THROWS_WITH_AS(examples::write_png(nowhere, Image{2, 2}),
                       (nowhere.string() + ": cannot be written").c_str(), Error);
}

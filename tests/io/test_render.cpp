#include "scree/core/random.hpp"
#include "scree/io/annotate.hpp"
#include "scree/io/render.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

using namespace scree;

namespace {

constexpr Rgb white{255, 255, 255};
constexpr Rgb red{200, 0, 0};
constexpr Rgb green{0, 200, 0};
constexpr Rgb black{0, 0, 0};

/// A style of flat colours and one sample per pixel, so that pixels can be predicted.
RenderStyle plain() {
  RenderStyle style;
  style.outline_strength = 0.0;
  style.hollow_strength = 0.0;
  style.cut_lightness = 0.0;
  style.samples = 1;
  return style;
}

/// 100 pixels per metre, the origin at the corner of the pixels (99, 49) and (100, 50), looking along +y.
Camera two_metres() {
  return {.width = 2.0};
}

bool is_shade_of(Rgb pixel, Rgb colour) {
  const auto close = [](double a, double b) { return std::abs(a - b) <= 2.0; };
  const double light = std::max({pixel.red, pixel.green, pixel.blue}) /
                       static_cast<double>(std::max({colour.red, colour.green, colour.blue}));
  return light > 0.1 && close(pixel.red, light * colour.red) && close(pixel.green, light * colour.green) &&
         close(pixel.blue, light * colour.blue);
}

template <class Predicate>
int count(const Image& image, Predicate predicate) {
  return static_cast<int>(std::count_if(image.pixels().begin(), image.pixels().end(), predicate));
}

int lightness(Rgb pixel) {
  return pixel.red + pixel.green + pixel.blue;
}

using Facets = std::vector<std::array<std::uint32_t, 3>>;

/// A square of side 2 `half` across the line of sight at depth y.
std::vector<Vector> square(double half, double y) {
  return {{-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half}};
}
const Facets square_facets{{0, 1, 2}, {0, 2, 3}};

} // namespace

TEST_CASE("a sphere covers the disc of its radius, and is lighter towards the light") {
  Renderer renderer{200, 100, two_metres(), plain()};
  renderer.sphere({0.2, 0.0, 0.1}, 0.3, red, 1);
  const auto image = renderer.image();
  int wrong = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) {
      const double distance = std::hypot((x + 0.5 - 100) / 100 - 0.2, (50 - y - 0.5) / 100 - 0.1);
      const bool covered = image.at(x, y) != white;
      wrong += covered != (distance <= 0.3) ? 1 : 0;
      wrong += covered && !is_shade_of(image.at(x, y), red) ? 1 : 0;
    }
  }
  CHECK(wrong == 0);
  CHECK(lightness(image.at(110, 30)) > lightness(image.at(130, 50))); // the light is at the upper left
  CHECK(image.at(120, 40).red > 140);                                 // and the middle is not in the dark
}

TEST_CASE("the nearer surface hides the farther one in any order") {
  std::vector<Image> images;
  for (const bool near_first : {true, false}) {
    Renderer renderer{200, 100, two_metres(), plain()};
    for (const bool near : {near_first, !near_first}) {
      near ? renderer.sphere({0, -0.5, 0}, 0.1, red, 1) : renderer.sphere({0, 0.5, 0}, 0.3, green, 2);
    }
    images.push_back(renderer.image());
  }
  CHECK(is_shade_of(images[0].at(100, 50), red));
  CHECK(is_shade_of(images[0].at(120, 50), green));
  CHECK(std::equal(images[0].pixels().begin(), images[0].pixels().end(), images[1].pixels().begin()));
}

TEST_CASE("spheres that intersect meet where their surfaces do") {
  Renderer renderer{200, 100, two_metres(), plain()};
  renderer.sphere({-0.1, 0, 0}, 0.25, red, 1);
  renderer.sphere({0.1, 0, 0}, 0.25, green, 2);
  const auto image = renderer.image();
  int wrong = 0;
  for (int y = 30; y < 70; ++y) {
    for (int x = 80; x < 120; ++x) {
      wrong += is_shade_of(image.at(x, y), x < 100 ? red : green) ? 0 : 1;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("a triangle covers its area without seams and is seen from both sides") {
  for (const bool flipped : {false, true}) {
    Renderer renderer{200, 100, two_metres(), plain()};
    const Facets facets = flipped ? Facets{{0, 2, 1}, {0, 3, 2}} : square_facets;
    renderer.surface(square(0.3, 0.0), facets, green, 1);
    const auto image = renderer.image();
    CHECK(count(image, [](Rgb p) { return p != white; }) == 60 * 60);
    CHECK(image.at(70, 20) != white);
    CHECK(image.at(129, 79) != white);
    CHECK(is_shade_of(image.at(100, 50), green));
    CHECK(count(image, [&](Rgb p) { return p == image.at(100, 50); }) == 60 * 60); // one plane, one shade
  }
}

TEST_CASE("facets that slant away are shaded and hidden by depth") {
  Renderer renderer{200, 100, two_metres(), plain()};
  const std::vector<Vector> leaning{{-0.5, -0.5, 0.3}, {0.5, 0.5, 0.3}, {0.0, 0.0, -0.3}}; // y = x
  renderer.surface(leaning, Facets{{0, 1, 2}}, green, 1);
  renderer.surface(square(0.2, 0.0), square_facets, red, 2);
  const auto image = renderer.image();
  CHECK(is_shade_of(image.at(90, 45), green)); // in front of the square for x < 0
  CHECK(is_shade_of(image.at(110, 45), red));
}

TEST_CASE("a cut opens spheres with a flat face of their colour") {
  auto style = plain();
  style.cut_lightness = 0.5;
  Renderer renderer{200, 100, two_metres(), style};
  renderer.cut({{0, 0, 0}, {0, -3, 0}});
  renderer.sphere({-0.5, 0.1, 0}, 0.2, red, 1); // cut in front of its centre: a face within a rim
  renderer.sphere({0.5, -0.1, 0}, 0.2, red, 2); // cut behind its centre: only the face is left
  renderer.sphere({0, -0.5, 0}, 0.2, red, 3);   // gone
  renderer.uncut();
  renderer.sphere({0, -0.5, 0.4}, 0.05, green, 4);
  const auto image = renderer.image();
  const double face_radius = 100.0 * std::sqrt(0.2 * 0.2 - 0.1 * 0.1);
  int wrong = 0;
  for (int y = 20; y < 80; ++y) {
    for (int x = 20; x < 180; ++x) {
      const double left = std::hypot(x + 0.5 - 50, y + 0.5 - 50);
      const double right = std::hypot(x + 0.5 - 150, y + 0.5 - 50);
      const bool face = std::min(left, right) < face_radius - 1e-9;
      wrong += (image.at(x, y) == blend(red, white, 0.5)) != face && std::min(left, right) > 1.5 ? 1 : 0;
      wrong += right > face_radius && right < 40 && image.at(x, y) != white ? 1 : 0;
      wrong += left > face_radius && left < 20 && !is_shade_of(image.at(x, y), red) ? 1 : 0;
    }
  }
  CHECK(wrong == 0);
  CHECK(image.at(100, 50) == white);
  CHECK_MESSAGE(is_shade_of(image.at(100, 10), green), "not cut");
}

TEST_CASE("a cut surface ends at the plane and shows there as a line") {
  auto style = plain();
  style.section_width = 4.0;
  Renderer renderer{200, 100, two_metres(), style};
  renderer.cut({{0, 0, 0}, {0, -1, 0}});
  // A level plate, seen edge-on: no pixel of it is seen, but its section is.
  const std::vector<Vector> plate{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
  renderer.surface(plate, square_facets, red, 1);
  renderer.surface(square(0.2, -0.3), square_facets, green, 2); // in front of the plane: gone
  const auto image = renderer.image();
  CHECK(count(image, [](Rgb p) { return p.green > p.red && p != white; }) == 0);
  for (int x = 50; x < 150; ++x) {
    int covered = 0;
    for (int y = 40; y < 60; ++y) {
      covered += image.at(x, y) != white ? 1 : 0;
    }
    REQUIRE(covered == 4);
  }
  CHECK(image.at(46, 50) == white);
  CHECK(image.at(154, 50) == white);
}

TEST_CASE("spheres of one object have one outline, surfaces a line along sharp edges") {
  auto style = plain();
  style.outline_strength = 1.0;
  style.outline = black;
  const auto dark_column = [&](std::uint32_t second, int x) {
    Renderer renderer{200, 100, two_metres(), style};
    renderer.sphere({-0.1, 0, 0}, 0.25, red, 1);
    renderer.sphere({0.1, 0, 0}, 0.25, red, second);
    return renderer.image().at(x, 50) == black;
  };
  CHECK(dark_column(2, 99)); // where two bodies meet
  CHECK(dark_column(2, 100));
  CHECK_FALSE(dark_column(1, 99)); // within a clump
  CHECK_FALSE(dark_column(1, 100));
  CHECK(dark_column(1, 65)); // its rim
  CHECK_FALSE(dark_column(1, 80));

  Renderer renderer{200, 100, two_metres(), style};
  const std::vector<Vector> roof{{-0.5, 0.5, -0.3}, {0, 0, -0.3},     {0, 0, 0.3},
                                 {-0.5, 0.5, 0.3},  {0.5, 0.5, -0.3}, {0.5, 0.5, 0.3}};
  renderer.surface(roof, Facets{{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}, green, 1);
  const auto image = renderer.image();
  CHECK(image.at(99, 50) == black);
  CHECK(image.at(100, 40) == black);
  CHECK(is_shade_of(image.at(75, 50), green)); // on the diagonal of a flat side: no line
  CHECK(count(image, [](Rgb p) { return p == black; }) == 2 * (100 + 60) - 4 + 2 * 58);
}

TEST_CASE("a gap between grains is darker than a grain in the open") {
  auto style = plain();
  style.hollow_strength = 1.0;
  const auto at_middle = [&](bool neighbours) {
    Renderer renderer{200, 100, two_metres(), style};
    renderer.surface(square(0.4, 0.15), square_facets, red, 9);
    for (int k = 0; neighbours && k < 6; ++k) {
      const double angle = k * std::acos(-1.0) / 3.0;
      renderer.sphere({0.2 * std::cos(angle), 0.0, 0.2 * std::sin(angle)}, 0.15, red,
                      static_cast<std::uint32_t>(k));
    }
    return lightness(renderer.image().at(100, 50));
  };
  CHECK(at_middle(true) < 0.7 * at_middle(false));
}

TEST_CASE("perspective: a sphere has its exact outline, off the axis too, and shrinks with distance") {
  const Camera camera{.width = 2.0, .distance = 4.0}; // the eye is at y = -4, 400 pixels per unit of slope
  const Vector centre{0.5, 0.0, 0.1};
  Renderer renderer{200, 100, camera, plain()};
  renderer.sphere(centre, 0.2, red, 1);
  const auto image = renderer.image();
  int wrong = 0;
  int covered = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) {
      const Vector ray = Vector{(x + 0.5 - 100) / 200, 2.0, (50 - y - 0.5) / 200}.normalized();
      const Vector to_centre = centre - Vector{0, -4, 0};
      const bool hit = to_centre.cross(ray).norm() <= 0.2;
      wrong += hit != (image.at(x, y) != white) ? 1 : 0;
      covered += hit ? 1 : 0;
    }
  }
  CHECK(wrong == 0);
  CHECK(covered > 1200);

  CHECK(renderer.pixels_per_metre() == test::about(100.0));
  CHECK(renderer.pixel({0.5, 0, 0.25}).isApprox(Eigen::Vector2d{150, 25}));
  CHECK(renderer.pixel({0.5, 4, 0.25}).isApprox(Eigen::Vector2d{125, 37.5})); // twice as far from the eye
}

TEST_CASE("perspective: what is behind the eye is not drawn, what reaches behind it is drawn in part") {
  const Camera camera{.width = 2.0, .distance = 1.0};
  Renderer renderer{200, 100, camera, plain()};
  renderer.sphere({0, -3, 0}, 0.5, red, 1);
  renderer.line({-1, -2, 0}, {1, -3, 0}, red);
  CHECK(count(renderer.image(), [](Rgb p) { return p != white; }) == 0);
  // A floor 0.2 below the eye that reaches from behind it to y = 9: its far edge is at slope 0.2 / 10.
  renderer.surface(std::vector<Vector>{{-50, -5, -0.2}, {50, -5, -0.2}, {50, 9, -0.2}, {-50, 9, -0.2}},
                   square_facets, green, 2);
  const auto image = renderer.image();
  CHECK(image.at(100, 51) == white);
  CHECK(is_shade_of(image.at(100, 53), green));
  CHECK(is_shade_of(image.at(100, 99), green));
}

TEST_CASE("a line is hidden by what is in front of it and has its width") {
  Renderer renderer{200, 100, two_metres(), plain()};
  renderer.sphere({0, -0.5, 0}, 0.2, red, 1);
  renderer.line({-0.9, 0, 0}, {0.9, 0, 0}, black, 4.0);
  const auto image = renderer.image();
  CHECK(is_shade_of(image.at(100, 50), red));
  for (int y = 46; y < 54; ++y) {
    CHECK((image.at(30, y) == black) == (y >= 48 && y < 52));
  }
  CHECK(image.at(5, 50) == white);
}

TEST_CASE("the same scene gives the same picture, and samples soften its edges") {
  const auto draw = [](int samples) {
    auto style = RenderStyle{};
    style.samples = samples;
    Renderer renderer{160, 80, two_metres(), style};
    Random random{5};
    for (std::uint32_t i = 0; i < 200; ++i) {
      const Vector centre{random.uniform(-0.9, 0.9), random.uniform(-0.3, 0.3), random.uniform(-0.4, 0.4)};
      renderer.sphere(centre, random.uniform(0.02, 0.06), rock_colour(i), i);
    }
    return renderer.image();
  };
  const auto one = draw(2);
  const auto two = draw(2);
  CHECK(std::equal(one.pixels().begin(), one.pixels().end(), two.pixels().begin()));

  auto style = plain();
  style.samples = 4;
  Renderer renderer{200, 100, two_metres(), style};
  renderer.sphere({0, 0, 0}, 0.3, black, 1);
  const double cover = count(renderer.image(), [](Rgb p) { return p == black; }) +
                       0.5 * count(renderer.image(), [](Rgb p) { return p != black && p != white; });
  CHECK(cover == test::about(std::acos(-1.0) * 30 * 30, 0.01));
}

TEST_CASE("objects out of sight and empty ones leave the background") {
  Renderer renderer{50, 50, two_metres(), plain()};
  renderer.sphere({100, 0, 0}, 0.5, red, 1);
  renderer.sphere({0, 0, 0}, 0.0, red, 2);
  renderer.sphere({std::nan(""), 0, 0}, 0.1, red, 3);
  renderer.surface(std::vector<Vector>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, Facets{{0, 1, 2}}, red, 4);
  renderer.line({1e30, 0, 5}, {2e30, 0, 5}, red);
  CHECK(count(renderer.image(), [](Rgb p) { return p != white; }) == 0);
}

TEST_CASE("a renderer refuses cameras, styles, cuts and facets that make no picture") {
  const auto camera = two_metres();
  CHECK_THROWS_WITH_AS((Renderer{0, 10, camera}), "image width = 0 pixels is outside [1, 16384] pixels",
                       Error);
  CHECK_THROWS_WITH_AS((Renderer{10, 99999, camera}),
                       "image height = 99999 pixels is outside [1, 16384] pixels", Error);
  CHECK_THROWS_WITH_AS((Renderer{10, 10, {.width = 0.0}}),
                       "camera width = 0 m must be a finite number above 0", Error);
  CHECK_THROWS_WITH_AS((Renderer{10, 10, {.distance = -1.0}}),
                       "camera distance = -1 m is outside [0, 1000000000] m", Error);
  CHECK_THROWS_WITH_AS((Renderer{10, 10, {.direction = {0, 0, 1}}}),
                       "camera direction and up must be finite vectors that are not parallel", Error);
  RenderStyle style;
  style.samples = 9;
  CHECK_THROWS_WITH_AS((Renderer{10, 10, camera, style}), "samples per pixel = 9 is outside [1, 4]", Error);
  Renderer renderer{10, 10, camera};
  CHECK_THROWS_WITH_AS(renderer.cut({{0, 0, 0}, {0, 0, 0}}),
                       "the normal of a cut must be a finite vector of length above 0", Error);
  CHECK_THROWS_WITH_AS(renderer.surface(square(1, 0), Facets{{0, 1, 4}}, red, 1),
                       "a facet names a vertex beyond the 4 of its surface", Error);
}

TEST_CASE("colours blend and the sequential map rises in lightness") {
  CHECK(blend(black, white, 0.0) == black);
  CHECK(blend(black, white, 1.0) == white);
  CHECK(blend(black, white, 0.5) == Rgb{128, 128, 128});
  CHECK(blend(black, white, 7.0) == white);
  CHECK(sequential_colour(-1.0) == Rgb{68, 1, 84});
  CHECK(sequential_colour(1.0) == Rgb{253, 231, 37});
  double before = -1.0;
  for (int k = 0; k <= 100; ++k) {
    const Rgb c = sequential_colour(0.01 * k);
    const double luma = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
    REQUIRE(luma > before);
    before = luma;
  }
  CHECK(rock_colour(7) == rock_colour(7));
  int same = 0;
  for (std::uint32_t body = 0; body < 1000; ++body) {
    same += rock_colour(body) == rock_colour(body + 1) ? 1 : 0;
  }
  CHECK(same < 100);
}

TEST_CASE("text is drawn point by point, aligned, and cut off at the border") {
  const TextStyle style{.colour = black, .height = 18.0}; // points of a letter are 3 pixels apart
  const auto inked = [](const Image& image, double x, double y) {
    return image.at(static_cast<int>(x), static_cast<int>(y)) == black;
  };
  Image image{60, 40};
  draw_text(image, 10, 10, "L", style);
  for (int row = 0; row < 7; ++row) {
    CHECK(inked(image, 10, 10 + 3 * row)); // the upright
  }
  for (int column = 0; column < 5; ++column) {
    CHECK(inked(image, 10 + 3 * column, 28)); // the foot
  }
  CHECK(image.at(16, 19) == white);
  CHECK(image.at(22, 10) == white);
  CHECK(text_width("L", 18.0) == 12.0);
  CHECK(text_width("-6.5\u00B0", 18.0) == text_width("-6.5x", 18.0));

  const auto drawn = [&](std::string text, double x, double align) {
    Image canvas{200, 60};
    auto aligned = style;
    aligned.align = align;
    draw_text(canvas, x, 10, text, aligned);
    return std::vector<Rgb>(canvas.pixels().begin(), canvas.pixels().end());
  };
  CHECK(drawn("2 m", 20, 0.0) == drawn("2 m", 20 + text_width("2 m", 18.0), 1.0));
  CHECK(drawn("2 m", 20, 0.0) == drawn("2 m", 20 + 0.5 * text_width("2 m", 18.0), 0.5));
  CHECK(drawn("\u00B0", 20, 0.0) != drawn("\u00B5", 20, 0.0));
  CHECK_MESSAGE(drawn("\u00B5", 20, 0.0) == drawn("\u20AC", 20, 0.0), "one box for all unknown letters");

  Image small{10, 10};
  draw_text(small, -500, -3, "far to the left of the picture", style);
  draw_text(small, 5, 5, "and over its border", style);
  CHECK(small.at(5, 5) != small.at(0, 0));
}

TEST_CASE("every printable letter has a shape of its own, but for 0 and O") {
  std::vector<std::vector<Rgb>> shapes;
  for (char letter = ' '; letter <= '~'; ++letter) {
    if (letter == 'O') {
      continue;
    }
    Image image{24, 36};
    draw_text(image, 5, 5, std::string(1, letter), {.colour = black});
    shapes.emplace_back(image.pixels().begin(), image.pixels().end());
  }
  const auto ink = [](const std::vector<Rgb>& shape) {
    return std::count_if(shape.begin(), shape.end(), [](Rgb p) { return p != white; });
  };
  CHECK(ink(shapes[0]) == 0);
  for (std::size_t i = 1; i < shapes.size(); ++i) {
    CHECK(ink(shapes[i]) > 0);
    CHECK(std::find(shapes.begin(), shapes.begin() + static_cast<std::ptrdiff_t>(i), shapes[i]) ==
          shapes.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

TEST_CASE("a scale bar has a round length true to scale") {
  for (const auto& [scale, pixels] : {std::pair{1000.0, 100}, std::pair{400.0, 80}, std::pair{150.0, 75}}) {
    Image image{800, 200};
    draw_scale_bar(image, scale, {.colour = black});
    const int y = static_cast<int>(200 - 1.2 * 18.0);
    int left = 0;
    while (image.at(left, y) == white) {
      ++left;
    }
    int right = 799;
    while (image.at(right, y) == white) {
      --right;
    }
    CHECK(std::abs(right - left - pixels) <= 3); // and the thickness of the ends
  }
  CHECK(detail::round_length(0.12) == test::about(0.1));
  CHECK(detail::round_length(0.2) == test::about(0.2));
  CHECK(detail::round_length(4.99) == test::about(2.0));
  CHECK(detail::round_length(500.0) == test::about(500.0));
  Image image{10, 10};
  CHECK_THROWS_AS(draw_scale_bar(image, 0.0), Error);
}

TEST_CASE("the words at a scale bar and at a colour bar are whole in a small picture too") {
  const TextStyle style{.colour = black};
  /// Columns from the first to the last one with ink in the upper `rows` rows.
  const auto inked_columns = [](const Image& image, int rows) {
    int first = image.width();
    int last = -1;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < image.width(); ++x) {
        if (image.at(x, y) != white) {
          first = std::min(first, x);
          last = std::max(last, x);
        }
      }
    }
    CHECK(first > 0);
    CHECK(last < image.width() - 1);
    return last - first + 1;
  };
  constexpr double strokes = 5.0; // half a stroke and its soft edge beyond the points at both ends
  Image scale{170, 60};           // a bar of 25 pixels below words of 102
  draw_scale_bar(scale, 0.149 * 170 / 0.2, style);
  CHECK(std::abs(inked_columns(scale, 28) - text_width("200 mm", 18.0) - 0.5 * strokes) <= 0.5 * strokes);
  Image colours{240, 120}; // a bar of 40 pixels below words of 174
  draw_colour_bar(colours, 0.0, 2.0, "speed, m/s", style);
  CHECK(std::abs(inked_columns(colours, 64) - text_width("speed, m/s", 18.0) - 0.5 * strokes) <=
        0.5 * strokes);
}

TEST_CASE("a colour bar runs through the sequential colours") {
  Image image{600, 200};
  draw_colour_bar(image, 0.0, 2.0, "speed, m/s", {.colour = black});
  const auto has = [&](Rgb colour) { return count(image, [&](Rgb p) { return p == colour; }) > 0; };
  CHECK(has(sequential_colour(0.5 / 100)));
  CHECK(has(sequential_colour(50.5 / 100)));
  CHECK(has(sequential_colour(99.5 / 100)));
  Image tiny{3, 3};
  draw_colour_bar(tiny, 0.0, 1.0, "x"); // mostly outside, and no harm done
}

#include "scree/io/csv.hpp"
#include "support/environment.hpp"
#include "support/file_content.hpp"
#include "support/plot.hpp"
#include "support/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

using namespace scree;
using namespace scree::examples;
using scree::test::content_of;
using scree::test::ScratchFolder;

namespace {

bool gnuplot_is_missing() {
  if (std::system("gnuplot --version > /dev/null 2>&1") == 0) {
    return false;
  }
  test::skip("gnuplot is not installed");
  return true;
}

void write_table(const std::filesystem::path& file, int rows) {
  CsvWriter table{file, {"drag_m", "force_N", "pitch_deg"}, "a comment, with a comma"};
  for (int k = 0; k < rows; ++k) {
    table.row({0.01 * k, 7.0 * k, -0.1 * k});
  }
}

std::vector<Panel> panels() {
  return {
      {"Drag force",
       "drag distance, m",
       "force, N",
       {{"drag.csv", "drag_m", "force_N", "this_run's"}},
       {{0.3, 150.0, "measured & stated"}, {0.5, 1500.0, "DEM", 1}}},
      {"Pitch", "drag distance, m", "pitch, mrad", {{"drag.csv", "drag_m", "pitch_deg", "b", 17.45}}, {}}};
}

using Places = std::vector<std::array<double, 2>>; // pixels from the top left

/// The numbers behind each `begin` in an SVG, two by two, up to the next quote or bracket.
std::vector<Places> places_behind(const std::string& svg, std::string_view begin) {
  std::vector<Places> found;
  for (auto at = svg.find(begin); at != std::string::npos; at = svg.find(begin, at + 1)) {
    const auto start = at + begin.size();
    std::string text = svg.substr(start, svg.find_first_of("')", start) - start);
    text = text.substr(text.find_last_of('M') + 1); // all of a curve but the sample in the legend
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'L' || c == ','; }, ' ');
    std::istringstream numbers(text);
    auto& places = found.emplace_back();
    for (std::array<double, 2> place{}; numbers >> place[0] >> place[1];) {
      places.push_back(place);
    }
  }
  return found;
}

} // namespace

TEST_CASE("a panel has its x in logarithms where it asks for that, and the next one has not") {
  std::vector<Panel> both = panels();
  both.front().log_x = true;
  const std::string script = plot_script("p", "t", both);
  const auto on = script.find("\nset logscale x\n"), off = script.find("\nunset logscale x\n");
  CHECK(on != std::string::npos);
  CHECK(off != std::string::npos);
  CHECK(on < off);
}

TEST_CASE("curves and points stand where the named columns and the stated values put them") {
  if (gnuplot_is_missing()) {
    return;
  }
  const ScratchFolder folder;
  {
    // The columns stand in another order than that of the plot, among others.
    CsvWriter table{folder / "drag.csv", {"mass_kg", "force_N", "time_s", "drag_m"}, "drag_m,force_N"};
    for (int k = 0; k <= 100; ++k) {
      table.row({5.0 - 0.01 * k, 0.1 * k * k, 3.0 * k, 0.01 * k});
    }
  }
  const Panel panel{
      "Drag force",
      "drag distance, m",
      "force, kN",
      {{"drag.csv", "drag_m", "force_N", "force", 1e-3}, {"drag.csv", "drag_m", "mass_kg", "mass"}},
      {{0.25, 0.75, "measured"}, {0.5, 2.5, "simulated", 1}, {1.0, 6.0, "measured"}}};
  REQUIRE(draw_plot(folder / "", "drag", "Bucket", {panel}) == "");
  const auto svg = content_of(folder / "drag.svg");
  const auto force = places_behind(svg, "<path stroke='rgb(  0, 114, 178)'  d='");
  const auto mass = places_behind(svg, "<path stroke='rgb(213,  94,   0)'  d='");
  REQUIRE(force.size() == 1);
  REQUIRE(mass.size() == 1);
  REQUIRE(force[0].size() == 101);
  REQUIRE(mass[0].size() == 101);
  // The axes are those that put the ends of the mass at (0, 5) and (1, 4).
  const auto [left, five] = mass[0].front();
  const auto [right, four] = mass[0].back();
  REQUIRE(right > left + 100.0);
  REQUIRE(four > five + 20.0);
  const auto distance = [left = left, five = five, right = right, four = four](const auto& place, double x,
                                                                               double y) {
    return std::hypot(place[0] - (left + x * (right - left)), place[1] - (five + (5.0 - y) * (four - five)));
  };
  double worst = 0.0;
  for (std::size_t k = 0; k <= 100; ++k) {
    const double x = 0.01 * static_cast<double>(k);
    worst = std::max({worst, distance(mass[0][k], x, 5.0 - x), distance(force[0][k], x, x * x)});
  }
  CHECK_MESSAGE(worst < 0.1, worst, " pixels");

  const auto marked = [&](const char* symbol, double x, double y) {
    const auto marks = places_behind(svg, message("<use xlink:href='#", symbol, "' transform='translate("));
    return std::count_if(marks.begin(), marks.end(),
                         [&](const Places& mark) { return distance(mark.at(0), x, y) < 0.1; });
  };
  CHECK(marked("gpPt6", 0.25, 0.75) == 1); // filled circles
  CHECK(marked("gpPt6", 1.0, 6.0) == 1);
  CHECK(marked("gpPt7", 0.5, 2.5) == 1); // an open triangle
}

TEST_CASE("named rows stand below each other where their points are, and the next panel has numbers again") {
  if (gnuplot_is_missing()) {
    return;
  }
  const ScratchFolder folder;
  const std::vector<std::string> names{"oedometer.loading_1", "b", "c"};
  Panel rows{
      "Observables", "x", "", {}, {{1.0, 1.0, "measured"}, {2.0, 2.0, "measured"}, {3.0, 3.0, "measured"}}};
  rows.rows = names;
  const Panel numbers{"Force", "x", "force, N", {}, {{1.0, 1.0, "seen", 1}, {2.0, 7.0, "seen", 1}}};
  REQUIRE(draw_plot(folder / "", "both", "t", {rows, numbers}) == "");
  const auto svg = content_of(folder / "both.svg");
  const auto marks = places_behind(svg, "<use xlink:href='#gpPt6' transform='translate(");
  double above = 0.0;
  for (const std::string& row : names) {
    const auto name = svg.find(">" + row + "<");
    REQUIRE(name != std::string::npos);
    const double y = places_behind(svg.substr(svg.rfind("translate(", name)), "translate(").front().at(0)[1];
    CHECK(y > above + 20.0);
    CHECK(std::count_if(marks.begin(), marks.end(),
                        [&](const Places& mark) { return std::abs(mark.at(0)[1] - y) < 10.0; }) == 1);
    above = y;
  }
  // The point at (2, 7) is the highest and the one farthest to the right, with the sample of the legend
  // below.
  const auto upwards = places_behind(svg, "<use xlink:href='#gpPt7' transform='translate(");
  REQUIRE(upwards.size() >= 2);
  const auto by = [](std::size_t axis) {
    return [axis](const Places& a, const Places& b) { return a.at(0)[axis] < b.at(0)[axis]; };
  };
  CHECK(std::min_element(upwards.begin(), upwards.end(), by(1)) ==
        std::max_element(upwards.begin(), upwards.end(), by(0)));
}

TEST_CASE("points of one label look alike and have one entry in the legend, others differ") {
  const auto symbols = [](const std::vector<StatedPoint>& points) {
    const auto script = plot_script("p", "t", {{"title", "x", "y", {}, points}});
    std::vector<std::string> found;
    for (auto at = script.find(" pt "); at != std::string::npos; at = script.find(" pt ", at + 1)) {
      found.push_back(script.substr(at + 4, script.find(' ', at + 4) - at - 4) +
                      (script.compare(script.find("title", at) - 2, 2, "no") == 0 ? "" : " named"));
    }
    found.resize(found.size() / 2); // once for the SVG, once for the PNG
    return found;
  };
  CHECK(symbols({{1, 2, "a"}, {2, 3, "b"}, {3, 4, "a"}, {4, 5, "a", 1}, {5, 6, "c", 1}}) ==
        std::vector<std::string>{"7 named", "5 named", "7", "8 named", "4 named"});
}

TEST_CASE("a plot leaves script, SVG and PNG beside the data") {
  if (gnuplot_is_missing()) {
    return;
  }
  const ScratchFolder folder;
  write_table(folder / "drag.csv", 101);
  CHECK(draw_plot(folder / "", "drag", "Bucket, seed 1", panels()) == "");
  CHECK(content_of(folder / "drag.png").substr(0, 8) == "\x89PNG\r\n\x1a\n");
  const auto svg = content_of(folder / "drag.svg");
  CHECK(svg.find("</svg>") != std::string::npos);
  for (const std::string_view text : {"Bucket, seed 1", "Drag force", "drag distance, m", "force, N",
                                      "this_run's", "measured &amp; stated", "DEM", "pitch, mrad"}) {
    CHECK_MESSAGE(svg.find(text) != std::string::npos, text);
  }
  CHECK_FALSE(std::filesystem::exists(folder / "drag.gnuplot.log"));
  CHECK_FALSE(content_of(folder / "drag.gp").empty());
}

TEST_CASE("a plot of the first row of a run is drawn, so that a run can be watched from its start") {
  if (gnuplot_is_missing()) {
    return;
  }
  const ScratchFolder folder;
  write_table(folder / "drag.csv", 1);
  CHECK(draw_plot(folder / "", "drag", "Bucket", panels()) == "");
  CHECK(std::filesystem::exists(folder / "drag.png"));
}

TEST_CASE("one panel stands alone, four stand two to a row") {
  std::vector<Panel> four;
  for (int k = 0; k < 4; ++k) {
    four.push_back(panels().front());
  }
  CHECK(plot_script("p", "t", {four.front()}).find("multiplot layout 1,1") != std::string::npos);
  CHECK(plot_script("p", "t", four).find("multiplot layout 2,2") != std::string::npos);
  CHECK(plot_script("p", "t", {four[0], four[1], four[2]}).find("multiplot layout 2,2") != std::string::npos);
}

TEST_CASE("a plot that cannot be drawn leaves its script and the reason") {
  const ScratchFolder folder;
  const auto why = draw_plot(folder / "", "drag", "Bucket", panels()); // there is no drag.csv
  CHECK_MESSAGE(why.find("gnuplot could not draw drag") == 0, why);
  CHECK(content_of(folder / "drag.gp").find("drag.csv") != std::string::npos);
  CHECK_FALSE(content_of(folder / "drag.gnuplot.log").empty());

  std::filesystem::create_directory(folder / "it's");
  const auto quote = draw_plot(folder / "it's", "drag", "Bucket", panels());
  CHECK_MESSAGE(quote.find("run gnuplot on") != std::string::npos, quote);
  CHECK(std::filesystem::exists(folder / "it's" / "drag.gp"));
}

#include "scree/io/csv.hpp"
#include "support/environment.hpp"
#include "support/plot.hpp"
#include "support/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

using namespace scree;
using namespace scree::examples;
using scree::test::ScratchFolder;

namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

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

} // namespace

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

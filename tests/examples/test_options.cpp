#include "scree/core/random.hpp"
#include "support/file_content.hpp"
#include "support/options.hpp"
#include "support/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

using namespace scree;
using namespace scree::examples;
using scree::test::content_of;
using scree::test::ScratchFolder;

namespace {

/// A table of one parameter of every kind.
struct Bed {
  std::string out;
  std::string shape = "box";
  double length = 1.5;
  double slope = 0.0;
  std::uint64_t seed = 1;
  bool drained = true;
  std::vector<double> sieves{9.5, 13.2, 19.0};

  [[nodiscard]] Options options() {
    Options options{"drag", "A bucket digs."};
    options.add("out", out, {}, "folder of the results");
    options.add("shape", shape, {"box", "heap"}, "of the bed");
    options.group("The bed");
    options.add("bed.length", length, {0.1, 10.0, "m"}, "along the drag", Provenance::paper);
    options.add("bed.slope", slope, {-90.0, 90.0, "deg"}, "rise along the drag");
    options.add("bed.seed", seed, {0.0, 9e15}, "of all random numbers");
    options.add("bed.drained", drained, "whether water runs off");
    options.add("bed.sieves", sieves, {0.1, 100.0, "mm"}, "openings");
    return options;
  }

  void parse(std::vector<std::string> words) {
    std::vector<const char*> argv{"drag"};
    for (const auto& word : words) {
      argv.push_back(word.c_str());
    }
    options().parse(static_cast<int>(argv.size()), argv.data());
  }

  friend bool operator==(const Bed&, const Bed&) = default;
};

void write(const std::filesystem::path& file, std::string_view content) {
  std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
}

std::string refusal(const std::vector<std::string>& words) {
  Bed bed;
  try {
    bed.parse(words);
  } catch (const Error& error) {
    CHECK_MESSAGE(std::string_view{error.what()}.find('\n') == std::string_view::npos,
                  "one line: ", error.what());
    return error.what();
  }
  return "accepted";
}

/// The message for a file of this content, less the name of the file.
std::string file_refusal(std::string_view content) {
  const ScratchFolder folder;
  const auto file = folder / "in.toml";
  write(file, content);
  const auto why = refusal({"--config", file.string()});
  REQUIRE_MESSAGE(why.rfind(file.string() + ":", 0) == 0, why);
  return why.substr(file.string().size() + 1);
}

} // namespace

TEST_CASE("without arguments the defaults stay") {
  Bed bed;
  bed.parse({});
  CHECK(bed == Bed{});
}

TEST_CASE("the command line sets values of every kind") {
  Bed bed;
  bed.parse({"--out", "a b \u00E9", "--shape=heap", "--bed.length", "+2e0", "--bed.slope", "-5.5",
             "--bed.seed", "9000000000000000", "--bed.drained", "false", "--bed.sieves", "1,2.5,1e1"});
  CHECK(bed == Bed{"a b \u00E9", "heap", 2.0, -5.5, 9000000000000000U, false, {1.0, 2.5, 10.0}});
}

TEST_CASE("a file sets values of every kind, and the command line wins over it") {
  const ScratchFolder folder;
  const auto file = folder / "in.toml";
  write(file, "shape = 'heap'\n[bed]\nlength = 2\nslope = -5.5\nseed = 7\ndrained = false\nsieves = [1, 2.5, "
              "10.0]\n");
  Bed bed;
  bed.parse({"--bed.length", "3", "--config", file.string()});
  CHECK(bed == Bed{"", "heap", 3.0, -5.5, 7, false, {1.0, 2.5, 10.0}});

  write(file, "bed.length = 4.0\n");
  bed.parse({"--config=" + file.string()});
  CHECK(bed.length == 4.0);

  write(file, "[bed]\n# length = 2.0\n");
  CHECK_NOTHROW(bed.parse({"--config", file.string()}));
}

TEST_CASE("what was used is written so that it reads back to the same bits") {
  const ScratchFolder folder;
  const auto file = folder / "input.toml";
  Bed bed{"say \"a\\b\"\n\x7f", "heap", 1.0 / 3.0, 1e-17, 9000000000000000U, false, {0.1, 3.0, 1e2 / 3.0}};
  bed.options().write_toml(file);
  Bed again;
  again.parse({"--config", file.string()});
  CHECK(again == bed);

  Bed{}.options().write_toml(file);
  CHECK(content_of(file) == "# drag: every parameter of this run; read back with --config.\n"
                            "out = \"\"  # ours; folder of the results\n"
                            "shape = \"box\"  # ours; of the bed\n"
                            "\n[bed]\n"
                            "length = 1.5  # m; paper; along the drag\n"
                            "slope = 0.0  # deg; ours; rise along the drag\n"
                            "seed = 1  # ours; of all random numbers\n"
                            "drained = true  # ours; whether water runs off\n"
                            "sieves = [9.5, 13.2, 19.0]  # mm; ours; openings\n");
}

TEST_CASE("all numbers of the written file come back to the bit") {
  const ScratchFolder folder;
  const auto file = folder / "input.toml";
  using Limits = std::numeric_limits<double>;
  std::vector<double> numbers{
      0.0,           -0.0,   3.0,    -1e22, 9007199254740993.0, Limits::max(), Limits::lowest(),
      Limits::min(), 5e-324, -5e-324};
  Random random{7};
  while (numbers.size() < 300) {
    numbers.push_back(random.normal() * std::pow(10.0, std::floor(random.uniform(-300.0, 300.0))));
  }
  // Each number alone and all of them in a list.
  std::vector<double> alone = numbers;
  std::vector<double> list = numbers;
  std::uint64_t most = std::numeric_limits<std::int64_t>::max();
  const auto options = [&] {
    Options all{"bits", "Keeps bits."};
    for (std::size_t k = 0; k < alone.size(); ++k) {
      all.add("value." + std::to_string(k), alone[k], {Limits::lowest(), Limits::max()}, "a number");
    }
    all.add("list", list, {Limits::lowest(), Limits::max()}, "numbers");
    all.add("most", most, {0.0, 1e19}, "the largest whole number of TOML");
    return all;
  };
  options().write_toml(file);
  alone.assign(alone.size(), 1.0);
  list.assign(list.size(), 1.0);
  most = 0;
  const std::array argv{"bits", "--config", file.c_str()};
  options().parse(static_cast<int>(argv.size()), argv.data());
  const auto same_bits = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  CHECK(std::equal(numbers.begin(), numbers.end(), alone.begin(), alone.end(), same_bits));
  CHECK(std::equal(numbers.begin(), numbers.end(), list.begin(), list.end(), same_bits));
  CHECK(most == 9223372036854775807U);
}

TEST_CASE("a whole number that no double holds is rounded, not refused") {
  const ScratchFolder folder;
  const auto file = folder / "in.toml";
  write(file, "x = 9007199254740993\nlist = [9007199254740993, -9223372036854775808]\n"); // 2^53 + 1, -2^63
  double x = 0.0;
  std::vector<double> list{0.0, 0.0};
  Options options{"round", "Rounds."};
  options.add("x", x, {0.0, 1e16}, "a number");
  options.add("list", list, {-1e19, 1e19}, "numbers");
  const std::array argv{"round", "--config", file.c_str()};
  options.parse(static_cast<int>(argv.size()), argv.data());
  CHECK(x == 9007199254740992.0);
  CHECK(list == std::vector<double>{9007199254740992.0, -9223372036854775808.0});
}

TEST_CASE("the record names values, and the defaults that are not in the paper") {
  Bed bed;
  const auto options = bed.options();
  CHECK(options.json().dump() == R"({"out":"","shape":"box","bed.length":1.5,"bed.slope":0.0,"bed.seed":1,)"
                                 R"("bed.drained":true,"bed.sieves":[9.5,13.2,19.0]})");
  CHECK(options.not_in_the_paper() ==
        std::vector<std::string>{"out", "shape", "bed.slope", "bed.seed", "bed.drained", "bed.sieves"});
}

TEST_CASE("the help lists every parameter with unit, default, range and source") {
  Bed bed;
  try {
    bed.parse({"--help"});
    FAIL("no help");
  } catch (const HelpWanted& help) {
    const auto has = [&](std::string_view text) {
      CHECK_MESSAGE(help.text.find(text) != std::string::npos, text, " is not in\n", help.text);
    };
    has("A bucket digs.");
    has("--config FILE.toml");
    has("--out TEXT");
    has("[none; ours]");
    has("--shape box|heap");
    has("The bed:");
    has("--bed.length NUMBER m");
    has("along the drag [1.5; 0.1 to 10; paper]");
    has("[0; -90 to 90; ours]");
    has("--bed.seed INTEGER");
    has("[1; 0 or more; ours]");
    has("--bed.drained true|false");
    has("openings [9.5,13.2,19; 0.1 to 100; ours]");
  }
}

TEST_CASE("a series takes any number of values from its fewest on, from a file too") {
  const ScratchFolder folder;
  std::vector<double> depths{0.1, 0.2};
  Options options{"drag", "A bucket digs."};
  options.add_series("depths", depths, 2, {0.0, 1.0, "m"}, "looked at");
  const auto parse = [&](const char* name, const std::string& value) {
    const std::array<const char*, 3> argv{"drag", name, value.c_str()};
    options.parse(static_cast<int>(argv.size()), argv.data());
  };
  const std::vector<double> four{0.3, 0.2, 0.1, 0.0};
  parse("--depths", "0.3,0.2,0.1,0");
  CHECK(depths == four);
  options.write_toml(folder / "input.toml");
  depths = {0.5};
  parse("--config", (folder / "input.toml").string());
  CHECK(depths == four);
  CHECK_THROWS_WITH_AS(parse("--depths", "1"), "command line: --depths: 1 numbers, but it takes 2 or more",
                       Error);
}

TEST_CASE("the command line is refused in one line that names the parameter") {
  CHECK(refusal({"--bed.length", "20"}) == "command line: --bed.length = 20 m is outside [0.1, 10] m");
  CHECK(refusal({"--bed.length", "nan"}) == "command line: --bed.length = nan is not a finite number");
  CHECK(refusal({"--bed.length", "two"}) == "command line: --bed.length = two is not a finite number");
  CHECK(refusal({"--bed.length", "2m"}) == "command line: --bed.length = 2m is not a finite number");
  CHECK(refusal({"--bed.length", ""}) == "command line: --bed.length =  is not a finite number");
  CHECK(refusal({"--bed.seed", "-1"}) == "command line: --bed.seed = -1 is not a whole number, 0 or above");
  CHECK(refusal({"--bed.seed", "1.5"}) == "command line: --bed.seed = 1.5 is not a whole number, 0 or above");
  CHECK(refusal({"--bed.seed", "99999999999999999999"}) ==
        "command line: --bed.seed = 99999999999999999999 is not a whole number, 0 or above");
  CHECK(refusal({"--bed.seed", "9000000000000001"}) ==
        "command line: --bed.seed = 9e+15 is outside [0, 9e+15]");
  CHECK(refusal({"--bed.drained", "yes"}) == "command line: --bed.drained = yes is not true or false");
  CHECK(refusal({"--shape", "cone"}) == "command line: --shape = \"cone\" is not one of box, heap");
  CHECK(refusal({"--bed.sieves", "1,2"}) == "command line: --bed.sieves: 2 numbers, but it takes 3");
  CHECK(refusal({"--bed.sieves", "1,,2"}) ==
        "command line: --bed.sieves = 1,,2 is not a list of numbers with commas between them");
  CHECK(refusal({"--bed.sieves", "1,200,3"}) ==
        "command line: --bed.sieves[1] = 200 mm is outside [0.1, 100] mm");
  CHECK(refusal({"--bed.lenght", "2"}) ==
        "command line: there is no parameter 'bed.lenght'; did you mean 'bed.length'?");
  CHECK(refusal({"--bed.lenght=2"}) ==
        "command line: there is no parameter 'bed.lenght'; did you mean 'bed.length'?");
  CHECK(refusal({"--something.quite.different", "2"}) ==
        "command line: there is no parameter 'something.quite.different'");
  CHECK(refusal({"--bed.seed", "9223372036854775808"}) ==
        "command line: --bed.seed = 9223372036854775808 is not a whole number, 0 or above"); // beyond TOML
  CHECK(refusal({"--out", "\xE9t\xE9"}) == "command line: --out = \xE9t\xE9 is not UTF-8 text");
  CHECK(refusal({"stray"}) == "command line: 'stray' belongs to no parameter");
  CHECK(refusal({"--bed.length"}).rfind("command line: --bed.length: ", 0) == 0);
  CHECK(refusal({"--bed.length", "1", "--bed.length", "2"}).rfind("command line: --bed.length: ", 0) == 0);
}

TEST_CASE("a file is refused with its line and the parameter") {
  CHECK(file_refusal("[bed]\nlenght = 2\n") ==
        "2: there is no parameter 'bed.lenght'; did you mean 'bed.length'?");
  CHECK(file_refusal("\n\nbed.length = 20\n") == "3: bed.length = 20 m is outside [0.1, 10] m");
  CHECK(file_refusal("bed.length = nan\n") == "1: bed.length = nan is not a finite number");
  CHECK(file_refusal("bed.length = inf\n") == "1: bed.length = inf is not a finite number");
  CHECK(file_refusal("[bed]\nlength = \"2\"\n") == "2: bed.length = '2' is not a number");
  CHECK(file_refusal("[bed]\nlength = [2]\n") == "2: bed.length = [ 2 ] is not a number");
  CHECK(file_refusal("[bed.length]\nx = 2\n") == "1: bed.length = a table is not a number");
  CHECK(file_refusal("bed.seed = 1.0\n") == "1: bed.seed = 1.0 is not a whole number, 0 or above");
  CHECK(file_refusal("bed.seed = -1\n") == "1: bed.seed = -1 is not a whole number, 0 or above");
  CHECK(file_refusal("bed.drained = 1\n") == "1: bed.drained = 1 is not true or false");
  CHECK(file_refusal("shape = 3\n") == "1: shape = 3 is not a text");
  CHECK(file_refusal("shape = 'cone'\n") == "1: shape = \"cone\" is not one of box, heap");
  CHECK(file_refusal("bed.sieves = 3\n") == "1: bed.sieves = 3 is not a list of numbers");
  CHECK(file_refusal("bed.sieves = [1, 'a', 2]\n") ==
        "1: bed.sieves = [ 1, 'a', 2 ] is not a list of numbers");
  CHECK(file_refusal("bed.sieves = [1, 2]\n") == "1: bed.sieves: 2 numbers, but it takes 3");
  CHECK(file_refusal("bed = 3\n") == "1: there is no parameter 'bed'");
  CHECK(file_refusal("[rope]\n") == "1: there is no parameter 'rope'");
  CHECK(file_refusal("[[bed]]\nlength = 2\n") == "1: there is no parameter 'bed'");
}

TEST_CASE("a file that is empty, cut off or oversize is refused") {
  CHECK(file_refusal("") == "1: the file holds no parameter");
  CHECK(file_refusal("# nothing\n") == "1: the file holds no parameter");
  CHECK(file_refusal("shape = 'box'\n[bed]\nlength =").rfind("3: ", 0) == 0);
  CHECK(file_refusal("shape = 'bo").rfind("1: ", 0) == 0);
  CHECK(file_refusal("bed.length = 1\nbed.length = 2\n").rfind("2: ", 0) == 0);
  CHECK(file_refusal("[bed]\nseed = 2\nlength = 1.2") ==
        "3: the file is cut off, or its last line lacks a line break"); // of "length = 1.25\n", perhaps
  CHECK(file_refusal("out = '\xE9t\xE9'\n").rfind("1: ", 0) == 0);
  CHECK(file_refusal("\n\n" + std::string(1U << 20U, '#') + "\n") ==
        "3: the file is larger than 1048576 bytes");
  const ScratchFolder folder;
  const auto missing = (folder / "missing.toml").string();
  CHECK(refusal({"--config", missing}) == missing + ": cannot be read: no such file");
}

TEST_CASE("what decides on other defaults can be looked up before they are set") {
  const auto peek = [](std::vector<const char*> words) {
    words.insert(words.begin(), "drag");
    return Options::peek(static_cast<int>(words.size()), words.data(), "fidelity");
  };
  const ScratchFolder folder;
  const auto file = (folder / "in.toml").string();
  write(file, "fidelity = 'lab'\n");
  CHECK(peek({}) == std::nullopt);
  CHECK(peek({"--fidelity", "lab"}) == "lab");
  CHECK(peek({"--fidelity=lab"}) == "lab");
  CHECK(peek({"--fidelities", "lab"}) == std::nullopt);
  CHECK(peek({"--config", file.c_str()}) == "lab");
  CHECK(peek({"--config", file.c_str(), "--fidelity", "desk"}) == "desk");
  CHECK(peek({"--fidelity"}) == std::nullopt); // parse() refuses it
  const auto config = "--config=" + file;
  CHECK(peek({config.c_str()}) == "lab");
  write(file, "fidelity = 3\n");
  CHECK(peek({config.c_str()}) == std::nullopt);
  write(file, "[deep]\nfidelity = 'lab'\n");
  CHECK(peek({config.c_str()}) == std::nullopt);
  write(file, "\nfidelity = 'lab\n");
  try {
    (void)peek({config.c_str()});
    FAIL("read");
  } catch (const Error& error) {
    CHECK_MESSAGE(std::string_view{error.what()}.rfind(file + ":2: ", 0) == 0, error.what());
  }
}

#include "scree/core/random.hpp"
#include "scree/geometry/mesh_topology.hpp"
#include "scree/io/stl.hpp"
#include "support/file_content.hpp"
#include "support/meshes.hpp"
#include "support/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

using namespace scree;

namespace stl_tests {
using scree::test::box_mesh;
using scree::test::content_of;
using scree::test::ScratchFolder;
using scree::test::sphere_mesh;

namespace {

void write(const std::filesystem::path& file, std::string_view content) {
  std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
}

/// Why the file is refused, or nothing if it is read. Any other exception ends the test.
std::optional<std::string> refusal(const std::filesystem::path& file, const StlOptions& options = {}) {
  try {
    (void)read_stl(file, options);
  } catch (const Error& error) {
    return error.what();
  }
  return std::nullopt;
}

/// Checks that the content is refused at this place, with this in the message.
void refused_at(std::size_t place, std::string_view what, std::string_view content,
                const StlOptions& options = {}) {
  const ScratchFolder folder;
  const auto file = folder / "refused.stl";
  write(file, content);
  const auto why = refusal(file, options);
  REQUIRE_MESSAGE(why, "accepted: ", content);
  CHECK_MESSAGE(why->rfind(message(file.string(), ":", place, ": "), 0) == 0, *why);
  CHECK_MESSAGE(why->find(what) != std::string::npos, *why);
}

bool same_facets(const TriangleMesh& a, const TriangleMesh& b) {
  if (a.facets.size() != b.facets.size()) {
    return false;
  }
  for (std::size_t i = 0; i < a.facets.size(); ++i) {
    if (a.corners(i) != b.corners(i)) {
      return false;
    }
  }
  return true;
}

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices = {{0.1, 0.2, 0.3}, {1.0 / 3.0, 0, 0}, {0, 2.0 / 7.0, 1e-17}, {-1e30, 1e-30, 3.25}};
  mesh.facets = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

const std::string good_text = "solid one facet\n"
                              "facet normal 0 0 1\n"
                              "outer loop\n"
                              "vertex 0 0 0\n"
                              "vertex 1 0 0\n"
                              "vertex 0 1 0\n"
                              "endloop\n"
                              "endfacet\n"
                              "endsolid\n";

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

std::string bytes(std::uint32_t value) {
  std::string out;
  for (int i = 0; i < 4; ++i) {
    out.push_back(static_cast<char>((value >> (8 * i)) & 0xffU));
  }
  return out;
}

/// A binary file by hand, of corners (k, k + 1, k + 2) / 8.
std::string good_binary(std::uint32_t facets, std::string header = "by hand") {
  header.resize(80, '\0');
  std::string out = header + bytes(facets);
  for (std::uint32_t i = 0; i < facets; ++i) {
    out += std::string(12, '\0');
    for (std::uint32_t k = 0; k < 9; ++k) {
      const float number = static_cast<float>(i + k + k / 3) / 8.0F;
      out += bytes(std::bit_cast<std::uint32_t>(number));
    }
    out += "ab";
  }
  return out;
}

void set_number(std::string& binary, std::size_t facet, std::size_t number, float value) {
  binary.replace(84 + 50 * facet + 12 + 4 * number, 4, bytes(std::bit_cast<std::uint32_t>(value)));
}

} // namespace

TEST_CASE("text keeps every bit of the coordinates") {
  const ScratchFolder folder;
  for (const auto& mesh : {tetrahedron(), sphere_mesh(0.123, 2)}) {
    write_stl_text(folder / "mesh.stl", mesh, "a name");
    const auto read = read_stl(folder / "mesh.stl");
    CHECK(same_facets(read, mesh));
    CHECK(read.vertices.size() == mesh.vertices.size());
    CHECK(check(read).closed());
  }
}

TEST_CASE("binary keeps the coordinates as floats, and those to the bit") {
  const ScratchFolder folder;
  auto mesh = tetrahedron();
  write_stl_binary(folder / "mesh.stl", mesh);
  CHECK(std::filesystem::file_size(folder / "mesh.stl") == 84 + 4 * 50);
  auto rounded = mesh;
  for (auto& v : rounded.vertices) {
    for (double& coordinate : v) {
      const volatile float stored = static_cast<float>(coordinate); // GCC 12 may not round otherwise
      coordinate = static_cast<double>(stored);
    }
  }
  const auto read = read_stl(folder / "mesh.stl");
  CHECK(same_facets(read, rounded));
  CHECK(check(read).closed());
  // A mesh of floats, written once more, gives the same file: its normals too come from the same numbers.
  write_stl_binary(folder / "rounded.stl", rounded);
  write_stl_binary(folder / "again.stl", read);
  CHECK(content_of(folder / "again.stl") == content_of(folder / "rounded.stl"));
}

TEST_CASE("a binary file is laid out as the format says") {
  const ScratchFolder folder;
  TriangleMesh mesh;
  mesh.vertices = {{1, 2, 3}, {2, 2, 3}, {1, 3, 3}};
  mesh.facets = {{0, 1, 2}};
  write_stl_binary(folder / "mesh.stl", mesh);
  const auto written = content_of(folder / "mesh.stl");
  REQUIRE(written.size() == 134);
  CHECK(written.substr(0, 5) != "solid");
  std::string expected = bytes(1);
  for (const float number : {0.F, 0.F, 1.F, 1.F, 2.F, 3.F, 2.F, 2.F, 3.F, 1.F, 3.F, 3.F}) {
    expected += bytes(std::bit_cast<std::uint32_t>(number));
  }
  CHECK(written.substr(80) == expected + std::string(2, '\0'));
}

TEST_CASE("a binary file by hand is read, whatever its header") {
  const ScratchFolder folder;
  // Programs exist that begin the header of a binary file as that of a text file.
  for (const auto* header : {"by hand", "solid", "solid made by a program\nfacet normal"}) {
    write(folder / "mesh.stl", good_binary(3, header));
    const auto mesh = read_stl(folder / "mesh.stl");
    REQUIRE(mesh.facets.size() == 3);
    CHECK(mesh.corners(1)[0] == Vector{0.125, 0.25, 0.375});
    CHECK(mesh.corners(2)[2] == Vector{1.25, 1.375, 1.5});
  }
  write(folder / "mesh.stl", good_binary(1, std::string(80, ' ').replace(0, 5, "solid")));
  CHECK(read_stl(folder / "mesh.stl").facets.size() == 1);
}

TEST_CASE("text is read in any layout and in capitals, with several solids and signs") {
  const ScratchFolder folder;
  const auto file = folder / "mesh.stl";
  const auto expected = [&] {
    write(file, good_text);
    return read_stl(file);
  }();
  REQUIRE(expected.facets.size() == 1);
  CHECK(expected.corners(0)[1] == Vector{1.0, 0.0, 0.0});
  std::string capitals = good_text;
  for (char& c : capitals) {
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  std::string windows;
  for (const char c : good_text) {
    windows += c == '\n' ? "\r\n" : std::string(1, c);
  }
  for (const auto& text :
       {capitals, windows, "\n\t " + good_text, replaced(good_text, "endloop\n", "endloop "),
        replaced(good_text, "vertex 1 0 0", "vertex +1.0e+0 -0 0.000"),
        replaced(good_text, "normal 0 0 1", "normal nan -nan(ind) 1e999"),
        replaced(good_text, "endsolid\n", "endsolid one facet")}) {
    write(file, text);
    CHECK(same_facets(read_stl(file), expected));
  }
  write(file, good_text + replaced(good_text, "vertex 1 0 0", "vertex 2 0 0"));
  const auto two = read_stl(file);
  REQUIRE(two.facets.size() == 2);
  CHECK(two.vertices.size() == 4);
  CHECK(two.corners(1)[1] == Vector{2.0, 0.0, 0.0});
}

TEST_CASE("a file in millimetres is scaled before it is welded") {
  const ScratchFolder folder;
  const auto file = folder / "mesh.stl";
  write(file, good_text + replaced(good_text, "vertex 1 0 0", "vertex 1.01 0 0"));
  CHECK(read_stl(file).vertices.size() == 4);
  CHECK(read_stl(file, {.scale = 1e-3, .weld_tolerance = 1e-3}).facets.size() == 2);
  const auto mesh = read_stl(file, {.scale = 1e-3, .weld_tolerance = 2e-5});
  REQUIRE(mesh.vertices.size() == 3);
  CHECK(mesh.vertices[1] == Vector{1e-3, 0.0, 0.0});
}

TEST_CASE("text that is no STL is refused with the line") {
  refused_at(2, "\"facets\" where \"facet\" or \"endsolid\"", replaced(good_text, "facet n", "facets n"));
  refused_at(2, "\"norm\" where \"normal\"", replaced(good_text, "normal", "norm"));
  refused_at(3, "\"inner\" where \"outer\"", replaced(good_text, "outer", "inner"));
  refused_at(4, "\"vertex\" where \"loop\"", replaced(good_text, "outer loop", "outer"));
  refused_at(5, "\"vortex\" where \"vertex\"", replaced(good_text, "vertex 1", "vortex 1"));
  refused_at(6, "\"vertex\" where a finite coordinate", replaced(good_text, "vertex 1 0 0", "vertex 1 0"));
  refused_at(5, "\"0x1\"", replaced(good_text, "vertex 1 0 0", "vertex 0x1 0 0"));
  refused_at(5, "\"1,5\"", replaced(good_text, "vertex 1 0 0", "vertex 1,5 0 0"));
  refused_at(7, "\"vertex\" where \"endloop\"", replaced(good_text, "endloop", "vertex 1 1 1\nendloop"));
  refused_at(8, "\"facet\" where \"endfacet\"", replaced(good_text, "endfacet", "facet"));
  refused_at(9, "\"?oo\" where \"facet\" or \"endsolid\"", replaced(good_text, "endsolid", "\xffoo"));
}

TEST_CASE("text with coordinates that are not finite is refused with the line") {
  for (const auto* number : {"nan", "inf", "-infinity", "NaN", "1e999", "-nan(ind)"}) {
    refused_at(6, number, replaced(good_text, "vertex 0 1 0", message("vertex 0 1 ", number)));
  }
  refused_at(5, "not finite once it is scaled", replaced(good_text, "vertex 1 0 0", "vertex 1e300 0 0"),
             {.scale = 1e10});
}

TEST_CASE("text that ends early, is empty or goes on is refused with the line") {
  refused_at(1, "empty", "");
  refused_at(1, "ends where \"facet\" or \"endsolid\" is expected", "solid");
  refused_at(6, "ends where", good_text.substr(0, good_text.find("vertex 0 1")));
  refused_at(3, "no facets", "solid nothing\nendsolid nothing\n");
  refused_at(11, "\"garbage\" after the end of the solid", good_text + "\ngarbage\n");
  refused_at(10, "\"facet\" after the end of the solid", good_text + "facet normal 0 0 1\n");
}

TEST_CASE("a binary file of another length than its header's is refused with the facet") {
  const auto whole = good_binary(3);
  refused_at(3, "facet 3 is cut off", whole.substr(0, whole.size() - 1));
  refused_at(1, "facet 1 is cut off", whole.substr(0, 84));
  refused_at(1, "before facet 1", whole.substr(0, 83));
  refused_at(3, "facet 3 is the last one by the header, but 1 more bytes follow", whole + "x");
  refused_at(3, "facet 3 is the last one", whole + good_binary(1).substr(84));
  refused_at(1, "facet 1 is missing", good_binary(0));
  // Refused by its length before anything of that size is asked for.
  auto lying = whole;
  lying.replace(80, 4, bytes(0xffffffffU));
  refused_at(4, "facet 4 is cut off", lying);
  // Text that does not begin as text must is told so.
  refused_at(1, "\"solid\"", replaced(good_text, "solid", "salad").substr(0, 60));
  refused_at(3, "\"solid\"", replaced(good_text, "solid", "salad").append(100, ' '));
}

TEST_CASE("a binary file with coordinates that are not finite is refused with the facet") {
  for (const float number : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity()}) {
    for (std::size_t k = 0; k < 9; ++k) {
      auto binary = good_binary(3);
      set_number(binary, 1, k, number);
      refused_at(2, "facet 2 has a coordinate that is not finite", binary);
    }
  }
  auto binary = good_binary(1);
  set_number(binary, 0, 3, 3e38F);
  refused_at(1, "facet 1 has a coordinate that is not finite", binary, {.scale = 1e300});
}

TEST_CASE("a file with more facets than allowed is refused, one with as many is read") {
  const ScratchFolder folder;
  refused_at(3, "facet 3 of 5", good_binary(5), {.max_facets = 2});
  refused_at(11, "more than the 1 facets allowed", good_text + good_text, {.max_facets = 1});
  write(folder / "mesh.stl", good_binary(5));
  CHECK(read_stl(folder / "mesh.stl", {.max_facets = 5}).facets.size() == 5);
  write(folder / "mesh.stl", good_text + good_text);
  CHECK(read_stl(folder / "mesh.stl", {.max_facets = 2}).facets.size() == 2);
}

TEST_CASE("an endless word does not fill the memory") {
  refused_at(2, "a word of more than 100 characters",
             replaced(good_text, "facet normal", std::string(100000, 'a')));
  // A name may be of any length; it is passed over.
  const ScratchFolder folder;
  write(folder / "mesh.stl", replaced(good_text, "one", std::string(100000, 'a')));
  CHECK(read_stl(folder / "mesh.stl").facets.size() == 1);
}

TEST_CASE("a file cut off at any byte is read whole or refused") {
  const ScratchFolder folder;
  const auto file = folder / "cut.stl";
  write_stl_text(file, tetrahedron());
  const auto text = content_of(file);
  write_stl_binary(file, tetrahedron());
  const auto binary = content_of(file);
  int whole = 0;
  for (const auto& content : {text, binary}) {
    for (std::size_t size = 0; size <= content.size(); ++size) {
      write(file, content.substr(0, size));
      const auto why = refusal(file);
      if (why) {
        CHECK(why->rfind(file.string() + ":", 0) == 0);
      } else {
        CHECK(read_stl(file).facets.size() == 4);
        ++whole;
      }
    }
  }
  // The text from "endsolid" on, cut within " scree\n", and the whole binary.
  CHECK(whole == 8 + 1);
}

TEST_CASE("a file with changed bytes is read or refused, and never worse") {
  const ScratchFolder folder;
  const auto file = folder / "changed.stl";
  Random random{29};
  int read = 0;
  int refused = 0;
  for (const auto& good : {good_text + good_text, good_binary(4), good_binary(4, "solid")}) {
    for (int i = 0; i < 700; ++i) {
      auto content = good;
      for (std::size_t k = 0; k <= random.index(4); ++k) {
        content[random.index(content.size())] = static_cast<char>(random.index(256));
      }
      write(file, content);
      const auto why = refusal(file, {.max_facets = 1000});
      (why ? refused : read) += 1;
      if (why) {
        CHECK(why->rfind(file.string() + ":", 0) == 0);
      }
    }
  }
  CHECK(read > 100);
  CHECK(refused > 100);
}

TEST_CASE("a path that is no file is refused by name") {
  const ScratchFolder folder;
  const auto missing = refusal(folder / "missing.stl");
  REQUIRE(missing);
  CHECK(missing->find("missing.stl") != std::string::npos);
  std::filesystem::create_directory(folder / "folder.stl");
  const auto not_a_file = refusal(folder / "folder.stl");
  REQUIRE(not_a_file);
  CHECK(not_a_file->find("folder.stl") != std::string::npos);
}

TEST_CASE("options out of range are refused") {
  const ScratchFolder folder;
  const auto file = folder / "mesh.stl";
  write(file, good_text);
  CHECK_THROWS_AS((void)read_stl(file, {.scale = 0.0}), Error);
  CHECK_THROWS_AS((void)read_stl(file, {.scale = std::numeric_limits<double>::infinity()}), Error);
  CHECK_THROWS_AS((void)read_stl(file, {.weld_tolerance = -1.0}), Error);
  CHECK_THROWS_AS((void)read_stl(file, {.max_facets = 0}), Error);
}

TEST_CASE("a mesh that the file could not hold is not written") {
  const ScratchFolder folder;
  const auto file = folder / "mesh.stl";
  auto mesh = box_mesh({1.0, 1.0, 1.0});
  mesh.vertices[7].x() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(write_stl_text(file, mesh), Error);
  CHECK_THROWS_AS(write_stl_binary(file, mesh), Error);
  mesh.vertices[7].x() = 1e39; // fits a double, but no float
  CHECK_THROWS_AS(write_stl_binary(file, mesh), Error);
  CHECK_FALSE(std::filesystem::exists(file));
  CHECK_NOTHROW(write_stl_text(file, mesh));
  mesh.facets[3][0] = 8;
  CHECK_THROWS_AS(write_stl_text(file, mesh), Error);
  CHECK_THROWS_AS(write_stl_text(file, box_mesh({1.0, 1.0, 1.0}), "two\nlines"), Error);
  CHECK_THROWS_AS(write_stl_binary(folder / "no_such_folder" / "mesh.stl", tetrahedron()), Error);
}

} // namespace stl_tests

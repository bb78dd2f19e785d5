#include "scree/core/random.hpp"
#include "scree/io/vtk.hpp"
#include "support/file_content.hpp"
#include "support/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

using namespace scree;
using boost::property_tree::ptree;
using scree::test::content_of;
using scree::test::ScratchFolder;

namespace {

ptree parsed(const std::string& xml) {
  std::istringstream in(xml);
  ptree tree;
  boost::property_tree::read_xml(in, tree);
  return tree;
}

/// A .vtp file read back: its XML, and the bytes behind it.
struct Document {
  ptree piece;
  std::string bytes;

  explicit Document(const std::filesystem::path& file) {
    const std::string content = content_of(file);
    const std::string_view start = "<AppendedData encoding=\"raw\">\n_";
    const std::string_view end = "\n</AppendedData>\n</VTKFile>\n";
    const auto data = content.find(start);
    REQUIRE(data != std::string::npos);
    REQUIRE(content.size() >= data + start.size() + end.size());
    REQUIRE(std::string_view{content}.substr(content.size() - end.size()) == end);
    bytes = content.substr(data + start.size(), content.size() - end.size() - data - start.size());
    const auto tree = parsed(content.substr(0, data) + "</VTKFile>\n");
    CHECK(tree.get<std::string>("VTKFile.<xmlattr>.type") == "PolyData");
    CHECK(tree.get<std::string>("VTKFile.<xmlattr>.header_type") == "UInt64");
    const bool little = tree.get<std::string>("VTKFile.<xmlattr>.byte_order") == "LittleEndian";
    CHECK(little == (std::endian::native == std::endian::little));
    piece = tree.get_child("VTKFile.PolyData.Piece");
  }

  /// The entries of an array within an element, e.g. ("PointData", "radius").
  template <class T>
  std::vector<T> values(const std::string& element, const std::string& name, const std::string& type,
                        int components) const {
    for (const auto& child : piece.get_child(element)) {
      if (child.first != "DataArray" || child.second.get<std::string>("<xmlattr>.Name") != name) {
        continue;
      }
      const auto& array = child.second;
      CHECK(array.get<std::string>("<xmlattr>.type") == type);
      CHECK(array.get<int>("<xmlattr>.NumberOfComponents") == components);
      CHECK(array.get<std::string>("<xmlattr>.format") == "appended");
      const auto offset = array.get<std::size_t>("<xmlattr>.offset");
      std::uint64_t size = 0;
      REQUIRE(offset + sizeof size <= bytes.size());
      std::memcpy(&size, bytes.data() + offset, sizeof size);
      REQUIRE(offset + sizeof size + size <= bytes.size());
      REQUIRE(size % sizeof(T) == 0);
      std::vector<T> result(size / sizeof(T));
      if (size > 0) {
        std::memcpy(result.data(), bytes.data() + offset + sizeof size, size);
      }
      return result;
    }
    FAIL("no array ", name, " in ", element);
    return {};
  }

  std::size_t count(const std::string& what) const { return piece.get<std::size_t>("<xmlattr>." + what); }
};

std::vector<float> flattened(const std::vector<Vector>& vectors) {
  std::vector<float> flat;
  for (const auto& v : vectors) {
    for (const double x : {v.x(), v.y(), v.z()}) {
      flat.push_back(static_cast<float>(x));
    }
  }
  return flat;
}

std::vector<Vector> random_vectors(std::size_t count, Random& random) {
  std::vector<Vector> vectors(count);
  for (auto& v : vectors) {
    v = {random.normal(), random.normal(), random.normal()};
  }
  return vectors;
}

} // namespace

TEST_CASE("points and their arrays come back from a VTK file") {
  const ScratchFolder folder;
  const auto file = folder / "grains.vtp";
  Random random{3};
  const auto points = random_vectors(500, random);
  const auto velocities = random_vectors(500, random);
  std::vector<double> radii(500);
  std::vector<std::uint32_t> bodies(500);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    radii[i] = random.uniform(0.001, 0.02);
    bodies[i] = static_cast<std::uint32_t>(random.index(4'000'000'000U));
  }
  const std::array<VtkArray, 3> arrays{
      {{"radius", radii}, {"velocity <m/s> & \"more\"", velocities}, {"body", bodies}}};
  write_vtp_points(file, points, arrays);

  const Document document{file};
  CHECK(document.count("NumberOfPoints") == 500);
  CHECK(document.count("NumberOfVerts") == 1);
  CHECK(document.count("NumberOfPolys") == 0);
  CHECK(document.values<float>("Points", "Points", "Float32", 3) == flattened(points));
  CHECK(document.values<float>("PointData", "velocity <m/s> & \"more\"", "Float32", 3) ==
        flattened(velocities));
  CHECK(document.values<float>("PointData", "radius", "Float32", 1) ==
        std::vector<float>(radii.begin(), radii.end()));
  CHECK(document.values<std::uint32_t>("PointData", "body", "UInt32", 1) == bodies);
  CHECK(document.values<std::uint32_t>("Verts", "offsets", "UInt32", 1) == std::vector<std::uint32_t>{500});
  const auto cell = document.values<std::uint32_t>("Verts", "connectivity", "UInt32", 1);
  REQUIRE(cell.size() == 500);
  for (std::uint32_t i = 0; i < 500; ++i) {
    REQUIRE(cell[i] == i);
  }
}

TEST_CASE("a surface and its arrays come back from a VTK file") {
  const ScratchFolder folder;
  const auto file = folder / "bucket.vtp";
  const std::vector<Vector> vertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}};
  const std::vector<std::array<std::uint32_t, 3>> facets{{0, 1, 2}, {0, 2, 3}};
  const std::vector<double> heights{0, 0, 0, 0.5};
  const std::vector<Vector> forces{{1, 2, 3}, {-4, 5, -6}};
  const std::array<VtkArray, 1> over_vertices{{{"height", heights}}};
  const std::array<VtkArray, 1> over_facets{{{"force", forces}}};
  write_vtp_surface(file, vertices, facets, over_vertices, over_facets);

  const Document document{file};
  CHECK(document.count("NumberOfPoints") == 4);
  CHECK(document.count("NumberOfVerts") == 0);
  CHECK(document.count("NumberOfPolys") == 2);
  CHECK(document.values<float>("Points", "Points", "Float32", 3) == flattened(vertices));
  CHECK(document.values<std::uint32_t>("Polys", "connectivity", "UInt32", 1) ==
        std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
  CHECK(document.values<std::uint32_t>("Polys", "offsets", "UInt32", 1) == std::vector<std::uint32_t>{3, 6});
  CHECK(document.values<float>("PointData", "height", "Float32", 1) == std::vector<float>{0, 0, 0, 0.5});
  CHECK(document.values<float>("CellData", "force", "Float32", 3) == flattened(forces));
}

TEST_CASE("a VTK file of nothing, and one of numbers beyond Float32, are whole") {
  const ScratchFolder folder;
  const auto file = folder / "x.vtp";
  write_vtp_points(file, {}, {});
  const Document empty{file};
  CHECK(empty.count("NumberOfPoints") == 0);
  CHECK(empty.count("NumberOfVerts") == 0);
  CHECK(empty.values<float>("Points", "Points", "Float32", 3).empty());

  const std::vector<Vector> point{{1e300, -1e300, 1e-300}};
  write_vtp_points(file, point, {});
  const auto most = std::numeric_limits<float>::max();
  CHECK(Document{file}.values<float>("Points", "Points", "Float32", 3) == std::vector<float>{most, -most, 0});
}

TEST_CASE("a VTK file refuses arrays and facets that do not fit") {
  const ScratchFolder folder;
  const auto file = folder / "x.vtp";
  const std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}};
  const std::vector<double> two{1, 2};
  const std::vector<double> three{1, 2, 3};
  const auto refused = [&](std::vector<VtkArray> arrays, const std::string& what) {
    CHECK_THROWS_WITH_AS(write_vtp_points(file, points, arrays), (file.string() + ": " + what).c_str(),
                         Error);
  };
  refused({{"radius", three}}, "array radius has 3 entries, not 2");
  refused({{"radius", two}, {"radius", two}}, "\"radius\" is no name of its own for an array");
  refused({{"", two}}, "\"\" is no name of its own for an array");
  const std::vector<std::array<std::uint32_t, 3>> facets{{0, 1, 1}, {0, 1, 2}};
  CHECK_THROWS_WITH_AS(write_vtp_surface(file, points, facets),
                       (file.string() + ": facet 1 names vertex 2 of 2").c_str(), Error);
  CHECK_FALSE(std::filesystem::exists(file));
  const auto nowhere = folder / "missing" / "x.vtp";
  CHECK_THROWS_WITH_AS(write_vtp_points(nowhere, points, {}),
                       (nowhere.string() + ": cannot be written").c_str(), Error);
}

TEST_CASE("a time series is whole after every frame") {
  const ScratchFolder folder;
  const auto file = folder / "drag.pvd";
  PvdSeries series{file};
  const auto entries = [&] {
    std::vector<std::string> found;
    const auto tree = parsed(content_of(file));
    CHECK(tree.get<std::string>("VTKFile.<xmlattr>.type") == "Collection");
    for (const auto& child : tree.get_child("VTKFile.Collection")) {
      if (child.first == "DataSet") {
        found.push_back(child.second.get<std::string>("<xmlattr>.timestep") + " " +
                        child.second.get<std::string>("<xmlattr>.part") + " " +
                        child.second.get<std::string>("<xmlattr>.file"));
      }
    }
    return found;
  };
  CHECK(entries().empty());
  series.add(0.0, folder / "frames" / "grains_0.vtp");
  CHECK(entries() == std::vector<std::string>{"0 0 frames/grains_0.vtp"});
  series.add(0.1, folder / "frames" / "grains_1.vtp");
  series.add(0.1, folder / "frames" / "bucket & co.vtp", 1);
  CHECK(entries() == std::vector<std::string>{"0 0 frames/grains_0.vtp", "0.1 0 frames/grains_1.vtp",
                                              "0.1 1 frames/bucket & co.vtp"});
  CHECK_FALSE(std::filesystem::exists(file.string() + ".part"));
  CHECK_THROWS_WITH_AS(series.add(std::numeric_limits<double>::quiet_NaN(), folder / "x.vtp"),
                       (file.string() + ": time = nan s is not a finite number").c_str(), Error);
  CHECK(entries().size() == 3);
}

#pragma once
/// \file
/// Points and triangle surfaces for ParaView: VTK XML PolyData (.vtp) with raw appended data, and a time
/// series
/// (.pvd) of them.
///
/// Format: "VTK XML formats", VTK File Formats, Kitware; header type UInt64, byte order of this machine.
/// Floating-point arrays are stored as Float32, which is enough for the eye; checkpoints keep full precision.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/io/number_text.hpp"
#include "scree/io/xml_text.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace scree {

/// A named array over the points or facets of a VTK file: scalars, vectors or ids.
struct VtkArray {
  std::string name;
  std::variant<std::span<const double>, std::span<const Vector>, std::span<const std::uint32_t>> values;
};

namespace detail {

/// Collects the two parts of a .vtp file: the XML that describes its arrays, and their bytes.
class VtpDocument {
public:
  explicit VtpDocument(std::filesystem::path file) : file_{std::move(file)} {}

  void text(std::string_view xml) { xml_ += xml; }

  void array(std::string_view name, std::span<const double> values) {
    begin_array("Float32", name, 1, values.size() * sizeof(float));
    for (const double value : values) {
      put(as_float(value));
    }
  }
  void array(std::string_view name, std::span<const Vector> values) {
    begin_array("Float32", name, 3, 3 * values.size() * sizeof(float));
    for (const auto& value : values) {
      put(as_float(value.x()));
      put(as_float(value.y()));
      put(as_float(value.z()));
    }
  }
  void array(std::string_view name, std::span<const std::uint32_t> values) {
    begin_array("UInt32", name, 1, values.size() * sizeof(std::uint32_t));
    for (const auto value : values) {
      put(value);
    }
  }

  /// The arrays given by the user, all of `size` entries, within the element `element`.
  void data(std::string_view element, std::span<const VtkArray> arrays, std::size_t size) {
    text(message("<", element, ">\n"));
    for (auto entry = arrays.begin(); entry != arrays.end(); ++entry) {
      const auto given = std::visit([](const auto& values) { return values.size(); }, entry->values);
      if (given != size) {
        throw Error(message(file_.string(), ": array ", entry->name, " has ", given, " entries, not ", size));
      }
      const auto same_name = [&](const VtkArray& other) { return other.name == entry->name; };
      if (entry->name.empty() || std::find_if(arrays.begin(), entry, same_name) != entry) {
        throw Error(message(file_.string(), ": \"", entry->name, "\" is no name of its own for an array"));
      }
      std::visit([&](const auto& values) { array(entry->name, values); }, entry->values);
    }
    text(message("</", element, ">\n"));
  }

  void write() const {
    constexpr bool little = std::endian::native == std::endian::little;
    std::string content = message("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
                                  "byte_order=\"",
                                  little ? "LittleEndian" : "BigEndian", "\" header_type=\"UInt64\">\n");
    content.append(xml_).append("<AppendedData encoding=\"raw\">\n_").append(bytes_);
    content.append("\n</AppendedData>\n</VTKFile>\n");
    write_atomically(file_, content);
  }

private:
  static float as_float(double value) {
    constexpr double most = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -most, most)); // a NaN stays one
  }

  void begin_array(std::string_view type, std::string_view name, int components, std::uint64_t size) {
    xml_ +=
        message(R"(<DataArray type=")", type, R"(" Name=")", xml_escaped(name), R"(" NumberOfComponents=")",
                components, R"(" format="appended" offset=")", bytes_.size(), "\"/>\n");
    bytes_.reserve(bytes_.size() + sizeof size + size);
    put(size);
  }

  template <class T>
  void put(T value) {
    std::array<char, sizeof value> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    bytes_.append(bytes.data(), bytes.size());
  }

  std::filesystem::path file_;
  std::string xml_;
  std::string bytes_;
};

inline std::uint32_t vtk_size(const std::filesystem::path& file, std::size_t size) {
  if (size > std::numeric_limits<std::uint32_t>::max() / 3) {
    throw Error(message(file.string(), ": ", size, " points or facets are more than the file can index"));
  }
  return static_cast<std::uint32_t>(size);
}

} // namespace detail

/// Writes `points` with their arrays. ParaView draws them as spheres with the representation "Point Gaussian"
/// or the filter "Glyph" (sphere, scaled by an array such as "radius").
/// \throws Error naming the file, for an array of another length or name taken twice too.
inline void write_vtp_points(const std::filesystem::path& file, std::span<const Vector> points,
                             std::span<const VtkArray> arrays) {
  const auto count = detail::vtk_size(file, points.size());
  std::vector<std::uint32_t> connectivity(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    connectivity[i] = i;
  }
  // One cell of all points: ParaView shows no point that is in no cell.
  const std::vector<std::uint32_t> offsets(count == 0 ? 0 : 1, count);
  detail::VtpDocument document{file};
  document.text(message("<PolyData>\n<Piece NumberOfPoints=\"", count, "\" NumberOfVerts=\"", offsets.size(),
                        "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n"));
  document.array("Points", points);
  document.text("</Points>\n<Verts>\n");
  document.array("connectivity", std::span<const std::uint32_t>{connectivity});
  document.array("offsets", std::span<const std::uint32_t>{offsets});
  document.text("</Verts>\n");
  document.data("PointData", arrays, points.size());
  document.text("</Piece>\n</PolyData>\n");
  document.write();
}

/// Writes triangles over shared vertices with arrays over vertices and over facets.
/// \throws Error naming the file, for a facet that names no vertex and an array of another length too.
inline void write_vtp_surface(const std::filesystem::path& file, std::span<const Vector> vertices,
                              std::span<const std::array<std::uint32_t, 3>> facets,
                              std::span<const VtkArray> vertex_arrays = {},
                              std::span<const VtkArray> facet_arrays = {}) {
  const auto count = detail::vtk_size(file, facets.size());
  std::vector<std::uint32_t> connectivity;
  std::vector<std::uint32_t> offsets;
  connectivity.reserve(3 * facets.size());
  offsets.reserve(facets.size());
  for (const auto& facet : facets) {
    for (const auto vertex : facet) {
      if (vertex >= vertices.size()) {
        throw Error(message(file.string(), ": facet ", offsets.size(), " names vertex ", vertex, " of ",
                            vertices.size()));
      }
      connectivity.push_back(vertex);
    }
    offsets.push_back(static_cast<std::uint32_t>(connectivity.size()));
  }
  detail::VtpDocument document{file};
  document.text(message("<PolyData>\n<Piece NumberOfPoints=\"", detail::vtk_size(file, vertices.size()),
                        R"(" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys=")", count,
                        "\">\n<Points>\n"));
  document.array("Points", vertices);
  document.text("</Points>\n<Polys>\n");
  document.array("connectivity", std::span<const std::uint32_t>{connectivity});
  document.array("offsets", std::span<const std::uint32_t>{offsets});
  document.text("</Polys>\n");
  document.data("PointData", vertex_arrays, vertices.size());
  document.data("CellData", facet_arrays, facets.size());
  document.text("</Piece>\n</PolyData>\n");
  document.write();
}

/// A ParaView time series: a .pvd file that lists other files with their times. It is replaced in one step
/// after every addition, so that it can be opened at any moment of a run.
class PvdSeries {
public:
  /// Writes an empty series.
  /// \throws Error naming the file if it cannot be written.
  explicit PvdSeries(std::filesystem::path file) : file_{std::move(file)} { write(); }

  /// Adds `data`, written before, at `time` (s, finite). Files of one time have distinct parts (0: grains, 1:
  /// bucket, ...). The series names its files relative to its own folder.
  /// \throws Error naming the series if it cannot be written or the time is not finite.
  void add(double time, const std::filesystem::path& data, int part = 0) {
    if (!std::isfinite(time)) {
      throw Error(message(file_.string(), ": time = ", time, " s is not a finite number"));
    }
    const auto folder = std::filesystem::absolute(file_).parent_path();
    const auto relative = std::filesystem::absolute(data).lexically_relative(folder).generic_string();
    entries_ += message("<DataSet timestep=\"", number_text(time), "\" part=\"", part, "\" file=\"",
                        xml_escaped(relative), "\"/>\n");
    write();
  }

  /// Its list, to go on with after it was read into another series of the same file.
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.entries_);
    if constexpr (Archive::reading) {
      self.write();
    }
  }

private:
  void write() const {
    write_atomically(
        file_, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n" +
                   entries_ + "</Collection>\n</VTKFile>\n");
  }

  std::filesystem::path file_;
  std::string entries_;
};

} // namespace scree

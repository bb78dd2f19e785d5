#pragma once
/// \file
/// STL files in binary form: little-endian, coordinates as float.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"
#include "scree/geometry/triangle_mesh.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/io/stl_facets.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <ios>
#include <limits>
#include <streambuf>
#include <string>

namespace scree {

namespace detail {

constexpr std::size_t stl_header_size = 84; // 80 bytes of comment, 4 of the facet count
constexpr std::size_t stl_record_size = 50; // normal and three corners as 12 floats, 2 bytes of attribute

inline std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) {
    value = (value << 8) | static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

inline void append_little_endian(std::string& out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) {
    out.push_back(static_cast<char>((value >> (8 * i)) & 0xffU));
  }
}

inline TriangleMesh read_stl_binary(std::streambuf& input, std::uintmax_t size,
                                    const std::filesystem::path& file, const StlOptions& options) {
  std::array<char, stl_header_size> header{};
  if (input.sgetn(header.data(), stl_header_size) != static_cast<std::streamsize>(stl_header_size)) {
    throw file_error(file, 1,
                     message("neither text (it does not begin with \"solid\") nor binary STL: ", size,
                             " bytes hold no header before facet 1"));
  }
  const std::size_t count = little_endian(header.data() + 80);
  const std::uintmax_t whole = stl_header_size + std::uintmax_t{stl_record_size} * count;
  // What the header claims is believed only once the size of the file agrees.
  if (size < whole) {
    const auto facet = static_cast<std::size_t>((size - stl_header_size) / stl_record_size) + 1;
    throw file_error(file, facet,
                     message("facet ", facet, " is cut off: the file has ", size, " bytes, and ", whole,
                             " are due if its header means ", count,
                             " facets (it is read as binary, as it is not text that begins with \"solid\")"));
  }
  if (size > whole) {
    throw file_error(
        file, count,
        message("facet ", count, " is the last one by the header, but ", size - whole, " more bytes follow"));
  }
  if (count == 0) {
    throw file_error(file, 1, "facet 1 is missing: the file holds none");
  }
  if (count > options.max_facets) {
    throw file_error(file, options.max_facets + 1,
                     message("facet ", options.max_facets + 1, " of ", count, " is one more than allowed"));
  }
  StlSoup soup(options);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<char, stl_record_size> record{};
    if (input.sgetn(record.data(), stl_record_size) != static_cast<std::streamsize>(stl_record_size)) {
      throw file_error(file, i + 1, message("facet ", i + 1, " cannot be read"));
    }
    for (std::size_t k = 1; k <= 3; ++k) { // 0 is the normal, which the corners give
      Vector corner;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto bits = little_endian(record.data() + 4 * (3 * k + axis));
        corner[static_cast<Eigen::Index>(axis)] = static_cast<double>(std::bit_cast<float>(bits));
      }
      if (!soup.add(corner)) {
        throw file_error(file, i + 1, message("facet ", i + 1, " has a coordinate that is not finite"));
      }
    }
  }
  return soup.welded();
}

/// The nearest float. GCC 12 forgets to round where it converts two numbers at once to float and back; it
/// cannot where the float is stored.
inline double rounded_to_float(double number) {
  const volatile auto stored = static_cast<float>(number);
  return static_cast<double>(stored);
}

} // namespace detail

/// Writes a binary STL file, in m. Coordinates are rounded to float, to about 7 digits.
/// \throws Error if a coordinate or the number of facets does not fit the format, or the file cannot be
/// written.
inline void write_stl_binary(const std::filesystem::path& file, const TriangleMesh& mesh) {
  detail::require_writable_stl(mesh, file, std::numeric_limits<float>::max());
  if (mesh.facets.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(
        message(file.string(), ": ", mesh.facets.size(), " facets are more than an STL file can count"));
  }
  std::string out = "binary STL, coordinates in m";
  out.resize(80, ' ');
  detail::append_little_endian(out, static_cast<std::uint32_t>(mesh.facets.size()));
  const auto add = [&out](const Vector& v) {
    for (const double coordinate : v) {
      detail::append_little_endian(out, std::bit_cast<std::uint32_t>(static_cast<float>(coordinate)));
    }
  };
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    auto corners = mesh.corners(i);
    for (auto& corner : corners) {
      corner = corner.unaryExpr(&detail::rounded_to_float);
    }
    // The normal of what is written, so that a file that is read and written again stays the same.
    add(detail::stl_normal(corners));
    for (const auto& corner : corners) {
      add(corner);
    }
    out.append(2, '\0');
  }
  write_atomically(file, out);
}

} // namespace scree

#pragma once
/// \file
/// Triangle meshes in STL files, text and binary: read_stl, write_stl_text, write_stl_binary.

#include "scree/core/error.hpp"
#include "scree/geometry/triangle_mesh.hpp"
#include "scree/io/stl_binary.hpp"
#include "scree/io/stl_facets.hpp"
#include "scree/io/stl_text.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>
#include <string>
#include <string_view>
#include <system_error>

namespace scree {

/// Reads a text or binary STL file, whichever it is, and welds its vertices. Facet i of the mesh is facet i
/// of the file; colours and names are ignored. Check the mesh with check() (geometry/mesh_topology.hpp).
/// \throws Error for an option out of range, and for a file that cannot be read or is empty, cut off or
/// longer than its end, over options.max_facets, or holds a word or a coordinate that does not belong. The
/// message begins with the file and the line (text) or the facet, counted from 1 (binary).
inline TriangleMesh read_stl(const std::filesystem::path& file, const StlOptions& options = {}) {
  require_positive("scale", options.scale, "m per unit");
  require("max_facets", static_cast<double>(options.max_facets), {1.0, 1e9});
  std::error_code failure;
  const auto size = std::filesystem::file_size(file, failure);
  std::ifstream in(file, std::ios::binary);
  if (failure || !in) {
    throw Error(message(file.string(), ": cannot be read", failure ? ": " + failure.message() : ""));
  }
  if (size == 0) {
    throw file_error(file, 1, "the file is empty, without a facet");
  }
  std::array<char, 512> buffer{};
  const auto got = in.rdbuf()->sgetn(buffer.data(), static_cast<std::streamsize>(buffer.size()));
  const std::string_view beginning(buffer.data(), static_cast<std::size_t>(got));
  // A text file cannot match this by chance: four characters read as a count stand for over 10^8 facets.
  const bool whole_binary = beginning.size() >= detail::stl_header_size &&
                            size == detail::stl_header_size + std::uintmax_t{detail::stl_record_size} *
                                                                  detail::little_endian(buffer.data() + 80);
  in.seekg(0);
  if (!whole_binary && detail::looks_like_stl_text(beginning)) {
    return detail::read_stl_text(*in.rdbuf(), file, options);
  }
  return detail::read_stl_binary(*in.rdbuf(), size, file, options);
}

} // namespace scree

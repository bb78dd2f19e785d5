#pragma once
/// \file
/// STL files in the form of text.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"
#include "scree/geometry/triangle_mesh.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/io/number_text.hpp"
#include "scree/io/stl_facets.hpp"
#include "scree/io/stl_words.hpp"

#include <cstddef>
#include <filesystem>
#include <limits>
#include <streambuf>
#include <string>
#include <string_view>

namespace scree {

namespace detail {

/// Whether a file that is not a whole binary one is meant as text. A binary file may begin with "solid" too,
/// but its header or its first numbers hold bytes that no text has.
inline bool looks_like_stl_text(std::string_view beginning) {
  const auto first = beginning.find_first_not_of(" \t\r\n\v\f");
  if (first == std::string_view::npos || beginning.size() < first + 5 ||
      !StlWords::same(beginning.substr(first, 5), "solid")) {
    return false;
  }
  for (const char c : beginning) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' && !(byte >= '\t' && byte <= '\r')) {
      return false;
    }
  }
  return true;
}

inline TriangleMesh read_stl_text(std::streambuf& input, const std::filesystem::path& file,
                                  const StlOptions& options) {
  StlWords words(input, file);
  StlSoup soup(options);
  const auto number = [&words](std::string_view what) {
    const auto word = words.required(what);
    const auto value = parse_number(word);
    if (!value) {
      throw words.error(message("\"", word, "\" where ", what, " is expected"));
    }
    return *value;
  };
  words.expect("solid");
  words.finish_line(); // the solid's name
  while (true) {
    const auto word = words.required(R"("facet" or "endsolid")");
    if (StlWords::same(word, "endsolid")) {
      words.finish_line();
      // Some programs write one solid after another.
      const auto more = words.next();
      if (!more) {
        break;
      }
      if (!StlWords::same(*more, "solid")) {
        throw words.error(message("\"", *more, "\" after the end of the solid"));
      }
      words.finish_line();
      continue;
    }
    if (!StlWords::same(word, "facet")) {
      throw words.error(message("\"", word, R"(" where "facet" or "endsolid" is expected)"));
    }
    if (soup.facet_count() == options.max_facets) {
      throw words.error(message("more than the ", options.max_facets, " facets allowed"));
    }
    words.expect("normal");
    for (int i = 0; i < 3; ++i) {
      // The corners give the normal. What is written here is often zero, or NaN for a facet without area.
      words.required("a component of the normal");
    }
    words.expect("outer");
    words.expect("loop");
    for (int i = 0; i < 3; ++i) {
      words.expect("vertex");
      const double x = number("a finite coordinate");
      const double y = number("a finite coordinate");
      const double z = number("a finite coordinate");
      if (!soup.add({x, y, z})) {
        throw words.error("a coordinate is not finite once it is scaled");
      }
    }
    words.expect("endloop");
    words.expect("endfacet");
  }
  if (soup.facet_count() == 0) {
    throw words.error("the file holds no facets");
  }
  return soup.welded();
}

} // namespace detail

/// Writes a text STL file, in m. Coordinates are in the shortest form that reads back to the same double.
/// \param name of the solid, of printable characters.
/// \throws Error if the name or a coordinate cannot be written, or the file cannot.
inline void write_stl_text(const std::filesystem::path& file, const TriangleMesh& mesh,
                           std::string_view name = "scree") {
  detail::require_writable_stl(mesh, file, std::numeric_limits<double>::max());
  for (const char c : name) {
    if (c < ' ' || c > '~') {
      throw Error(message(file.string(), ": the name of a solid must be of printable ASCII characters"));
    }
  }
  const auto vector = [](const Vector& v) {
    return number_text(v.x()) + " " + number_text(v.y()) + " " + number_text(v.z()) + "\n";
  };
  std::string out = message("solid ", name, "\n");
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const auto corners = mesh.corners(i);
    out += "  facet normal " + vector(detail::stl_normal(corners)) + "    outer loop\n";
    for (const auto& corner : corners) {
      out += "      vertex " + vector(corner);
    }
    out += "    endloop\n  endfacet\n";
  }
  out += message("endsolid ", name, "\n");
  write_atomically(file, out);
}

} // namespace scree

#pragma once
/// \file
/// Triangle meshes in STL files, text and binary.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"
#include "scree/geometry/mesh_weld.hpp"
#include "scree/geometry/triangle_mesh.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/io/number_text.hpp"

#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>
#include <limits>
#include <optional>
#include <streambuf>
#include <string>
#include <string_view>
#include <system_error>

namespace scree {

/// How an STL file is read.
struct StlOptions {
  double scale = 1.0;                 ///< m per unit of the file, above 0; STL files hold no unit
  double weld_tolerance = 0.0;        ///< m, see weld(); 0 welds equal coordinates
  std::size_t max_facets = 5'000'000; ///< a file with more is refused before it fills the memory
};

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

/// Adds a corner read from a file, and with every third one a facet.
class StlSoup {
public:
  explicit StlSoup(const StlOptions& options) : options_{options} {}

  /// Whether the corner is finite; one that is not is left out.
  [[nodiscard]] bool add(const Vector& corner) {
    const Vector scaled = options_.scale * corner;
    if (!scaled.allFinite()) {
      return false;
    }
    soup_.vertices.push_back(scaled);
    if (soup_.vertices.size() % 3 == 0) {
      const auto next = static_cast<std::uint32_t>(soup_.vertices.size());
      soup_.facets.push_back({next - 3, next - 2, next - 1});
    }
    return true;
  }
  [[nodiscard]] std::size_t facet_count() const { return soup_.facets.size(); }
  [[nodiscard]] TriangleMesh welded() const { return weld(soup_, options_.weld_tolerance); }

private:
  const StlOptions& options_;
  TriangleMesh soup_;
};

/// Splits a text file into words and knows the line of each. Never holds more than one word.
class StlWords {
public:
  StlWords(std::streambuf& input, const std::filesystem::path& file) : input_{input}, file_{file} {}

  /// The next word, or nothing at the end of the file.
  std::optional<std::string> next() {
    int c = input_.sgetc();
    while (is_space(c)) {
      skip();
      c = input_.sgetc();
    }
    if (c == end) {
      return std::nullopt;
    }
    std::string word;
    while (c != end && !is_space(c)) {
      if (word.size() == longest_word) {
        throw error(message("a word of more than ", longest_word, " characters"));
      }
      word.push_back(static_cast<char>(c));
      c = input_.snextc();
    }
    return word;
  }
  /// The next word; the file may not end here.
  std::string required(std::string_view what) {
    auto word = next();
    if (!word) {
      throw error(message("the file ends where ", what, " is expected"));
    }
    return *word;
  }
  void expect(std::string_view keyword) {
    const auto word = required(message("\"", keyword, "\""));
    if (!same(word, keyword)) {
      throw error(message("\"", printable(word), "\" where \"", keyword, "\" is expected"));
    }
  }
  /// Skips to the end of the line.
  void finish_line() {
    for (int c = input_.sgetc(); c != end && c != '\n'; c = input_.snextc()) {
    }
  }
  [[nodiscard]] Error error(std::string_view what) const { return file_error(file_, line_, what); }

  /// Keywords are lower case by the letter of the format, but some programs write them in capitals.
  static bool same(std::string_view word, std::string_view keyword) {
    if (word.size() != keyword.size()) {
      return false;
    }
    for (std::size_t i = 0; i < word.size(); ++i) {
      if (std::tolower(static_cast<unsigned char>(word[i])) != keyword[i]) {
        return false;
      }
    }
    return true;
  }
  /// The word with everything but printable ASCII shown as '?'.
  static std::string printable(std::string word) {
    for (char& c : word) {
      c = c > ' ' && c <= '~' ? c : '?';
    }
    return word;
  }

private:
  static constexpr int end = std::streambuf::traits_type::eof();
  static constexpr std::size_t longest_word = 100;

  static bool is_space(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  void skip() { line_ += input_.sbumpc() == '\n' ? 1 : 0; }

  std::streambuf& input_;
  const std::filesystem::path& file_;
  std::size_t line_ = 1;
};

inline TriangleMesh read_stl_text(std::streambuf& input, const std::filesystem::path& file,
                                  const StlOptions& options) {
  StlWords words(input, file);
  StlSoup soup(options);
  const auto number = [&words](std::string_view what) {
    const auto word = words.required(what);
    const auto value = parse_number(word);
    if (!value) {
      throw words.error(message("\"", StlWords::printable(word), "\" where ", what, " is expected"));
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
        throw words.error(message("\"", StlWords::printable(*more), "\" after the end of the solid"));
      }
      words.finish_line();
      continue;
    }
    if (!StlWords::same(word, "facet")) {
      throw words.error(
          message("\"", StlWords::printable(word), R"(" where "facet" or "endsolid" is expected)"));
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

/// Throws for a mesh that no STL file can hold.
inline void require_writable_stl(const TriangleMesh& mesh, const std::filesystem::path& file,
                                 double largest) {
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    for (const auto v : mesh.facets[i]) {
      if (v >= mesh.vertices.size()) {
        throw file_error(file, i + 1,
                         message("facet ", i + 1, " names vertex ", v, " of ", mesh.vertices.size()));
      }
      if (!(mesh.vertices[v].cwiseAbs().maxCoeff() <= largest) || !mesh.vertices[v].allFinite()) {
        throw file_error(file, i + 1,
                         message("facet ", i + 1, " has a coordinate that the file cannot hold"));
      }
    }
  }
}

/// Unit normal by the right hand rule; zero for a facet without area.
inline Vector stl_normal(const std::array<Vector, 3>& corners) {
  const Vector n = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
  return n.allFinite() ? n : Vector{0.0, 0.0, 0.0};
}

} // namespace detail

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
      corner = corner.cast<float>().cast<double>();
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

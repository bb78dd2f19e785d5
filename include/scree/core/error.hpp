#pragma once
/// \file
/// One error type for bad input: a sentence that names the place or the parameter, its value and its range.

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace scree {

/// Thrown for every input that scree refuses. The message is meant for the person who gave the input.
class Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Thrown where a simulation has gone wrong on the way: its state is worth a look.
class Trouble : public Error {
public:
  using Error::Error;
};

/// Joins its arguments into a message, numbers with up to 10 significant digits.
template <class... Parts>
std::string message(const Parts&... parts) {
  std::ostringstream out;
  out.precision(10);
  (out << ... << parts);
  return out.str();
}

/// Text of which nothing is known as a message can show it: in one line, everything but printable ASCII as
/// '?', no longer than `most`.
inline std::string printable(std::string_view text, std::size_t most = 1000) {
  std::string out{text.substr(0, most)};
  for (char& c : out) {
    c = c >= ' ' && c <= '~' ? c : '?';
  }
  return out + (text.size() > most ? "..." : "");
}

/// An error in a file, with the line or record where it was found ("bed.stl:12: ..."), in one line whatever
/// `what` quotes of the file.
[[nodiscard]] inline Error file_error(const std::filesystem::path& file, std::size_t line,
                                      std::string_view what) {
  return Error(message(file.string(), ":", line, ": ", printable(what)));
}

/// A closed interval that a parameter must lie in, with its unit for messages.
struct Range {
  double least;
  double most;
  std::string_view unit = "";
};

/// Returns `value` if it is a number within `range`.
/// \throws Error naming the parameter, its value and the range.
inline double require(std::string_view parameter, double value, const Range& range) {
  if (!(value >= range.least && value <= range.most)) {
    const auto unit = range.unit.empty() ? std::string{} : message(" ", range.unit);
    throw Error(
        message(parameter, " = ", value, unit, " is outside [", range.least, ", ", range.most, "]", unit));
  }
  return value;
}

/// Returns `value` if it is finite and above zero.
/// \throws Error naming the parameter and its value.
inline double require_positive(std::string_view parameter, double value, std::string_view unit = "") {
  if (!(value > 0.0 && std::isfinite(value))) {
    throw Error(
        message(parameter, " = ", value, unit.empty() ? "" : " ", unit, " must be a finite number above 0"));
  }
  return value;
}

} // namespace scree

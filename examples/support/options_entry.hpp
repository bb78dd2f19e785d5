#pragma once
/// \file
/// One parameter of a program: the variable that it sets, what it may hold, and its value as text.

#include "scree/core/error.hpp"
#include "scree/io/number_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <variant>
#include <vector>

namespace scree::examples {

/// Where the default of a parameter is from.
enum class Provenance { paper, ours };

namespace detail {

inline std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string out;
  for (const std::string& part : parts) {
    out += (out.empty() ? "" : between) + part;
  }
  return out;
}

inline std::vector<std::string> texts(const std::vector<double>& numbers, std::string (*text)(double)) {
  std::vector<std::string> out(numbers.size());
  std::transform(numbers.begin(), numbers.end(), out.begin(), text);
  return out;
}

/// A parameter and the variable that it is bound to. The `set_` functions check what they are given and throw
/// an Error that begins with `where` and names the parameter, the value and what is wanted.
struct OptionsEntry {
  std::string name, group, doc;
  Provenance from;
  Range range;
  std::vector<std::string> choices;
  std::variant<double*, std::uint64_t*, bool*, std::string*, std::vector<double>*> value;
  bool repeatable = false; ///< a text that may be given several times, which a comma then joins
  std::size_t fewest = 0;  ///< numbers in a list of any length; 0: as many as it has by default

  /// What the help shows for the value.
  [[nodiscard]] std::string kind() const {
    switch (value.index()) {
    case 0:
      return range.unit.empty() ? "NUMBER" : message("NUMBER ", range.unit);
    case 1:
      return "INTEGER";
    case 2:
      return "true|false";
    case 4:
      return message("NUMBERS", range.unit.empty() ? "" : " ", range.unit);
    default:
      return choices.empty() ? "TEXT" : joined(choices, "|");
    }
  }

  /// The value, in the form that `set_text` reads.
  [[nodiscard]] std::string text() const {
    if (const auto* number = std::get_if<double*>(&value)) {
      return number_text(**number);
    }
    if (const auto* integer = std::get_if<std::uint64_t*>(&value)) {
      return std::to_string(**integer);
    }
    if (const auto* flag = std::get_if<bool*>(&value)) {
      return **flag ? "true" : "false";
    }
    if (const auto* list = std::get_if<std::vector<double>*>(&value)) {
      return joined(texts(**list, number_text), ",");
    }
    return *std::get<std::string*>(value);
  }

  /// What the help says: purpose, default and range.
  [[nodiscard]] std::string described() const {
    std::string out = message(doc, " [", text().empty() ? "none" : text());
    if (value.index() < 2 || value.index() == 4) {
      out += std::abs(range.most) >= 1e15 ? message("; ", range.least, " or more")
                                          : message("; ", range.least, " to ", range.most);
    }
    return out + (from == Provenance::paper ? "; paper]" : "; ours]");
  }

  [[noreturn]] void refuse(const std::string& where, const std::string& given,
                           const std::string& wanted) const {
    throw Error(message(where, name, " = ", given, " is not ", wanted));
  }

  void set_text(const std::string& given, const std::string& where) {
    if (value.index() == 0) {
      const auto number = parse_number(given);
      if (!number) {
        refuse(where, given, "a finite number");
      }
      set_number(*number, where);
    } else if (value.index() == 1) {
      std::int64_t integer = 0; // signed, as in TOML, so that every value can be read back
      const char* const end = given.data() + given.size();
      if (const auto [rest, error] = std::from_chars(given.data(), end, integer);
          error != std::errc{} || rest != end || integer < 0) {
        refuse(where, given, "a whole number, 0 or above");
      }
      set_integer(static_cast<std::uint64_t>(integer), where);
    } else if (auto* const* flag = std::get_if<bool*>(&value)) {
      if (given != "true" && given != "false") {
        refuse(where, given, "true or false");
      }
      **flag = given == "true";
    } else if (value.index() == 4) {
      std::vector<double> numbers;
      for (std::size_t begin = 0; begin <= given.size();) {
        const std::size_t comma = std::min(given.find(',', begin), given.size());
        const auto number = parse_number(std::string_view{given}.substr(begin, comma - begin));
        if (!number) {
          refuse(where, given, "a list of numbers with commas between them");
        }
        numbers.push_back(*number);
        begin = comma + 1;
      }
      set_list(numbers, where);
    } else {
      set_string(given, where);
    }
  }

  void set_number(double number, const std::string& where) {
    if (!std::isfinite(number)) {
      refuse(where, message(number), "a finite number");
    }
    *std::get<double*>(value) = require(where + name, number, range);
  }
  void set_integer(std::uint64_t integer, const std::string& where) {
    require(where + name, static_cast<double>(integer), range);
    *std::get<std::uint64_t*>(value) = integer;
  }
  void set_list(const std::vector<double>& numbers, const std::string& where) {
    auto& list = *std::get<std::vector<double>*>(value);
    if (fewest == 0 ? numbers.size() != list.size() : numbers.size() < fewest) {
      throw Error(message(where, name, ": ", numbers.size(), " numbers, but it takes ",
                          fewest == 0 ? message(list.size()) : message(fewest, " or more")));
    }
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      require(message(where, name, "[", k, "]"), numbers[k], range);
    }
    list = numbers;
  }
  void set_string(const std::string& given, const std::string& where) {
    if (!choices.empty() && std::find(choices.begin(), choices.end(), given) == choices.end()) {
      refuse(where, '"' + given + '"', "one of " + joined(choices, ", "));
    }
    if (!is_utf8(given)) { // neither TOML nor JSON could keep it
      refuse(where, given, "UTF-8 text");
    }
    *std::get<std::string*>(value) = given;
  }
  static bool is_utf8(const std::string& text) {
    try {
      (void)nlohmann::json(text).dump();
      return true;
    } catch (const nlohmann::json::type_error&) {
      return false;
    }
  }
};

} // namespace detail

} // namespace scree::examples

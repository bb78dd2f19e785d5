#pragma once
/// \file
/// The parameters of a program in a TOML file: reading them from one, and the text of one that holds them.

#include "scree/core/error.hpp"
#include "scree/io/number_text.hpp"
#include "scree/io/read_text.hpp"
#include "support/options_entry.hpp"
#include "support/options_hint.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace scree::examples::detail {

/// The table of a whole file. \throws Error with the file, and where it can the line.
inline toml::table parsed_toml(const std::string& file) {
  if (!std::filesystem::is_regular_file(file)) {
    throw Error(message(file, ": cannot be read: no such file"));
  }
  const std::string text = read_text(file, std::size_t{1} << 20U);
  try {
    toml::table table = toml::parse(text, file);
    if (table.empty()) {
      throw file_error(file, 1, "the file holds no parameter");
    }
    // A number that is cut off is still a number.
    if (text.back() != '\n') {
      const auto line = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
      throw file_error(file, line, "the file is cut off, or its last line lacks a line break");
    }
    return table;
  } catch (const toml::parse_error& error) {
    throw file_error(file, error.source().begin.line, error.description());
  }
}

/// A TOML number. node::value<double>() gives nothing for an integer that no double holds.
inline double toml_number_of(const toml::node& node) {
  const auto* const integer = node.as_integer();
  return integer != nullptr ? static_cast<double>(integer->get()) : node.as_floating_point()->get();
}

/// A node as a message shows it: in one line.
inline std::string toml_text_of(const toml::node& node) {
  if (node.is_table()) {
    return "a table";
  }
  std::ostringstream shown;
  node.visit([&](const auto& n) { shown << n; });
  return printable(shown.str());
}

/// Gives a parameter the value of a node. \throws Error that begins with `where` for one of another kind or
/// range.
inline void set_from_toml(OptionsEntry& e, const toml::node& node, const std::string& where) {
  if (e.value.index() == 0 && node.is_number()) {
    e.set_number(toml_number_of(node), where);
  } else if (e.value.index() == 1 && node.is_integer() && *node.value<std::int64_t>() >= 0) {
    e.set_integer(static_cast<std::uint64_t>(*node.value<std::int64_t>()), where);
  } else if (e.value.index() == 2 && node.is_boolean()) {
    *std::get<bool*>(e.value) = *node.value<bool>();
  } else if (e.value.index() == 3 && node.is_string()) {
    e.set_string(*node.value<std::string>(), where);
  } else if (const toml::array* array = node.as_array(); e.value.index() == 4 && array != nullptr) {
    std::vector<double> numbers;
    for (const toml::node& item : *array) {
      if (!item.is_number()) {
        e.refuse(where, toml_text_of(node), "a list of numbers");
      }
      numbers.push_back(toml_number_of(item));
    }
    e.set_list(numbers, where);
  } else {
    static constexpr const char* wanted[] = {"a number", "a whole number, 0 or above", "true or false",
                                             "a text", "a list of numbers"};
    e.refuse(where, toml_text_of(node), wanted[e.value.index()]);
  }
}

/// Gives the parameters what a table holds; `prefix` is the path of the table itself, with a dot at its end.
/// \param others keys of the table that are for somebody else
/// \throws Error with file and line for an unknown name and for a value that its parameter cannot take.
inline void read_toml(std::vector<OptionsEntry>& entries, const toml::table& table, const std::string& prefix,
                      const std::string& file, const std::set<std::string_view>& others = {}) {
  for (const auto& [key, node] : table) {
    if (others.contains(key.str())) {
      continue;
    }
    const std::string name = prefix + std::string{key.str()};
    const auto line = node.source().begin.line;
    const std::string inside = name + ".";
    const bool group = std::any_of(entries.begin(), entries.end(), [&](const OptionsEntry& e) {
      return e.name.substr(0, inside.size()) == inside;
    });
    if (const toml::table* nested = node.as_table(); nested != nullptr && group) {
      read_toml(entries, *nested, inside, file);
      continue;
    }
    const auto entry =
        std::find_if(entries.begin(), entries.end(), [&](const OptionsEntry& e) { return e.name == name; });
    if (entry == entries.end()) {
      throw file_error(file, line,
                       message("there is no parameter '", name, "'", spelling_hint(name, entries)));
    }
    set_from_toml(*entry, node, message(file, ":", line, ": "));
  }
}

/// The table that a parameter stands in; empty for the top of the file.
inline std::string toml_table(const OptionsEntry& e) {
  const auto dot = e.name.rfind('.');
  return dot == std::string::npos ? "" : e.name.substr(0, dot);
}

/// A TOML float, never an integer: that would lose the sign of -0.
inline std::string toml_number(double number) {
  const std::string text = number_text(number);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

/// A text as it stands between the quotes of TOML.
inline std::string toml_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (const auto code = static_cast<unsigned char>(c); code < 32 || code == 127) {
      out += fmt::format("\\u{:04x}", code);
    } else {
      out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
    }
  }
  return out;
}

/// The line of a parameter: key, value and, as a comment, what it is.
inline std::string toml_line(const OptionsEntry& e) {
  const auto dot = e.name.rfind('.');
  const std::string key = dot == std::string::npos ? e.name : e.name.substr(dot + 1);
  std::string shown = e.text();
  if (e.value.index() == 3) {
    shown = '"' + toml_escaped(shown) + '"';
  } else if (const auto* number = std::get_if<double*>(&e.value)) {
    shown = toml_number(**number);
  } else if (const auto* list = std::get_if<std::vector<double>*>(&e.value)) {
    shown = "[" + joined(texts(**list, toml_number), ", ") + "]";
  }
  const std::string unit = e.range.unit.empty() ? "" : message(e.range.unit, "; ");
  return message(key, " = ", shown, "  # ", unit, e.from == Provenance::paper ? "paper; " : "ours; ", e.doc,
                 "\n");
}

/// All values as the text of a TOML file that `--config` reads back.
inline std::string toml_text(const std::vector<OptionsEntry>& entries, const std::string& program) {
  std::string top = message("# ", program, ": every parameter of this run; read back with --config.\n"),
              tables;
  std::vector<std::string> names;
  for (const OptionsEntry& e : entries) {
    if (const auto table = toml_table(e);
        !table.empty() && std::find(names.begin(), names.end(), table) == names.end()) {
      names.push_back(table);
    }
    top += toml_table(e).empty() ? toml_line(e) : "";
  }
  for (const std::string& name : names) {
    tables += "\n[" + name + "]\n";
    for (const OptionsEntry& e : entries) {
      tables += toml_table(e) == name ? toml_line(e) : "";
    }
  }
  return top + tables;
}

} // namespace scree::examples::detail

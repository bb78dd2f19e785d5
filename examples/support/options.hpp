#pragma once
/// \file
/// One table of every parameter of a program: it drives the command line, the TOML file, the range checks,
/// the help and the record of what was used.

#include "scree/core/error.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/io/number_text.hpp"
#include "scree/io/read_text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace scree::examples {

/// Where the default of a parameter is from.
enum class Provenance { paper, ours };

/// Thrown when the help was asked for: the text, and nothing went wrong.
struct HelpWanted {
  std::string text;
};

/// Parameters by name; a dot makes a table in TOML ("bed.length"). Each is bound to a variable whose value at
/// the time of `add` is the default. Later sources win: default, TOML file, command line.
class Options {
public:
  Options(std::string program, std::string brief) : program_{std::move(program)}, brief_{std::move(brief)} {}

  /// Parameters added from now on stand under this heading in the help.
  void group(std::string title) { group_ = std::move(title); }

  void add(std::string name, double& value, const Range& range, std::string doc,
           Provenance from = Provenance::ours) {
    entries_.push_back({std::move(name), group_, std::move(doc), from, range, {}, &value});
  }
  void add(std::string name, std::uint64_t& value, const Range& range, std::string doc,
           Provenance from = Provenance::ours) {
    entries_.push_back({std::move(name), group_, std::move(doc), from, range, {}, &value});
  }
  void add(std::string name, bool& value, std::string doc, Provenance from = Provenance::ours) {
    entries_.push_back({std::move(name), group_, std::move(doc), from, {}, {}, &value});
  }
  /// A list of numbers: "1,2,3" on the command line, [1, 2, 3] in TOML; of the length that it has now.
  void add(std::string name, std::vector<double>& value, const Range& range, std::string doc,
           Provenance from = Provenance::ours) {
    entries_.push_back({std::move(name), group_, std::move(doc), from, range, {}, &value});
  }
  /// A text; one of `choices` unless there are none.
  void add(std::string name, std::string& value, std::vector<std::string> choices, std::string doc,
           Provenance from = Provenance::ours) {
    entries_.push_back({std::move(name), group_, std::move(doc), from, {}, std::move(choices), &value});
  }

  /// The value that command line or TOML file give to a text parameter that decides on the defaults of
  /// others, or none. \throws Error as `parse` does for a file that cannot be read.
  static std::optional<std::string> peek(int argc, const char* const* argv, const std::string& name) {
    std::optional<std::string> found, file;
    for (int k = 1; k < argc; ++k) {
      const std::string_view word = argv[k];
      for (auto [key, target] : {std::pair{"--" + name, &found}, std::pair{std::string{"--config"}, &file}}) {
        if (word == key && k + 1 < argc) {
          *target = argv[k + 1];
        } else if (word.substr(0, key.size() + 1) == key + "=") {
          *target = std::string{word.substr(key.size() + 1)};
        }
      }
    }
    if (!found && file) {
      const toml::table table = parsed(*file);
      found = table.at_path(name).value<std::string>();
    }
    return found;
  }

  /// Reads the TOML file named by `--config` and the command line.
  /// \throws Error that names the parameter, its value and range, and for a file its line; HelpWanted for
  /// `--help`.
  void parse(int argc, const char* const* argv) {
    CLI::App app{brief_, program_};
    app.set_help_flag("-h,--help", "print this help and exit");
    std::string file;
    app.add_option("--config", file, "TOML file with any of the parameters below")->type_name("FILE.toml");
    app.allow_extras(); // refused below, in our words
    std::deque<std::string> given(entries_.size());
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      const Entry& e = entries_[k];
      app.add_option("--" + e.name, given[k], e.described())->group(e.group)->type_name(e.kind());
    }
    try {
      app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
      throw HelpWanted{app.help()};
    } catch (const CLI::ParseError& error) {
      throw Error(message("command line: ", error.what()));
    }
    if (const auto extra = app.remaining(); !extra.empty()) {
      const auto dashed = std::find_if(extra.begin(), extra.end(), [](const std::string& word) {
        return word.size() > 2 && word.substr(0, 2) == "--";
      });
      if (dashed == extra.end()) {
        throw Error(message("command line: '", extra.front(), "' belongs to no parameter"));
      }
      const std::string name = dashed->substr(2, dashed->find('=') - 2);
      throw Error(message("command line: there is no parameter '", name, "'", hint(name)));
    }
    if (!file.empty()) {
      read(file);
    }
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (app.count("--" + entries_[k].name) > 0) {
        entries_[k].set_text(given[k], "command line: --");
      }
    }
  }

  /// Writes all values as a TOML file that `--config` reads back.
  void write_toml(const std::filesystem::path& file) const {
    std::string top = message("# ", program_, ": every parameter of this run; read back with --config.\n"),
                tables;
    std::vector<std::string> names;
    for (const Entry& e : entries_) {
      if (const auto table = e.table();
          !table.empty() && std::find(names.begin(), names.end(), table) == names.end()) {
        names.push_back(table);
      }
      top += e.table().empty() ? e.toml_line() : "";
    }
    for (const std::string& name : names) {
      tables += "\n[" + name + "]\n";
      for (const Entry& e : entries_) {
        tables += e.table() == name ? e.toml_line() : "";
      }
    }
    write_atomically(file, top + tables);
  }

  /// All values by name.
  [[nodiscard]] nlohmann::ordered_json json() const {
    nlohmann::ordered_json out;
    for (const Entry& e : entries_) {
      std::visit([&](const auto* value) { out[e.name] = *value; }, e.value);
    }
    return out;
  }

  /// Names of the parameters whose defaults the paper does not give.
  [[nodiscard]] std::vector<std::string> not_in_the_paper() const {
    std::vector<std::string> names;
    for (const Entry& e : entries_) {
      if (e.from == Provenance::ours) {
        names.push_back(e.name);
      }
    }
    return names;
  }

private:
  struct Entry {
    std::string name, group, doc;
    Provenance from;
    Range range;
    std::vector<std::string> choices;
    std::variant<double*, std::uint64_t*, bool*, std::string*, std::vector<double>*> value;

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

    [[nodiscard]] std::string described() const {
      std::string out = message(doc, " [", text().empty() ? "none" : text());
      if (value.index() < 2 || value.index() == 4) {
        out += std::abs(range.most) >= 1e15 ? message("; ", range.least, " or more")
                                            : message("; ", range.least, " to ", range.most);
      }
      return out + (from == Provenance::paper ? "; paper]" : "; ours]");
    }
    [[nodiscard]] std::string table() const {
      const auto dot = name.rfind('.');
      return dot == std::string::npos ? "" : name.substr(0, dot);
    }

    [[nodiscard]] std::string toml_line() const {
      const auto dot = name.rfind('.');
      const std::string key = dot == std::string::npos ? name : name.substr(dot + 1);
      std::string shown = text();
      if (value.index() == 3) {
        shown = '"' + escaped(shown) + '"';
      } else if (const auto* number = std::get_if<double*>(&value)) {
        shown = toml_number(**number);
      } else if (const auto* list = std::get_if<std::vector<double>*>(&value)) {
        shown = "[" + joined(texts(**list, toml_number), ", ") + "]";
      }
      const std::string unit = range.unit.empty() ? "" : message(range.unit, "; ");
      return message(key, " = ", shown, "  # ", unit, from == Provenance::paper ? "paper; " : "ours; ", doc,
                     "\n");
    }

    /// A TOML float, never an integer: that would lose the sign of -0.
    static std::string toml_number(double number) {
      const std::string text = number_text(number);
      return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
    }
    static std::vector<std::string> texts(const std::vector<double>& numbers, std::string (*text)(double)) {
      std::vector<std::string> out(numbers.size());
      std::transform(numbers.begin(), numbers.end(), out.begin(), text);
      return out;
    }

    static std::string escaped(const std::string& text) {
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
      if (numbers.size() != list.size()) {
        throw Error(message(where, name, ": ", numbers.size(), " numbers, but it takes ", list.size()));
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

    void set_node(const toml::node& node, const std::string& where) {
      if (value.index() == 0 && node.is_number()) {
        set_number(number_of(node), where);
      } else if (value.index() == 1 && node.is_integer() && *node.value<std::int64_t>() >= 0) {
        set_integer(static_cast<std::uint64_t>(*node.value<std::int64_t>()), where);
      } else if (value.index() == 2 && node.is_boolean()) {
        *std::get<bool*>(value) = *node.value<bool>();
      } else if (value.index() == 3 && node.is_string()) {
        set_string(*node.value<std::string>(), where);
      } else if (const toml::array* array = node.as_array(); value.index() == 4 && array != nullptr) {
        std::vector<double> numbers;
        for (const toml::node& item : *array) {
          if (!item.is_number()) {
            refuse(where, text_of(node), "a list of numbers");
          }
          numbers.push_back(number_of(item));
        }
        set_list(numbers, where);
      } else {
        static constexpr const char* wanted[] = {"a number", "a whole number, 0 or above", "true or false",
                                                 "a text", "a list of numbers"};
        refuse(where, text_of(node), wanted[value.index()]);
      }
    }

    /// A TOML number. node::value<double>() gives nothing for an integer that no double holds.
    static double number_of(const toml::node& node) {
      const auto* const integer = node.as_integer();
      return integer != nullptr ? static_cast<double>(integer->get()) : node.as_floating_point()->get();
    }

    static std::string text_of(const toml::node& node) {
      if (node.is_table()) {
        return "a table";
      }
      std::ostringstream shown;
      node.visit([&](const auto& n) { shown << n; });
      return shown.str();
    }
  };

  static std::string joined(const std::vector<std::string>& parts, const char* between) {
    std::string out;
    for (const std::string& part : parts) {
      out += (out.empty() ? "" : between) + part;
    }
    return out;
  }

  static toml::table parsed(const std::string& file) {
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

  void read(const std::string& file) { read_table(parsed(file), "", file); }

  void read_table(const toml::table& table, const std::string& prefix, const std::string& file) {
    for (const auto& [key, node] : table) {
      const std::string name = prefix + std::string{key.str()};
      const auto line = node.source().begin.line;
      const std::string inside = name + ".";
      const bool group = std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) {
        return e.name.substr(0, inside.size()) == inside;
      });
      if (const toml::table* nested = node.as_table(); nested != nullptr && group) {
        read_table(*nested, inside, file);
        continue;
      }
      const auto entry =
          std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.name == name; });
      if (entry == entries_.end()) {
        throw file_error(file, line, message("there is no parameter '", name, "'", hint(name)));
      }
      entry->set_node(node, message(file, ":", line, ": "));
    }
  }

  /// The known name that is nearest in letters, as a hint.
  [[nodiscard]] std::string hint(const std::string& name) const {
    std::size_t least = name.size() / 3 + 2;
    std::string nearest;
    for (const Entry& e : entries_) {
      if (const std::size_t d = distance(name, e.name); d < least) {
        least = d;
        nearest = e.name;
      }
    }
    return nearest.empty() ? "" : message("; did you mean '", nearest, "'?");
  }

  /// Edit distance (Levenshtein).
  static std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) {
      row[j] = j;
    }
    for (std::size_t i = 1; i <= a.size(); ++i) {
      std::size_t diagonal = std::exchange(row[0], i);
      for (std::size_t j = 1; j <= b.size(); ++j) {
        const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1] ? 1 : 0);
        diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
      }
    }
    return row.back();
  }

  std::string program_, brief_;
  std::string group_ = "run"; // CLI11 hides what has no heading
  std::vector<Entry> entries_;
};

} // namespace scree::examples

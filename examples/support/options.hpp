#pragma once
/// \file
/// One table of every parameter of a program: it drives the command line, the TOML file, the range checks,
/// the help and the record of what was used.

#include "scree/core/error.hpp"
#include "scree/io/atomic_file.hpp"
#include "support/options_entry.hpp"
#include "support/options_hint.hpp"
#include "support/options_toml.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace scree::examples {

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
      const toml::table table = detail::parsed_toml(*file);
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
      const detail::OptionsEntry& e = entries_[k];
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
      throw Error(
          message("command line: there is no parameter '", name, "'", detail::spelling_hint(name, entries_)));
    }
    if (!file.empty()) {
      detail::read_toml(entries_, detail::parsed_toml(file), "", file);
    }
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (app.count("--" + entries_[k].name) > 0) {
        entries_[k].set_text(given[k], "command line: --");
      }
    }
  }

  /// Writes all values as a TOML file that `--config` reads back.
  void write_toml(const std::filesystem::path& file) const {
    write_atomically(file, detail::toml_text(entries_, program_));
  }

  /// All values by name.
  [[nodiscard]] nlohmann::ordered_json json() const {
    nlohmann::ordered_json out;
    for (const detail::OptionsEntry& e : entries_) {
      std::visit([&](const auto* value) { out[e.name] = *value; }, e.value);
    }
    return out;
  }

  /// Names of the parameters whose defaults the paper does not give.
  [[nodiscard]] std::vector<std::string> not_in_the_paper() const {
    std::vector<std::string> names;
    for (const detail::OptionsEntry& e : entries_) {
      if (e.from == Provenance::ours) {
        names.push_back(e.name);
      }
    }
    return names;
  }

private:
  std::string program_, brief_;
  std::string group_ = "run"; // CLI11 hides what has no heading
  std::vector<detail::OptionsEntry> entries_;
};

} // namespace scree::examples

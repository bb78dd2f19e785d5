#pragma once
/// \file
/// One table of every parameter of a program: it drives the command line, the TOML file, the range checks,
/// the help and the record of what was used.

#include "support/options_entry.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
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
  /// The same of any length, but of `fewest` numbers at least, 1 or more.
  void add_series(std::string name, std::vector<double>& value, std::size_t fewest, const Range& range,
                  std::string doc, Provenance from = Provenance::ours) {
    add(std::move(name), value, range, std::move(doc), from);
    entries_.back().fewest = fewest;
  }
  /// A text; one of `choices` unless there are none.
  void add(std::string name, std::string& value, std::vector<std::string> choices, std::string doc,
           Provenance from = Provenance::ours) {
    entries_.push_back({std::move(name), group_, std::move(doc), from, {}, std::move(choices), &value});
  }

  /// A text that may be given several times on the command line; a comma joins these.
  void add_repeatable(std::string name, std::string& value, std::string doc) {
    add(std::move(name), value, {}, std::move(doc));
    entries_.back().repeatable = true;
  }

  /// The value that command line or TOML file give to a text parameter that decides on the defaults of
  /// others, or none. \throws Error as `parse` does for a file that cannot be read.
  static std::optional<std::string> peek(int argc, const char* const* argv, const std::string& name);

  /// Reads the TOML file named by `--config` and the command line.
  /// \throws Error that names the parameter, its value and range, and for a file its line; HelpWanted for
  /// `--help`.
  void parse(int argc, const char* const* argv);

  /// Writes all values as a TOML file that `--config` reads back.
  void write_toml(const std::filesystem::path& file) const;

  /// All values by name.
  [[nodiscard]] nlohmann::ordered_json json() const;

  /// Names of the parameters whose defaults the paper does not give.
  [[nodiscard]] std::vector<std::string> not_in_the_paper() const;

  /// The parameters themselves, for those who read them from elsewhere.
  [[nodiscard]] std::vector<detail::OptionsEntry>& entries() { return entries_; }

private:
  std::string program_, brief_;
  std::string group_ = "run"; // CLI11 hides what has no heading
  std::vector<detail::OptionsEntry> entries_;
};

} // namespace scree::examples

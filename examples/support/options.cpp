#include "support/options.hpp"

#include "scree/core/error.hpp"
#include "scree/io/atomic_file.hpp"
#include "support/options_hint.hpp"
#include "support/options_toml.hpp"

#include <CLI/CLI.hpp>
#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <string_view>
#include <variant>

namespace scree::examples {

std::optional<std::string> Options::peek(int argc, const char* const* argv, const std::string& name) {
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

void Options::parse(int argc, const char* const* argv) {
  CLI::App app{brief_, program_};
  app.set_help_flag("-h,--help", "print this help and exit");
  std::string file;
  app.add_option("--config", file, "TOML file with any of the parameters below")->type_name("FILE.toml");
  app.allow_extras(); // refused below, in our words
  std::deque<std::string> given(entries_.size());
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const detail::OptionsEntry& e = entries_[k];
    CLI::Option* option = app.add_option("--" + e.name, given[k], e.described());
    option->group(e.group)->type_name(e.kind());
    if (e.value.index() == 2) {
      option->expected(0, 1); // the name alone says true
    }
    if (e.repeatable) {
      option->multi_option_policy(CLI::MultiOptionPolicy::Join)->delimiter(',');
    }
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
      const bool alone = entries_[k].value.index() == 2 && given[k].empty();
      entries_[k].set_text(alone ? "true" : given[k], "command line: --");
    }
  }
}

void Options::write_toml(const std::filesystem::path& file) const {
  write_atomically(file, detail::toml_text(entries_, program_));
}

nlohmann::ordered_json Options::json() const {
  nlohmann::ordered_json out;
  for (const detail::OptionsEntry& e : entries_) {
    std::visit([&](const auto* value) { out[e.name] = *value; }, e.value);
  }
  return out;
}

std::vector<std::string> Options::not_in_the_paper() const {
  std::vector<std::string> names;
  for (const detail::OptionsEntry& e : entries_) {
    if (e.from == Provenance::ours) {
      names.push_back(e.name);
    }
  }
  return names;
}

} // namespace scree::examples

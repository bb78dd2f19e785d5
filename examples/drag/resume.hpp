#pragma once
/// \file
/// What may be said of a drag that is gone on with.

#include "scree/core/error.hpp"
#include "scree/io/read_text.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace drag {

/// The command line of a run that was begun in `folder`, and what else may be given to go on with it: what
/// changes no result, such as the bounds that ended it.
/// \throws Error for anything else, where nothing was begun, and where all was done.
inline std::vector<const char*> command_of(const std::filesystem::path& folder, const std::string& input,
                                           int argc, char** argv) {
  std::vector<const char*> out{argv[0], "--config", input.c_str()};
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const std::string name = word.substr(0, word.find('='));
    const bool alone = name.size() == word.size();
    if (name == "--resume") {
      k += alone ? 1 : 0;
    } else if (name == "--threads" || name == "--checkpoint_interval" || name.starts_with("--watch.")) {
      out.push_back(argv[k]);
      if (alone && k + 1 < argc) {
        out.push_back(argv[++k]);
      }
    } else {
      throw scree::Error(scree::message("command line: ", word,
                                        " cannot be given with --resume, which takes all from ", input,
                                        "; only --threads, --checkpoint_interval and --watch.NAME can"));
    }
  }
  const auto summary = folder / "summary.json";
  if (std::filesystem::exists(summary) &&
      nlohmann::json::parse(scree::read_text(summary, std::size_t{1} << 24U)).value("finished", false)) {
    throw scree::Error(scree::message("--resume ", folder.string(), ": this drag has come to its end"));
  }
  if (!std::filesystem::exists(input)) {
    throw scree::Error(
        scree::message("--resume ", folder.string(), ": no drag was begun there: ", input, " is missing"));
  }
  return out;
}

} // namespace drag

#pragma once
/// \file
/// The programs that do one experiment.

#include <string>

namespace scree::examples {

/// The main() of the program of one kind of experiment; see `make_experiment`.
int experiment_program(const std::string& kind, const std::string& brief, int argc, const char* const* argv);

} // namespace scree::examples

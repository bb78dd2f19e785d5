#pragma once
/// \file
/// What is done with bytes of which nothing is known: every reader of files takes them as a file. It may
/// refuse them, with an `Error` that names the file, and do nothing else. What it accepts must make sense.

#include <string_view>

namespace scree::test {

/// Each throws what no reader should, and ends the program where sense is missing.
void read_as_stl(std::string_view bytes);
void read_as_csv(std::string_view bytes);
/// A calibration.toml, with one table of measurements beside it: a.csv.
void read_as_calibration(std::string_view bytes);
/// A checkpoint file; and, where its checksum would keep the bytes out, as what one holds of a simulation.
void read_as_checkpoint(std::string_view bytes);

} // namespace scree::test

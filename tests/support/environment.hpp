#pragma once
/// \file
/// Where the tests find the source tree and the reference data.

#include <filesystem>
#include <optional>
#include <string_view>

namespace scree::test {

/// The top folder of scree's sources.
std::filesystem::path source_directory();

/// The folder of the reference data (measured or published); empty where SCREE_REFERENCE_DIR is not given.
std::filesystem::path reference_directory();

/// A file of the reference data (measured or published), or nothing where SCREE_REFERENCE_DIR is not given;
/// the test case is then counted as skipped and should return.
///
///     const auto file = scree::test::reference_file("impact/points.csv");
///     if (!file) return;
///
/// \throws scree::Error if the folder is given but lacks the file.
std::optional<std::filesystem::path> reference_file(const std::filesystem::path& name);

/// Counts the running test case as skipped, unless it fails, and says why.
void skip(std::string_view reason);

/// Whether any test case of this run was skipped.
bool has_skipped();

} // namespace scree::test

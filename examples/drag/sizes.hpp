#pragma once
/// \file
/// The table of the grains' sizes.

#include "scree/io/csv.hpp"
#include "scree/packing/assembly.hpp"
#include "scree/packing/size_histogram.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace drag {

/// Requested and generated shares of every sieve class, a pair of columns for each shape.
inline void write_sizes(const std::filesystem::path& file, const scree::Assembly& assembly,
                        const std::vector<scree::DrawnClump>& drawn) {
  const auto histograms = scree::size_histograms(assembly, drawn);
  std::vector<std::string> columns{"above_m", "below_m"};
  std::string comment =
      "Shares within each shape, on the basis of its sieve curve; sizes of the material, before the size "
      "factor.\nShare of the shapes by number, requested and generated:";
  for (const scree::SizeHistogram& h : histograms) {
    columns.push_back(h.shape + "_requested");
    columns.push_back(h.shape + "_generated");
    comment += scree::message(" ", h.shape, " ", h.target_fraction, " ", h.generated_fraction, ";");
  }
  scree::CsvWriter table{file, columns, comment};
  for (std::size_t k = 0; k + 1 < histograms.front().openings.size(); ++k) {
    std::vector<double> row{histograms.front().openings[k], histograms.front().openings[k + 1]};
    for (const scree::SizeHistogram& h : histograms) {
      row.push_back(h.target[k]);
      row.push_back(h.generated[k]);
    }
    table.row(row);
  }
}

} // namespace drag

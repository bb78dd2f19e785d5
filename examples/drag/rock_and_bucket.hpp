#pragma once
/// \file
/// The bucket that the parameters describe, and the table of the grains' sizes.

#include "parameters.hpp"

#include "scree/geometry/interior_from_hull.hpp"
#include "scree/geometry/mesh_topology.hpp"
#include "scree/io/csv.hpp"
#include "scree/io/stl.hpp"
#include "scree/laboratory/drag_setup.hpp"
#include "scree/packing/assembly.hpp"
#include "scree/packing/size_histogram.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace drag {

/// The bucket, and words on what was assumed of it.
inline scree::BucketBody bucket(const Parameters& p, std::vector<std::string>& remarks) {
  scree::BucketBody out;
  const auto vector = [](const std::vector<double>& v) { return scree::Vector{v[0], v[1], v[2]}; };
  if (p.bucket_stl.empty()) {
    const auto level =
        p.detail == "detailed" ? scree::BucketDetail::detailed : scree::BucketDetail::simplified;
    out.surface = scree::make_dragline_bucket(p.bucket, level);
    out.interior = scree::bucket_interior(p.bucket);
    out.hitches = scree::hitch_points(p.bucket);
    out.body = scree::estimated_from_plates(p.bucket);
  } else {
    const scree::StlOptions reading{.scale = p.stl_scale, .weld_tolerance = p.stl_weld};
    out.surface = scree::without_collapsed_facets(scree::read_stl(p.bucket_stl, reading));
    const auto report = scree::check(out.surface);
    if (!report.clean()) {
      remarks.push_back(p.bucket_stl + ": " + report.summary());
    }
    out.interior = p.interior_stl.empty() ? scree::interior_from_hull(out.surface)
                                          : scree::read_stl(p.interior_stl, reading);
    out.hitches = {vector(p.hitch_left), vector(p.hitch_right)};
    out.body = scree::plate_properties(out.surface, 0.5 * p.bucket.plate_thickness, 7850.0);
    if (p.interior_stl.empty()) {
      remarks.push_back("interior of the bucket: hull of its side view between the cheeks");
    }
  }
  if (!scree::check(out.interior).closed()) {
    throw scree::Error("bucket interior: the mesh is not closed, so nothing can be inside it");
  }
  if (p.mass > 0.0) {
    out.body = {p.mass, vector(p.centre), vector(p.inertia).asDiagonal()};
  } else {
    remarks.push_back(scree::message("mass of the bucket estimated from its plates: ", out.body.mass, " kg"));
  }
  return out;
}

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

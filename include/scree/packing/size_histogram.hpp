#pragma once
/// \file
/// Requested against generated distribution of shapes and sizes.

#include "scree/packing/assembly.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace scree {

/// One shape of an assembly as requested (target) and as drawn (generated).
struct SizeHistogram {
  std::string shape;
  double target_fraction = 0.0;    ///< of the number of grains
  double generated_fraction = 0.0; ///< of the number of grains

  SieveBasis basis = SieveBasis::number; ///< of the class fractions below, that of the shape's sieve curve
  std::vector<double> openings;          ///< m, n + 1 sieves, in the material, that is before any size factor
  std::vector<double> target;    ///< fraction of this shape in each of the n classes between the sieves
  std::vector<double> generated; ///< likewise of what was drawn; all zero if the shape was not drawn
};

/// One histogram for each shape of the assembly.
inline std::vector<SizeHistogram> size_histograms(const Assembly& assembly,
                                                  std::span<const DrawnClump> drawn) {
  std::vector<SizeHistogram> histograms;
  for (const ShapeFraction& s : assembly.shapes()) {
    SizeHistogram h;
    h.shape = s.shape.name;
    h.target_fraction = s.fraction;
    h.basis = s.sizes.basis();
    h.openings = s.sizes.openings();
    for (std::size_t i = 1; i < h.openings.size(); ++i) {
      h.target.push_back(s.sizes.fractions()[i] - s.sizes.fractions()[i - 1]);
    }
    h.generated.assign(h.target.size(), 0.0);
    histograms.push_back(std::move(h));
  }
  for (const DrawnClump& d : drawn) {
    SizeHistogram& h = histograms[d.shape];
    const double size = assembly.material_size(d);
    h.generated_fraction += 1.0 / static_cast<double>(drawn.size());
    h.generated[assembly.shapes()[d.shape].sizes.class_of(size)] +=
        h.basis == SieveBasis::mass ? std::pow(size, 3) : 1.0;
  }
  for (SizeHistogram& h : histograms) {
    double sum = 0.0;
    for (const double g : h.generated) {
      sum += g;
    }
    for (double& g : h.generated) {
      g = sum > 0.0 ? g / sum : 0.0;
    }
  }
  return histograms;
}

} // namespace scree

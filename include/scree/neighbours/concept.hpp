#pragma once
/// \file
/// What a neighbour search must offer.
///
///     // m, by which a list may outlive its making: 0 to search in every step.
///     double skin(double smallest_radius) const;
///     // For each i below `owned`, every k > i with a gap of at most `margin` [m] between the surfaces of i
///     // and k.
///     void find(std::span<const Ball> balls, std::size_t owned, double margin, Workers& workers,
///               CandidateRows& rows);
///
/// Balls from `owned` on are periodic images. The order within a row is free: it is sorted afterwards, so
/// that every search gives the same trajectory to the bit.
///
/// Given by the library: AllPairs, CellGrid, RTree, and VerletList over any of them.

#include "scree/core/compressed_rows.hpp"
#include "scree/core/vec3.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace scree {

/// What a search sees of a sphere.
struct Ball {
  Vec3<double> centre; ///< m
  double radius;       ///< m
};

/// The candidate partners of each owned ball.
using CandidateRows = CompressedRows<std::uint32_t>;

/// Whether the gap between two balls is at most `margin`.
inline bool within(const Ball& a, const Ball& b, double margin) {
  const double reach = a.radius + b.radius + margin;
  return squared_norm(a.centre - b.centre) <= reach * reach;
}

template <class S>
concept StatesSkin = requires(const S& search, double radius) {
  { search.skin(radius) } -> std::convertible_to<double>;
};

template <class S>
concept FindsCandidates = requires(S& search, std::span<const Ball> balls, std::size_t owned, double margin,
                                   Workers& workers, CandidateRows& rows) {
  search.find(balls, owned, margin, workers, rows);
};

template <class S>
concept NeighbourSearch = StatesSkin<S> && FindsCandidates<S>;

} // namespace scree

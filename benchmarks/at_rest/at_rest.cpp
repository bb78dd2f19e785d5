// How much of a drag is at rest?

#include "scree/laboratory/bucket_body.hpp"
#include "scree/laboratory/drag_rig.hpp"
#include "scree/laboratory/rock_sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <limits>
#include <utility>
#include <vector>

namespace {

using namespace scree;

constexpr double interval = 0.01;                                           // s, between two looks
constexpr std::array<std::size_t, 4> windows{1, 5, 20, 50};                 // looks
constexpr std::array<double, 6> limits{3e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3}; // m

/// Where bodies are, by their ids; not a number where there is none.
using Places = std::vector<Vector>;

template <class Real>
Places places_of(const Bodies<Real>& bodies) {
  Places places;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto id = static_cast<std::size_t>(bodies.id(b));
    places.resize(std::max(places.size(), id + 1),
                  Vector::Constant(std::numeric_limits<double>::quiet_NaN()));
    places[id] = bodies.position(b);
  }
  return places;
}

/// Bodies that moved by less than a limit within a window, over all of the drag.
class Tally {
public:
  void add(Places places) {
    looks_.push_back(std::move(places));
    for (std::size_t w = 0; w < windows.size(); ++w) {
      if (looks_.size() > windows[w] && (looks_.size() - 1) % windows[w] == 0) {
        compare(w, looks_[looks_.size() - 1 - windows[w]], looks_.back());
      }
    }
  }

  void print() const {
    std::printf("%-12s", "window, s");
    for (const double limit : limits) {
      std::printf("%8.0f um", limit * 1e6);
    }
    for (std::size_t w = 0; w < windows.size(); ++w) {
      std::printf("\n%-12g", static_cast<double>(windows[w]) * interval);
      for (const std::size_t count : still_[w]) {
        std::printf("%11.2f", static_cast<double>(count) / static_cast<double>(seen_[w]));
      }
    }
    std::printf("\n");
  }

private:
  void compare(std::size_t w, const Places& then, const Places& now) {
    for (std::size_t id = 0; id < std::min(then.size(), now.size()); ++id) {
      const double moved = (now[id] - then[id]).norm();
      if (std::isnan(moved)) {
        continue;
      }
      ++seen_[w];
      for (std::size_t l = 0; l < limits.size(); ++l) {
        still_[w][l] += moved < limits[l] ? 1 : 0;
      }
    }
  }

  std::vector<Places> looks_;
  std::array<std::size_t, windows.size()> seen_{};
  std::array<std::array<std::size_t, limits.size()>, windows.size()> still_{};
};

void drag_at(double speed, double distance) {
  DragSetup setup = desk_drag();
  setup.drag_speed = speed;
  setup.drag_distance = distance;
  DragRig<DefaultModel> rig{setup, bucket_body()};
  const auto ignore = [](const auto&...) {};
  rig.make_bed(desk_rock().assembly, ignore);
  rig.place_bucket(ignore);
  Tally tally;
  while (!rig.done()) {
    rig.advance(interval, ignore);
    tally.add(places_of(rig.simulation().bodies()));
  }
  std::printf("\nRopes at %g m/s over %g m: share of the grains that move by less than\n", speed, distance);
  tally.print();
}

} // namespace

int main() {
  try {
    drag_at(0.75, 1.0);
    drag_at(0.15, 0.3);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "at_rest: %s\n", error.what());
    return 1;
  }
}

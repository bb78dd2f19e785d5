#pragma once
/// \file
/// Stress that the contacts carry, compression positive: through a plane, and the mean over a box.
///
/// A contact carries its force along the straight line from the centre of one body to that of the other, or
/// to the point where it touches a wall (Love 1927; Weber, Cah. Groupe Franc. Rheol. 2:161, 1966). What
/// moving grains carry by their momentum is not counted.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"

#include <algorithm>
#include <cmath>

namespace scree {

/// A contact as the line that carries its force.
struct ForceLine {
  Vector from;  ///< m, centre of a body
  Vector to;    ///< m, centre of the other, or the point where the first touches a wall
  Vector force; ///< N, on the body at `from`
};

/// Calls `visit(const ForceLine&)` for every contact of a simulation. Over a periodic boundary the line goes
/// to the image of the other body that is touched, so a body must be smaller than half of a period.
template <class Simulation, class Visit>
void visit_force_lines(const Simulation& simulation, Visit visit) {
  const auto& bodies = simulation.bodies();
  const Vector period = simulation.setup().period;
  simulation.visit_contacts([&](const auto& contact) {
    ForceLine line{bodies.position(contact.first), contact.point, contact.force};
    if (!contact.with_wall) {
      line.to = bodies.position(contact.second);
      for (int d = 0; d < 3; ++d) {
        if (period[d] > 0.0) {
          line.to[d] += period[d] * std::round((contact.point[d] - line.to[d]) / period[d]);
        }
      }
    }
    visit(line);
  });
}

/// N, that what lies below the plane x[axis] = `at` [m] exerts through contacts on what lies above it, where
/// a body lies where its centre is. In a periodic direction the plane is met once in each period.
///
/// At rest this bears the weight above, whatever the contacts: no mean over a volume is taken.
/// \throws Error for an axis other than 0, 1 and 2.
template <class Simulation>
Vector force_through_plane(const Simulation& simulation, int axis, double at) {
  if (axis < 0 || axis > 2) {
    throw Error(message("force through a plane: axis = ", axis, " is none of 0, 1 and 2"));
  }
  const double period = simulation.setup().period[axis];
  const auto side = [&](const Vector& place) {
    const double height = place[axis] - at;
    return period > 0.0 ? std::floor(height / period) : height >= 0.0 ? 0.0 : -1.0;
  };
  Vector sum = Vector::Zero();
  visit_force_lines(simulation, [&](const ForceLine& line) {
    sum += (side(line.from) - side(line.to)) * line.force; // planes that the line crosses upwards
  });
  return sum;
}

namespace detail {

/// Share of the line from `a` to `b` [m] that is within the box; its upper faces do not belong to it.
inline double share_inside(const Eigen::AlignedBox3d& box, const Vector& a, const Vector& b) {
  double begin = 0.0, end = 1.0;
  for (int d = 0; d < 3; ++d) {
    const double low = box.min()[d], high = box.max()[d], way = b[d] - a[d];
    if (way == 0.0) {
      if (a[d] < low || a[d] >= high) {
        return 0.0;
      }
      continue;
    }
    const double first = (low - a[d]) / way, second = (high - a[d]) / way;
    begin = std::max(begin, std::min(first, second));
    end = std::min(end, std::max(first, second));
  }
  return std::max(0.0, end - begin);
}

} // namespace detail

/// Pa, mean over `box` [m], which in periodic directions lies within the first period. Element (i, j) is the
/// traction along i on a face whose normal is j. Of a line that leaves the box, what lies within counts; so
/// the mean over a layer is that of the forces through its planes.
/// \throws Error for a box that is empty or beyond the first period.
template <class Simulation>
Matrix mean_stress(const Simulation& simulation, const Eigen::AlignedBox3d& box) {
  if (box.isEmpty() || !(box.volume() > 0.0)) {
    throw Error("mean stress: the box is empty");
  }
  const Vector period = simulation.setup().period;
  Vector images = Vector::Zero(); // 1 where lines repeat
  for (int d = 0; d < 3; ++d) {
    if (period[d] > 0.0) {
      const double hair = 1e-9 * period[d];
      if (box.min()[d] < -hair || box.max()[d] > period[d] + hair) {
        throw Error(message("mean stress: the box reaches from ", box.min()[d], " to ", box.max()[d],
                            " m, beyond the period from 0 to ", period[d], " m"));
      }
      images[d] = 1.0;
    }
  }
  Matrix sum = Matrix::Zero();
  visit_force_lines(simulation, [&](const ForceLine& line) {
    double share = 0.0;
    for (double x = -images.x(); x <= images.x(); ++x) {
      for (double y = -images.y(); y <= images.y(); ++y) {
        for (double z = -images.z(); z <= images.z(); ++z) {
          const Vector shift = period.cwiseProduct(Vector{x, y, z});
          share += detail::share_inside(box, line.from + shift, line.to + shift);
        }
      }
    }
    if (share > 0.0) {
      sum += share * line.force * (line.from - line.to).transpose();
    }
  });
  return sum / box.volume();
}

} // namespace scree

#include "design.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <utility>

namespace paper_gap {

std::vector<Levels> design() {
  std::vector<Levels> out;
  for (int run = 0; run < 16; ++run) {
    const auto level = [&](int bit) { return ((run >> bit) & 1) == 1 ? 1 : -1; };
    const int a = level(0), b = level(1), c = level(2), d = level(3);
    out.push_back({a, b, c, d, a * b * c, b * c * d});
  }
  return out;
}

std::vector<AliasGroup> alias_groups() {
  const std::vector<Levels> runs = design();
  std::vector<AliasGroup> out;
  for (std::size_t i = 0; i < factor_count; ++i) {
    for (std::size_t j = i + 1; j < factor_count; ++j) {
      std::vector<int> column;
      for (const Levels& levels : runs) {
        column.push_back(levels[i] * levels[j]);
      }
      const std::string name = std::string{factors[i].name} + " x " + factors[j].name;
      bool known = false;
      for (AliasGroup& group : out) {
        if (group.column == column) {
          group.name += ", " + name;
          known = true;
        }
      }
      if (!known) {
        out.push_back({std::move(column), name});
      }
    }
  }
  return out;
}

namespace {

/// Sum of squares about the means of the runs, and what is left of the number of values.
std::pair<double, double> pure_error(const std::vector<Response>& responses, std::size_t runs) {
  std::vector<double> sum(runs, 0.0), count(runs, 0.0);
  for (const Response& r : responses) {
    sum[r.run] += r.value;
    count[r.run] += 1.0;
  }
  double squares = 0.0, freedom = 0.0;
  for (const Response& r : responses) {
    const double off = r.value - sum[r.run] / count[r.run];
    squares += off * off;
  }
  for (const double n : count) {
    freedom += n > 0.0 ? n - 1.0 : 0.0;
  }
  return {squares, freedom};
}

/// The coefficients of columns, their errors over the scatter of a run, and the sum of squares that is left.
struct Fit {
  std::vector<double> value, error; ///< none where the responses do not determine them
  double squares = 0.0;
};
Fit fitted(const std::vector<Response>& responses, const std::vector<std::vector<int>>& columns) {
  const auto rows = static_cast<Eigen::Index>(responses.size());
  const auto width = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd x(rows, width);
  Eigen::VectorXd y(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Response& r = responses[static_cast<std::size_t>(i)];
    y[i] = r.value;
    for (Eigen::Index j = 0; j < width; ++j) {
      x(i, j) = columns[static_cast<std::size_t>(j)][r.run];
    }
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr{x};
  if (qr.rank() < width) {
    return {};
  }
  const Eigen::VectorXd best = qr.solve(y);
  const Eigen::MatrixXd spread = (x.transpose() * x).inverse();
  Fit out{.value = {}, .error = {}, .squares = (y - x * best).squaredNorm()};
  for (Eigen::Index j = 0; j < width; ++j) {
    out.value.push_back(best[j]);
    out.error.push_back(std::sqrt(spread(j, j)));
  }
  return out;
}

} // namespace

Analysis analysed(const std::vector<Response>& all) {
  std::vector<Response> responses;
  for (const Response& r : all) {
    if (std::isfinite(r.value)) {
      responses.push_back(r);
    }
  }
  const std::vector<Levels> runs = design();
  Analysis out;
  std::vector<std::vector<int>> columns{std::vector<int>(runs.size(), 1)};
  for (std::size_t f = 0; f < factor_count; ++f) {
    columns.emplace_back();
    for (const Levels& levels : runs) {
      columns.back().push_back(levels[f]);
    }
  }
  const Fit main = fitted(responses, columns);
  const auto [squares, freedom] = pure_error(responses, runs.size());
  out.replicated = freedom > 0.0;
  out.freedom =
      out.replicated ? freedom : static_cast<double>(responses.size()) - static_cast<double>(columns.size());
  out.scatter = out.freedom > 0.0 && !main.value.empty()
                    ? std::sqrt((out.replicated ? squares : main.squares) / out.freedom)
                    : none;
  out.mean = main.value.empty() ? none : main.value.front();
  // Columns of -1 and 1: from low to high is twice the coefficient.
  const auto effect = [&](const std::string& name, const Fit& fit, std::size_t k) {
    return Effect{name, 2.0 * fit.value[k], 2.0 * out.scatter * fit.error[k]};
  };
  for (std::size_t f = 0; f + 1 < main.value.size(); ++f) {
    out.main.push_back(effect(factors[f].name, main, f + 1));
  }
  const std::vector<AliasGroup> groups = alias_groups();
  for (const AliasGroup& group : groups) {
    columns.push_back(group.column);
  }
  const Fit every = fitted(responses, columns);
  for (std::size_t g = 0; g < groups.size() && !every.value.empty(); ++g) {
    out.interactions.push_back(effect(groups[g].name, every, 1 + factor_count + g));
  }
  return out;
}

} // namespace paper_gap

#pragma once
/// \file
/// What a validation case finds: numbers beside their references, and curves.

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace validation {

/// Where a reference value comes from.
enum class Origin { theory, experiment, code };

inline const char* name(Origin origin) {
  switch (origin) {
  case Origin::theory:
    return "theory";
  case Origin::experiment:
    return "experiment";
  default:
    return "code";
  }
}

struct Source {
  Origin origin = Origin::theory;
  std::string text; ///< equation, paper or program
};

/// How far the simulated value may be from the reference, and why that far.
struct Tolerance {
  double size = 0.0;
  bool relative = true; ///< to the reference, else in its unit
  std::string grounds;
};

/// One line of the table.
struct Finding {
  std::string case_name, quantity, unit;
  double reference = 0.0;
  Source source;
  double simulated = 0.0;
  Tolerance tolerance;
  std::string reason{}; ///< of a failure, as far as it is known

  [[nodiscard]] double error() const {
    const double difference = simulated - reference;
    return tolerance.relative ? difference / std::abs(reference) : difference;
  }
  [[nodiscard]] bool pass() const { return std::abs(error()) <= tolerance.size; }
};

/// Points joined by a line, or apart.
struct Series {
  std::string label;
  Origin origin = Origin::theory;
  std::vector<double> x, y;
};

/// Reference points over simulated lines.
struct Chart {
  std::string name; ///< of its files
  std::string title, x_label, y_label;
  std::vector<Series> references, simulated;
};

struct Outcome {
  std::vector<Finding> findings;
  std::vector<Chart> charts;
  std::vector<std::string> notes; ///< what could not be compared, and why

  /// Adds a line to the table, in the order of its fields.
  void add(const std::string& case_name, const std::string& quantity, const std::string& unit,
           double reference, const Source& source, double simulated, const Tolerance& tolerance,
           const std::string& reason = {});
  void draw(const Chart& chart);
};

/// What every case is given.
struct Inputs {
  std::filesystem::path reference; ///< folder of measured and published data; empty: none
  bool full = false;               ///< full size, where a case has a smaller one
  unsigned threads = 0;

  /// A file of the reference data, or an empty path where there is none.
  [[nodiscard]] std::filesystem::path file(const std::filesystem::path& name) const {
    return reference.empty() ? std::filesystem::path{} : reference / name;
  }
};

} // namespace validation

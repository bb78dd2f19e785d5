#include "finding.hpp"

namespace validation {

void Outcome::add(const std::string& case_name, const std::string& quantity, const std::string& unit,
                  double reference, const Source& source, double simulated, const Tolerance& tolerance,
                  const std::string& reason) {
  findings.push_back({case_name, quantity, unit, reference, source, simulated, tolerance, reason});
}

void Outcome::draw(const Chart& chart) {
  charts.push_back(chart);
}

} // namespace validation

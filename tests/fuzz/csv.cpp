#include "fuzz/attempt.hpp"
#include "fuzz/readers.hpp"

#include "scree/io/csv.hpp"

#include <cmath>

namespace scree::test {

void read_as_csv(std::string_view bytes) {
  const auto file = file_with("table.csv", bytes);
  attempt(file.string(), [&] {
    const CsvTable table = read_csv(file);
    insist(!table.columns.empty() && table.rows() > 0, "a table is empty");
    for (const auto& name : table.columns) {
      insist(table.column(name).size() == table.rows(), "a column is as long as no other");
      for (const double value : table.column(name)) {
        insist(std::isfinite(value), "a number is not finite");
      }
    }
  });
}

} // namespace scree::test

#pragma once
/// \file
/// From the times of all repeats to one row for each code.

#include "bed_file.hpp"

#include <algorithm>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace scree::benchmarks {

/// One code in one setting, and the seconds of its repeats.
struct Row {
  std::string code, version, real;
  int threads = 1;
  std::vector<double> seconds;

  [[nodiscard]] double median() const {
    std::vector<double> s = seconds;
    std::sort(s.begin(), s.end());
    return 0.5 * (s[(s.size() - 1) / 2] + s[s.size() / 2]);
  }
  [[nodiscard]] double least() const { return *std::min_element(seconds.begin(), seconds.end()); }
};

/// What every row has in common.
struct Work {
  std::size_t grains = 0, contacts = 0;
  int steps = 0;
};

/// Reads lines `code;version;real;threads;seconds`, one for each repeat; rows in the order of their first
/// line. \throws Error for a line of another form.
inline std::vector<Row> read_repeats(const std::filesystem::path& path) {
  std::ifstream in{path};
  std::vector<Row> rows;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream fields{line};
    Row row;
    std::string threads, seconds;
    if (!std::getline(fields, row.code, ';') || !std::getline(fields, row.version, ';') ||
        !std::getline(fields, row.real, ';') || !std::getline(fields, threads, ';') ||
        !std::getline(fields, seconds)) {
      throw Error(message(path.string(), ":", number, ": not 'code;version;real;threads;seconds'"));
    }
    row.threads = std::stoi(threads);
    auto at = std::find_if(rows.begin(), rows.end(), [&row](const Row& r) {
      return r.code == row.code && r.version == row.version && r.real == row.real && r.threads == row.threads;
    });
    if (at == rows.end()) {
      at = rows.insert(rows.end(), row);
    }
    at->seconds.push_back(std::stod(seconds));
  }
  return rows;
}

/// The row that `row` is measured against: the first of LAMMPS on as many threads, or null.
inline const Row* reference_of(const Row& row, const std::vector<Row>& rows) {
  const auto at = std::find_if(rows.begin(), rows.end(), [&row](const Row& r) {
    return r.code.rfind("LAMMPS", 0) == 0 && r.threads == row.threads;
  });
  return at == rows.end() ? nullptr : &*at;
}

/// scree in double is to be no slower than LAMMPS.
inline double goal_of(const Row& row) {
  return row.code.rfind("scree", 0) == 0 && row.real == "double" && row.threads == 1 ? 1.0 : 0.0;
}

inline void write_table(const std::vector<Row>& rows, const Work& work, const std::filesystem::path& csv,
                        std::ostream& markdown) {
  std::ofstream out = opened_for_writing(csv);
  out.precision(4);
  markdown.precision(3);
  out << "code,version,work,real,threads,grains,steps_per_s,grain_steps_per_s,ns_per_contact,ratio,goal,"
         "best_grain_steps_per_s,best_ns_per_contact,best_ratio,repeats\n";
  markdown << "| code | real | threads | million grain-steps/s, median (best) | ns a contact | x LAMMPS |\n"
              "|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    const auto grain_steps = [&](double seconds) {
      return static_cast<double>(work.grains) * work.steps / seconds;
    };
    const auto nanoseconds = [&](double seconds) {
      return 1e9 * seconds / work.steps / static_cast<double>(work.contacts);
    };
    const Row* reference = reference_of(row, rows);
    const double ratio = reference != nullptr ? reference->median() / row.median() : 0.0;
    const double best_ratio = reference != nullptr ? reference->least() / row.least() : 0.0;
    const auto or_nothing = [](double value) {
      std::ostringstream text;
      text.precision(4);
      if (value > 0.0) {
        text << value;
      }
      return text.str();
    };
    out << row.code << ',' << row.version << ",settled bed," << row.real << ',' << row.threads << ','
        << work.grains << ',' << work.steps / row.median() << ',' << grain_steps(row.median()) << ','
        << nanoseconds(row.median()) << ',' << or_nothing(ratio) << ',' << or_nothing(goal_of(row)) << ','
        << grain_steps(row.least()) << ',' << nanoseconds(row.least()) << ',' << or_nothing(best_ratio) << ','
        << row.seconds.size() << '\n';
    markdown << "| " << row.code << " | " << row.real << " | " << row.threads << " | "
             << 1e-6 * grain_steps(row.median()) << " (" << 1e-6 * grain_steps(row.least()) << ") | "
             << nanoseconds(row.median()) << " (" << nanoseconds(row.least()) << ") | " << ratio << " ("
             << best_ratio << ") |\n";
  }
  close(out, csv);
}

} // namespace scree::benchmarks

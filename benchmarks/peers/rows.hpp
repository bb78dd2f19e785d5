#pragma once
/// \file
/// From the times of all repeats to one row for each code and work.

#include "bed_file.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace scree::benchmarks {

/// One code in one setting at one work, and what its repeats took.
struct Row {
  std::string work, code, version, real;
  int threads = 1;
  double grains = 0.0, contacts = 0.0, steps = 0.0; ///< contacts: 0 where the code does not count them
  double megabytes = 0.0;
  std::vector<double> seconds;

  [[nodiscard]] double median() const {
    std::vector<double> s = seconds;
    std::sort(s.begin(), s.end());
    return 0.5 * (s[(s.size() - 1) / 2] + s[s.size() / 2]);
  }
  [[nodiscard]] double least() const { return *std::min_element(seconds.begin(), seconds.end()); }
  /// 1/s
  [[nodiscard]] double rate(double time) const { return grains * steps / time; }
  [[nodiscard]] bool is_peer() const { return code.rfind("scree", 0) != 0; }
};
using Rows = std::vector<Row>;

/// Reads lines `work;code;version;real;threads;grains;contacts;steps;megabytes;seconds`, one for each repeat;
/// rows in the order of their first line. \throws Error for a line of another form.
inline Rows read_repeats(const std::filesystem::path& path) {
  std::ifstream in{path};
  Rows rows;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream fields{line};
    const auto wrong = [&] {
      return Error(message(path.string(), ":", number,
                           ": not 'work;code;version;real;threads;grains;contacts;steps;megabytes;seconds'"));
    };
    const auto text = [&] {
      std::string out;
      if (!std::getline(fields, out, ';')) {
        throw wrong();
      }
      return out;
    };
    const auto value = [&] {
      std::istringstream of{text()};
      double out = 0.0;
      if (!(of >> out)) {
        throw wrong();
      }
      return out;
    };
    Row row;
    row.work = text();
    row.code = text();
    row.version = text();
    row.real = text();
    row.threads = static_cast<int>(value());
    row.grains = value();
    row.contacts = value();
    row.steps = value();
    row.megabytes = value();
    const double seconds = value();
    auto at = std::find_if(rows.begin(), rows.end(), [&row](const Row& r) {
      return r.work == row.work && r.code == row.code && r.version == row.version && r.real == row.real &&
             r.threads == row.threads;
    });
    if (at == rows.end()) {
      at = rows.insert(rows.end(), row);
    }
    at->seconds.push_back(seconds);
  }
  return rows;
}

/// The row of a code, or null.
inline const Row* row_of(const Rows& rows, std::string_view work, std::string_view code,
                         std::string_view real = "double", int threads = 1) {
  const auto at = std::find_if(rows.begin(), rows.end(), [&](const Row& r) {
    return r.work == work && r.code == code && r.real == real && r.threads == threads;
  });
  return at == rows.end() ? nullptr : &*at;
}

/// The fastest peer by its median at a work on so many threads, or null.
inline const Row* fastest_peer(const Rows& rows, std::string_view work, int threads) {
  const Row* best = nullptr;
  for (const Row& row : rows) {
    if (row.is_peer() && row.work == work && row.threads == threads &&
        (best == nullptr || row.median() < best->median())) {
      best = &row;
    }
  }
  return best;
}

/// By how much more grain-steps a second a row has than the fastest peer.
struct Ratio {
  double median = 0.0, best = 0.0; ///< 0 without a peer
};
inline Ratio ratio_of(const Row& row, const Rows& rows) {
  const Row* peer = fastest_peer(rows, row.work, row.threads);
  if (peer == nullptr) {
    return {};
  }
  return {row.rate(row.median()) / peer->rate(peer->median()),
          row.rate(row.least()) / peer->rate(peer->least())};
}

/// What scree is to reach at a work on one thread, as a multiple of the fastest peer; 0 for no such goal.
inline double goal_of(std::string_view work, std::string_view real) {
  const bool bed = work == "bed" || work == "bed100k";
  if (real == "float") {
    return bed ? 6.0 : 0.0;
  }
  return bed ? 4.5 : work == "flow" ? 4.0 : work == "clumps" ? 6.0 : 0.0;
}

/// At the end of a work, as scree counts them; the same for all codes. 0 where scree did not do it.
inline double contacts_at(const Rows& rows, std::string_view work) {
  const auto at = std::find_if(rows.begin(), rows.end(),
                               [&](const Row& r) { return r.work == work && r.contacts > 0.0; });
  return at == rows.end() ? 0.0 : at->contacts;
}

/// A number, or nothing for 0.
inline std::string or_nothing(double value, int digits = 4) {
  std::ostringstream text;
  text.precision(digits);
  if (value > 0.0) {
    text << value;
  }
  return text.str();
}

inline void write_rows(const Rows& rows, const std::filesystem::path& csv,
                       const std::filesystem::path& markdown) {
  std::ofstream out = opened_for_writing(csv), md = opened_for_writing(markdown);
  out.precision(4);
  md.precision(3);
  out << "code,version,work,real,threads,grains,steps_per_s,grain_steps_per_s,ns_per_contact,ratio,goal,"
         "best_grain_steps_per_s,best_ns_per_contact,best_ratio,megabytes,repeats\n";
  md << "| work | code | real | threads | million grain-steps/s, median (best) | ns a contact | x fastest "
        "peer | "
        "MB |\n|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    const double median = row.median(), best = row.least();
    const double contacts = contacts_at(rows, row.work);
    const auto nanoseconds = [&](double s) { return contacts > 0.0 ? 1e9 * s / row.steps / contacts : 0.0; };
    const Ratio ratio = ratio_of(row, rows);
    const double goal = row.is_peer() || row.threads != 1 ? 0.0 : goal_of(row.work, row.real);
    out << row.code << ',' << row.version << ',' << row.work << ',' << row.real << ',' << row.threads << ','
        << static_cast<std::size_t>(row.grains) << ',' << row.steps / median << ',' << row.rate(median) << ','
        << or_nothing(nanoseconds(median)) << ',' << or_nothing(ratio.median) << ',' << or_nothing(goal)
        << ',' << row.rate(best) << ',' << or_nothing(nanoseconds(best)) << ',' << or_nothing(ratio.best)
        << ',' << or_nothing(row.megabytes) << ',' << row.seconds.size() << '\n';
    md << "| " << row.work << " | " << row.code << " | " << row.real << " | " << row.threads << " | "
       << 1e-6 * row.rate(median) << " (" << 1e-6 * row.rate(best) << ") | "
       << or_nothing(nanoseconds(median), 3) << " | " << or_nothing(ratio.median, 3) << " | "
       << or_nothing(row.megabytes, 3) << " |\n";
  }
  close(out, csv);
  close(md, markdown);
}

/// What chart.gp draws: a line for each work and number of threads, with the rates of the fastest peer and of
/// scree.
inline void write_chart(const Rows& rows, const std::filesystem::path& path) {
  std::ofstream out = opened_for_writing(path);
  out.precision(5);
  out << "work,fastest peer,scree portable,scree native,scree native in float\n";
  std::vector<std::string> done;
  for (const Row& row : rows) {
    const std::string name = row.work + (row.threads > 1 ? ", 2 threads" : "");
    const Row* peer = fastest_peer(rows, row.work, row.threads);
    if (peer == nullptr || std::find(done.begin(), done.end(), name) != done.end()) {
      continue;
    }
    done.push_back(name);
    out << '"' << name << '"';
    for (const Row* r : {peer, row_of(rows, row.work, "scree portable", "double", row.threads),
                         row_of(rows, row.work, "scree native", "double", row.threads),
                         row_of(rows, row.work, "scree native", "float", row.threads)}) {
      out << ',' << (r != nullptr ? or_nothing(1e-6 * r->rate(r->median())) : "");
    }
    out << '\n';
  }
  close(out, path);
}

} // namespace scree::benchmarks

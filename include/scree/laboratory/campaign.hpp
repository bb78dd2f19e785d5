#pragma once
/// \file
/// Many independent runs: on all cores, each kept when it ends, none done twice.

#include "scree/core/error.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/io/number_text.hpp"
#include "scree/io/read_text.hpp"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid.hpp>
#include <boost/uuid/uuid_io.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <istream>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace scree {

/// One run of a campaign.
struct Job {
  /// Everything that decides on the outcome, as one line of text: kind of experiment, all parameters, seed,
  /// version. Jobs of the same key are the same run.
  std::string key;
  /// What to do. An Error that it throws is an outcome too; any other exception ends the campaign.
  std::function<std::vector<double>()> work;
};

struct JobOutcome {
  std::vector<double> values{}; ///< a number that is none stands for what the run does not show
  std::string failure{};        ///< why there are no values
  bool kept = false;            ///< it was there already
};

/// The processes that do a campaign together; by default only this one.
struct Crew {
  std::size_t rank = 0, size = 1;
  /// Called by all processes at once: takes a text of each, and gives all of them to each, by rank.
  std::function<std::vector<std::string>(const std::string& mine)> exchange{};
};

/// Runs jobs side by side and keeps each outcome in a file of its own, named by a hash of the key: a campaign
/// that is killed and started again repeats none. Outcomes do not depend on the number of workers.
///
/// Where several processes are given the same jobs in the same order, each does its share of those that are
/// not kept yet, and all have all outcomes in the end. Their folder must be one that all of them see.
class Campaign {
public:
  /// Told of every outcome, one at a time: how many are done, of how many, and the last one.
  using Watch = std::function<void(std::size_t done, std::size_t all, const JobOutcome& last)>;

  /// \param folder for the outcomes, made if need be; empty: nothing is kept
  /// \param workers of this process; 0: one for each processor
  /// \throws Error naming the folder if it cannot be made, or for a crew without an exchange.
  explicit Campaign(std::filesystem::path folder = {}, unsigned workers = 0, Crew crew = {})
      : folder_{std::move(folder)},
        workers_{workers > 0 ? workers : std::max(1U, std::thread::hardware_concurrency())},
        crew_{std::move(crew)} {
    if (crew_.rank >= crew_.size || (crew_.size > 1 && !crew_.exchange)) {
      throw Error(message("campaign: process ", crew_.rank, " of ", crew_.size, " cannot take part"));
    }
    if (!folder_.empty()) {
      std::error_code error;
      std::filesystem::create_directories(folder_, error);
      if (error || !std::filesystem::is_directory(folder_)) {
        throw Error(message(folder_.string(), ": cannot be made: ", error.message()));
      }
    }
  }

  /// The outcomes, in the order of the jobs.
  /// \throws Error for a key that is empty or more than one line, or a kept file that is not what it should
  /// be; what a job throws beside Error, once the jobs under way have ended.
  std::vector<JobOutcome> run(const std::vector<Job>& jobs, const Watch& watch = {}) const {
    std::vector<JobOutcome> outcomes(jobs.size());
    std::map<std::string, std::size_t> first; // of each key
    std::vector<std::size_t> open, again;
    std::size_t done = 0;
    const auto tell = [&](const JobOutcome& outcome) {
      ++done;
      if (watch) {
        watch(done, jobs.size(), outcome);
      }
    };
    for (std::size_t j = 0; j < jobs.size(); ++j) {
      check(jobs[j].key);
      if (!first.emplace(jobs[j].key, j).second) {
        again.push_back(j);
      } else if (auto known = kept(jobs[j].key)) {
        outcomes[j] = std::move(*known);
        tell(outcomes[j]);
      } else {
        open.push_back(j);
      }
    }
    if (crew_.size > 1) {
      (void)crew_.exchange(""); // all have seen what is kept before the first of them keeps more
    }
    std::vector<std::size_t> mine;
    for (std::size_t k = crew_.rank; k < open.size(); k += crew_.size) {
      mine.push_back(open[k]);
    }
    std::mutex one_at_a_time;
    do_all(mine, [&](std::size_t j) {
      JobOutcome outcome = outcome_of(jobs[j]);
      keep(jobs[j].key, outcome);
      const std::lock_guard lock{one_at_a_time};
      outcomes[j] = std::move(outcome);
      tell(outcomes[j]);
    });
    if (crew_.size > 1) {
      take_from_others(open, outcomes, tell);
    }
    for (const std::size_t j : again) {
      outcomes[j] = outcomes[first.at(jobs[j].key)];
      tell(outcomes[j]);
    }
    return outcomes;
  }

  /// The file that keeps the outcome of a job.
  [[nodiscard]] std::filesystem::path file_of(const std::string& key) const {
    boost::uuids::name_generator_sha1 hash{boost::uuids::ns::oid()};
    return folder_ / (boost::uuids::to_string(hash(key)) + ".run");
  }

private:
  static constexpr const char* first_line = "scree run, format 1";
  static constexpr const char* no_number = "none"; // of an observable that the run does not have

  static void check(const std::string& key) {
    if (key.empty() || key.find_first_of("\r\n") != std::string::npos) {
      throw Error(message("campaign: the key '", key, "' must be one line of text"));
    }
  }

  static JobOutcome outcome_of(const Job& job) {
    JobOutcome outcome;
    try {
      outcome.values = job.work();
    } catch (const Error& error) {
      outcome.failure = error.what();
      std::replace(outcome.failure.begin(), outcome.failure.end(), '\n', ' ');
    }
    return outcome;
  }

  /// Calls `work` for all numbers, on as many threads as there are workers; they take the next one each.
  template <class Work>
  void do_all(const std::vector<std::size_t>& numbers, const Work& work) const {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> stop{false};
    std::mutex failing;
    std::exception_ptr failure;
    const auto go = [&] {
      while (!stop) {
        const std::size_t n = next++;
        if (n >= numbers.size()) {
          return;
        }
        try {
          work(numbers[n]);
        } catch (...) {
          const std::lock_guard lock{failing};
          failure = failure ? failure : std::current_exception();
          stop = true;
        }
      }
    };
    std::vector<std::thread> others;
    for (std::size_t k = 1; k < std::min<std::size_t>(workers_, numbers.size()); ++k) {
      others.emplace_back(go);
    }
    go();
    for (std::thread& other : others) {
      other.join();
    }
    if (failure) {
      std::rethrow_exception(failure);
    }
  }

  /// The outcomes of the jobs that the other processes did, in the order in which these had them.
  template <class Tell>
  void take_from_others(const std::vector<std::size_t>& open, std::vector<JobOutcome>& outcomes,
                        const Tell& tell) const {
    std::string text;
    for (std::size_t k = crew_.rank; k < open.size(); k += crew_.size) {
      text += text_of(outcomes[open[k]]);
    }
    const std::vector<std::string> all = crew_.exchange(text);
    for (std::size_t rank = 0; rank < crew_.size; ++rank) {
      if (rank == crew_.rank) {
        continue;
      }
      std::istringstream lines{all.at(rank)};
      for (std::size_t k = rank; k < open.size(); k += crew_.size) {
        auto outcome = read_outcome(lines);
        if (!outcome) {
          throw Error(message("campaign: process ", rank, " sent no outcome of run ", open[k] + 1));
        }
        outcomes[open[k]] = std::move(*outcome);
        tell(outcomes[open[k]]);
      }
    }
  }

  static std::string text_of(const JobOutcome& outcome) {
    std::string text;
    if (!outcome.failure.empty()) {
      text += message("failure ", outcome.failure, "\n");
    }
    for (const double value : outcome.values) {
      text += message("value ", std::isfinite(value) ? number_text(value) : no_number, "\n");
    }
    return text + "end\n";
  }
  /// Up to the line "end", or nothing for text that is not as `text_of` writes it.
  static std::optional<JobOutcome> read_outcome(std::istream& lines) {
    JobOutcome outcome;
    std::string line;
    while (std::getline(lines, line)) {
      if (line == "end") {
        return outcome;
      }
      if (line.rfind("failure ", 0) == 0) {
        outcome.failure = line.substr(8);
      } else if (line == message("value ", no_number)) {
        outcome.values.push_back(std::numeric_limits<double>::quiet_NaN());
      } else if (const auto value = line.rfind("value ", 0) == 0
                                        ? parse_number(std::string_view{line}.substr(6))
                                        : std::nullopt) {
        outcome.values.push_back(*value);
      } else {
        return std::nullopt;
      }
    }
    return std::nullopt;
  }

  void keep(const std::string& key, const JobOutcome& outcome) const {
    if (!folder_.empty()) {
      write_atomically(file_of(key), message(first_line, "\nkey ", key, "\n", text_of(outcome)));
    }
  }

  [[nodiscard]] std::optional<JobOutcome> kept(const std::string& key) const {
    const auto file = folder_.empty() ? std::filesystem::path{} : file_of(key);
    if (folder_.empty() || !std::filesystem::exists(file)) {
      return std::nullopt;
    }
    std::istringstream lines{read_text(file, std::size_t{1} << 28U)};
    std::string line;
    const auto refuse = [&](std::size_t number, const char* why) {
      throw file_error(file, number, message(why, "; delete the file to do its run again"));
    };
    if (!std::getline(lines, line) || line != first_line) {
      refuse(1, "this is no kept run of this version");
    }
    if (!std::getline(lines, line) || line != "key " + key) {
      refuse(2, "this is kept of another run");
    }
    auto outcome = read_outcome(lines);
    if (!outcome) {
      refuse(3, "the outcome is cut off, or has a line that is neither a value nor a failure");
    }
    outcome->kept = true;
    return outcome;
  }

  std::filesystem::path folder_;
  unsigned workers_;
  Crew crew_;
};

} // namespace scree

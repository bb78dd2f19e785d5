#include "scree/laboratory/campaign.hpp"
#include "support/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <barrier>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <new>
#include <string>
#include <thread>
#include <vector>

using namespace scree;

namespace {

std::vector<Job> roots(std::size_t count, std::atomic<int>& done) {
  std::vector<Job> jobs;
  for (std::size_t k = 0; k < count; ++k) {
    jobs.push_back({message("root of ", k), [k, &done]() -> std::vector<double> {
                      ++done;
                      if (k % 5 == 4) {
                        throw Error(message(k, " is\nleft out"));
                      }
                      return {static_cast<double>(k), std::sqrt(static_cast<double>(k))};
                    }});
  }
  return jobs;
}

} // namespace

TEST_CASE("a campaign does each run once, whatever the number of workers, and keeps what failed too") {
  const test::ScratchFolder folder;
  std::atomic<int> done{0};
  const auto jobs = roots(23, done);
  const auto alone = Campaign{{}, 1}.run(jobs);
  CHECK(done == 23);
  std::size_t told = 0;
  const auto outcomes =
      Campaign{folder / "runs", 4}.run(jobs, [&](std::size_t now, std::size_t all, const JobOutcome& last) {
        CHECK(now == ++told);
        CHECK(all == 23);
        CHECK_FALSE(last.kept);
      });
  CHECK(told == 23);
  CHECK(done == 46);
  const auto again = Campaign{folder / "runs", 2}.run(jobs);
  CHECK(done == 46);
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    CHECK(outcomes[k].values == alone[k].values);
    CHECK(again[k].values == alone[k].values); // to the bit
    CHECK(again[k].kept);
    CHECK(again[k].failure == alone[k].failure);
    CHECK(again[k].failure == (k % 5 == 4 ? message(k, " is left out") : ""));
  }
}

TEST_CASE("a campaign keeps that a run does not show some of its numbers") {
  const test::ScratchFolder folder;
  const std::vector<Job> jobs{{"half", [] { return std::vector{1.5, std::nan(""), -HUGE_VAL}; }}};
  (void)Campaign{folder / "runs"}.run(jobs);
  const auto again = Campaign{folder / "runs"}.run(jobs).front();
  CHECK(again.kept);
  REQUIRE(again.values.size() == 3);
  CHECK(again.values[0] == 1.5);
  CHECK(std::isnan(again.values[1]));
  CHECK_FALSE(std::isfinite(again.values[2]));
}

TEST_CASE("a campaign that was ended goes on where it was") {
  const test::ScratchFolder folder;
  std::atomic<int> done{0};
  auto jobs = roots(10, done);
  jobs[6].work = []() -> std::vector<double> { throw std::bad_alloc{}; };
  CHECK_THROWS_AS(Campaign(folder / "runs", 1).run(jobs), std::bad_alloc);
  CHECK(done == 6);
  jobs[6] = roots(10, done)[6];
  const auto outcomes = Campaign{folder / "runs", 1}.run(jobs);
  CHECK(done == 10);
  CHECK(outcomes[6].values[1] == std::sqrt(6.0));
  CHECK(outcomes[5].kept);
  CHECK_FALSE(outcomes[7].kept);
}

TEST_CASE("processes that share a campaign each do a part, and all have all of it") {
  const test::ScratchFolder folder;
  constexpr std::size_t size = 3;
  std::atomic<int> done{0};
  const auto jobs = roots(23, done);
  const auto alone = Campaign{{}, 1}.run(jobs);
  Campaign{folder / "runs", 1}.run({jobs.begin(), jobs.begin() + 4}); // kept from before
  done = 0;
  // Threads stand for processes.
  std::vector<std::string> texts(size);
  std::barrier meet{static_cast<std::ptrdiff_t>(size)};
  std::vector<std::vector<JobOutcome>> outcomes(size);
  std::vector<std::size_t> told(size, 0);
  std::vector<std::thread> processes;
  for (std::size_t rank = 0; rank < size; ++rank) {
    processes.emplace_back([&, rank] {
      const auto exchange = [&, rank](const std::string& mine) {
        texts[rank] = mine;
        meet.arrive_and_wait();
        std::vector<std::string> all = texts;
        meet.arrive_and_wait();
        return all;
      };
      const Campaign campaign{folder / "runs", 2, {.rank = rank, .size = size, .exchange = exchange}};
      outcomes[rank] = campaign.run(jobs, [&](std::size_t, std::size_t, const JobOutcome&) { ++told[rank]; });
    });
  }
  for (std::thread& process : processes) {
    process.join();
  }
  CHECK(done == 19);
  for (std::size_t rank = 0; rank < size; ++rank) {
    CHECK(told[rank] == 23);
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      CHECK(outcomes[rank][k].values == alone[k].values);
      CHECK(outcomes[rank][k].failure == alone[k].failure);
      CHECK(outcomes[rank][k].kept == (k < 4));
    }
  }
  CHECK_THROWS_WITH_AS((Campaign{{}, 1, {.rank = 0, .size = 2}}), doctest::Contains("process 0 of 2"), Error);
}

TEST_CASE("jobs of one key are one run") {
  std::atomic<int> done{0};
  auto jobs = roots(3, done);
  jobs.push_back(jobs[2]);
  const auto outcomes = Campaign{{}, 2}.run(jobs);
  CHECK(done == 3);
  CHECK(outcomes[3].values == outcomes[2].values);
}

TEST_CASE("a campaign refuses files and keys that are not its own") {
  const test::ScratchFolder folder;
  std::atomic<int> done{0};
  const auto jobs = roots(1, done);
  const Campaign campaign{folder / "runs", 1};
  campaign.run(jobs);
  const auto file = campaign.file_of(jobs[0].key);
  const auto spoil = [&](const std::string& text) { std::ofstream{file} << text; };
  spoil("scree run, format 1\nkey root of 0\nvalue 0\n");
  CHECK_THROWS_WITH_AS(campaign.run(jobs), doctest::Contains("the outcome is cut off"), Error);
  spoil("scree run, format 1\nkey root of 1\nend\n");
  CHECK_THROWS_WITH_AS(campaign.run(jobs), doctest::Contains(":2: this is kept of another run"), Error);
  spoil("scree run, format 1\nkey root of 0\nvalue x\nend\n");
  CHECK_THROWS_WITH_AS(campaign.run(jobs),
                       doctest::Contains(":3: the outcome is cut off, or has a line that is neither"), Error);
  spoil("");
  CHECK_THROWS_WITH_AS(campaign.run(jobs), doctest::Contains("no kept run"), Error);
  CHECK_THROWS_WITH_AS(campaign.run({{"two\nlines", {}}}), doctest::Contains("one line"), Error);
  CHECK_THROWS_WITH_AS(Campaign{file}, doctest::Contains("cannot be made"), Error);
}

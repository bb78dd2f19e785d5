#pragma once
/// \file
/// A parallel loop over numbered tasks whose results do not depend on the number of threads.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace scree {

/// A fixed team of threads that waits between loops without being torn down: a time step opens two or three
/// loops of a fraction of a millisecond each. Few tasks are handed out one by one as threads become free. Of
/// many, each thread has a range first, as neighbouring tasks share memory that would otherwise go back and
/// forth between processors, and then helps with the others. So a task must not depend on which thread runs
/// it or when.
class Workers {
public:
  /// A team of `threads` (0: one for each processor), the calling thread among them.
  explicit Workers(unsigned threads = 0) {
    const unsigned count = threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
    ranges_ = std::vector<Range>(count);
    team_.reserve(count - 1);
    for (unsigned k = 1; k < count; ++k) {
      team_.emplace_back([this, k] { serve(k); });
    }
  }
  Workers(const Workers&) = delete;
  Workers(Workers&&) = delete;
  Workers& operator=(const Workers&) = delete;
  Workers& operator=(Workers&&) = delete;
  ~Workers() {
    stop_.store(true);
    wake();
    for (auto& thread : team_) {
      thread.join();
    }
  }

  [[nodiscard]] unsigned size() const { return static_cast<unsigned>(team_.size()) + 1; }

  /// Calls `task(k)` once for every k in 0 .. count - 1.
  /// \throws what a task throws: that of the smallest k, whatever the order in which they ran.
  template <class Task>
  void for_each(std::size_t count, Task&& task) {
    if (team_.empty() || count < 2) {
      for (std::size_t k = 0; k < count; ++k) {
        task(k);
      }
      return;
    }
    using Plain = std::remove_reference_t<Task>;
    context_ = const_cast<void*>(static_cast<const void*>(&task));
    call_ = [](void* context, std::size_t k) { (*static_cast<Plain*>(context))(k); };
    divide(count);
    pending_.store(team_.size());
    failure_ = nullptr;
    wake();
    work(0);
    await(pending_, [](std::size_t left) { return left == 0; });
    if (failure_) {
      std::rethrow_exception(failure_);
    }
  }

private:
  // Long enough to bridge the serial part of a step, short enough not to burn a shared processor.
  static constexpr int spins = 4000;
  // Tasks for each thread. A block of grains moves when those before it that reach into it are done: with
  // fewer, a thread would wait for most of what another one does. Ours; 5 and 24 were timed.
  static constexpr std::size_t many = 16;

  template <class T, class Done>
  static T await(const std::atomic<T>& value, Done done) {
    for (int k = 0; k < spins; ++k) {
      if (const T now = value.load(std::memory_order_acquire); done(now)) {
        return now;
      }
      pause();
    }
    T now = value.load();
    while (!done(now)) {
      value.wait(now);
      now = value.load();
    }
    return now;
  }

  static void pause() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#else
    std::this_thread::yield();
#endif
  }

  void wake() {
    generation_.fetch_add(1);
    generation_.notify_all();
  }

  void serve(std::size_t own) {
    std::uint64_t seen = 0;
    while (true) {
      seen = await(generation_, [seen](std::uint64_t now) { return now != seen; });
      if (stop_.load()) {
        return;
      }
      work(own);
      if (pending_.fetch_sub(1) == 1) {
        pending_.notify_all();
      }
    }
  }

  /// Tasks that are still to be done, in a cache line of their own.
  struct alignas(64) Range {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };

  /// All into one range, or into one for each thread.
  void divide(std::size_t count) {
    const std::size_t shares = count < many * ranges_.size() ? 1 : ranges_.size();
    for (std::size_t r = 0; r < ranges_.size(); ++r) {
      ranges_[r].next.store(std::min(r, shares) * count / shares, std::memory_order_relaxed);
      ranges_[r].end = std::min(r + 1, shares) * count / shares;
    }
  }

  void work(std::size_t own) {
    for (std::size_t r = 0; r < ranges_.size(); ++r) {
      Range& range = ranges_[(own + r) % ranges_.size()];
      for (std::size_t k = range.next.fetch_add(1); k < range.end; k = range.next.fetch_add(1)) {
        run(k);
      }
    }
  }
  void run(std::size_t k) {
    try {
      call_(context_, k);
    } catch (...) {
      const std::lock_guard lock{failure_mutex_};
      if (!failure_ || k < failed_task_) {
        failure_ = std::current_exception();
        failed_task_ = k;
      }
    }
  }

  std::vector<std::thread> team_;
  std::vector<Range> ranges_;
  std::atomic<std::uint64_t> generation_{0};
  std::atomic<std::size_t> pending_{0};
  std::atomic<bool> stop_{false};
  void* context_ = nullptr;
  void (*call_)(void*, std::size_t) = nullptr;
  std::mutex failure_mutex_;
  std::exception_ptr failure_;
  std::size_t failed_task_ = 0;
};

} // namespace scree

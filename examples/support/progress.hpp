#pragma once
/// \file
/// A line that says how far a long run has come and when it will end.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

namespace scree::examples {

/// "1:02:03" or "2:03".
inline std::string clock_text(double seconds) {
  const auto s = static_cast<long>(std::max(0.0, seconds) + 0.5);
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                   : fmt::format("{}:{:02}", s / 60, s % 60);
}

/// Redraws one line on a terminal; elsewhere prints a line now and then.
class Progress {
public:
  using Now = std::function<double()>; ///< s, of a clock that never goes back

  explicit Progress(std::FILE* out = stderr, Now now = steady_seconds)
      : out_{out}, now_{std::move(now)}, terminal_{isatty(fileno(out)) != 0}, start_{now_()} {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { close(); }

  /// Says that `share` (0 to 1) of all work is done. Prints at most twice a second on a terminal and every
  /// ten seconds elsewhere, `always` at once.
  void operator()(double share, const std::string& what, bool always = false) {
    const double time = now_();
    if (!always && time - printed_ < (terminal_ ? 0.5 : 10.0)) {
      return;
    }
    printed_ = time;
    const std::string text = line(share, what, time - start_);
    if (terminal_) {
      // Blanks wipe what a longer line left.
      std::fprintf(out_, "\r%-*s", static_cast<int>(std::max(text.size(), width_)), text.c_str());
      width_ = text.size();
      open_ = true;
    } else {
      std::fprintf(out_, "%s\n", text.c_str());
    }
    std::fflush(out_);
  }

  /// The line for a share of the work and the seconds since the start. The end is estimated from the mean
  /// rate so far, once a hundredth is done or half a minute is over.
  static std::string line(double share, const std::string& what, double elapsed) {
    const double done = std::clamp(share, 0.0, 1.0);
    const bool slow = done > 0.0 && done < 0.01 && elapsed > 30.0;
    const std::string left = (done > 0.01 || slow) && done < 1.0
                                 ? fmt::format(", about {} left", clock_text(elapsed * (1.0 - done) / done))
                                 : "";
    const std::string percent =
        slow ? fmt::format("{:.2g}", 100.0 * done) : fmt::format("{:3.0f}", 100.0 * done);
    return fmt::format("{} %  {}  {} elapsed{}", percent, what, clock_text(elapsed), left);
  }

  [[nodiscard]] double elapsed() const { return now_() - start_; }
  /// Counts the seconds that the same work took before, in a process that was stopped.
  void add_earlier(double seconds) { start_ -= seconds; }

  /// Ends the line, so that other output starts on a new one.
  void close() {
    if (open_) {
      std::fputc('\n', out_);
      open_ = false;
    }
  }

private:
  static double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  std::FILE* out_;
  Now now_;
  bool terminal_;
  double start_, printed_ = -1e300;
  std::size_t width_ = 0;
  bool open_ = false;
};

} // namespace scree::examples

#include "support/environment.hpp"
#include "support/progress.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

using namespace scree::examples;

namespace {

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

std::string content_of(std::FILE* file) {
  std::string text;
  std::rewind(file);
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) {
    text += static_cast<char>(c);
  }
  return text;
}

/// A terminal without a screen: what a program writes to `program` is kept for `shown`.
class Terminal {
public:
  Terminal() : screen_{posix_openpt(O_RDWR | O_NOCTTY)} {
    if (screen_ >= 0 && grantpt(screen_) == 0 && unlockpt(screen_) == 0) {
      program_.reset(std::fopen(ptsname(screen_), "w"));
    }
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() {
    program_.reset();
    if (screen_ >= 0) {
      close(screen_);
    }
  }

  /// Null where the system lends no terminal.
  [[nodiscard]] std::FILE* program() const { return program_.get(); }

  /// All that was written since the last call.
  [[nodiscard]] std::string shown() const {
    std::fflush(program_.get());
    std::string text;
    pollfd ready{screen_, POLLIN, 0};
    std::array<char, 4096> block;
    while (poll(&ready, 1, 100) > 0 && (ready.revents & POLLIN) != 0) {
      const auto count = read(screen_, block.data(), block.size());
      if (count <= 0) {
        break;
      }
      text.append(block.data(), static_cast<std::size_t>(count));
    }
    return text;
  }

private:
  int screen_;
  File program_;
};

} // namespace

TEST_CASE("times are read as on a clock") {
  CHECK(clock_text(0.0) == "0:00");
  CHECK(clock_text(59.4) == "0:59");
  CHECK(clock_text(59.6) == "1:00");
  CHECK(clock_text(3599.9) == "1:00:00");
  CHECK(clock_text(3723.0) == "1:02:03");
  CHECK(clock_text(-5.0) == "0:00");
}

TEST_CASE("the end is estimated from the mean rate") {
  CHECK(Progress::line(0.25, "drag 0.25 m", 60.0) == " 25 %  drag 0.25 m  1:00 elapsed, about 3:00 left");
  CHECK_MESSAGE(Progress::line(0.001, "bed", 1.0) == "  0 %  bed  0:01 elapsed", "too early to tell");
  CHECK(Progress::line(0.001, "bed", 60.0) == "0.1 %  bed  1:00 elapsed, about 16:39:00 left");
  CHECK(Progress::line(1.0, "done", 240.0) == "100 %  done  4:00 elapsed");
  CHECK(Progress::line(1.7, "done", 240.0) == "100 %  done  4:00 elapsed");
}

TEST_CASE("away from a terminal a line appears every ten seconds, and at once when wanted") {
  const File file{std::tmpfile()};
  REQUIRE(file);
  double time = 1000.0;
  {
    Progress progress{file.get(), [&time] { return time; }};
    progress(0.0, "start");
    for (int k = 1; k <= 25; ++k) {
      time = 1000.0 + k;
      progress(k / 25.0, "step " + std::to_string(k));
    }
    progress(1.0, "end", true);
    CHECK(progress.elapsed() == 25.0);
  }
  CHECK(content_of(file.get()) == "  0 %  start  0:00 elapsed\n"
                                  " 40 %  step 10  0:10 elapsed, about 0:15 left\n"
                                  " 80 %  step 20  0:20 elapsed, about 0:05 left\n"
                                  "100 %  end  0:25 elapsed\n");
}

TEST_CASE("on a terminal one line is drawn over itself, twice a second, and ended at last") {
  const Terminal terminal;
  if (terminal.program() == nullptr) {
    scree::test::skip("the system lends no pseudo terminal");
    return;
  }
  double time = 0.0;
  {
    Progress progress{terminal.program(), [&time] { return time; }};
    progress(0.0, "settling the bed");
    CHECK(terminal.shown() == "\r  0 %  settling the bed  0:00 elapsed");
    time = 0.4;
    progress(0.004, "settling the bed");
    CHECK(terminal.shown().empty());
    time = 0.6;
    progress(0.005, "drag");
    CHECK_MESSAGE(terminal.shown() == "\r  0 %  drag  0:01 elapsed            ",
                  "blanks over what was longer");
    time = 0.7;
    progress(1.0, "drag", true);
    CHECK(terminal.shown() == "\r100 %  drag  0:01 elapsed");
    progress.close();
    CHECK(terminal.shown() == "\r\n"); // as a terminal shows \n
  }
  CHECK_MESSAGE(terminal.shown().empty(), "ended once");
}

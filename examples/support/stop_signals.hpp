#pragma once
/// \file
/// Being told to stop: Ctrl-C, or SIGTERM of a batch system.

#include <csignal>

namespace scree::examples {

/// While one lives, the first SIGINT or SIGTERM is only noted, so that a run can end in good order; the
/// second ends the program at once, as ever.
class StopSignals {
public:
  StopSignals() {
    noted_ = 0;
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
  }
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  ~StopSignals() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
  }

  /// The one that came, or 0.
  [[nodiscard]] static int noted() { return noted_; }

private:
  static void note(int signal) {
    noted_ = signal;
    std::signal(signal, SIG_DFL);
  }

  static inline volatile std::sig_atomic_t noted_ = 0;
};

} // namespace scree::examples

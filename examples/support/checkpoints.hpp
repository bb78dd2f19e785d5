#pragma once
/// \file
/// The state of a long run on disk, from time to time and when it is told to stop.

#include "scree/io/checkpoint_file.hpp"
#include "support/stop_signals.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace scree::examples {

/// Thrown by a run that was told to stop and has kept its state.
struct Stopped {
  int signal;
};

/// Keeps a state (core/archive.hpp) in a file.
class Checkpoints {
public:
  /// \param kind of the state, one line
  /// \param interval s of wall time between two
  /// \param complain is told why one could not be written; the run goes on
  Checkpoints(std::filesystem::path file, std::string kind, double interval,
              std::function<void(const std::string&)> complain)
      : file_{std::move(file)},
        kind_{std::move(kind)},
        interval_{interval},
        complain_{std::move(complain)},
        last_{Clock::now()} {}

  /// To be called after every step.
  /// \throws Stopped after SIGINT or SIGTERM; Error where the state could not be kept then.
  template <class State>
  void operator()(const State& state) {
    const int signal = StopSignals::noted();
    if (signal != 0) {
      write(state);
      throw Stopped{signal};
    }
    if (std::chrono::duration<double>(Clock::now() - last_).count() >= interval_) {
      try {
        write(state);
      } catch (const Error& error) {
        complain_(error.what());
      }
      last_ = Clock::now();
    }
  }

  /// Reads the newest one into `state`; returns what is to be said of it, or none where there is none.
  /// \throws Error for one that is of something else, and where none is whole.
  template <class State>
  std::optional<std::string> read(State& state) const {
    const auto before = checkpoint_before(file_);
    if (!std::filesystem::exists(file_) && !std::filesystem::exists(before)) {
      return std::nullopt;
    }
    const Checkpoint found = read_checkpoint(file_, kind_);
    ArchiveReader reader{found.content, found.file.string()};
    reader(state);
    reader.end();
    return found.remark;
  }

  /// Keeps the state under another name, for those who look for what went wrong.
  template <class State>
  void keep_aside(const State& state, const std::filesystem::path& file) const {
    write(state, file);
  }

  /// Of a run that has come to its end.
  void remove() const {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
    std::filesystem::remove(checkpoint_before(file_), ignored);
  }

private:
  using Clock = std::chrono::steady_clock;

  template <class State>
  void write(const State& state) const {
    write(state, file_);
  }
  template <class State>
  void write(const State& state, const std::filesystem::path& file) const {
    ArchiveWriter writer;
    writer(state);
    write_checkpoint(file, kind_, writer.bytes());
  }

  std::filesystem::path file_;
  std::string kind_;
  double interval_;
  std::function<void(const std::string&)> complain_;
  Clock::time_point last_;
};

} // namespace scree::examples

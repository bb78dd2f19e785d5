#pragma once
/// \file
/// Checkpoints on disk: written as a whole or not at all, checked when read, the last two kept.
///
/// A file has a line of text that says what it is, then in bytes: the order of bytes (u32), the length of the
/// content (u64), the content (core/archive.hpp), and CRC-32 of all before it (u32).

#include "scree/core/archive.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/io/read_text.hpp"

#include <boost/crc.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace scree {

/// The content of a checkpoint and the file that it is from.
struct Checkpoint {
  std::string content;
  std::filesystem::path file;
  std::string remark; ///< why an older file was taken; empty where it was the newest
};

namespace detail {

/// Raised whenever the content of checkpoints changes its form.
inline constexpr int checkpoint_version = 1;
inline constexpr std::uint32_t byte_order = 0x01020304;

inline std::string checkpoint_head(std::string_view kind) {
  return message("scree checkpoint ", checkpoint_version, " of ", kind, "\n");
}

template <class Number>
std::string bytes_of(const Number& number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

inline std::uint32_t crc_of(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

/// Takes a number off the front of `rest`.
template <class Number>
Number taken(const std::filesystem::path& file, std::string_view& rest) {
  Number number{};
  if (rest.size() < sizeof number) {
    throw Error(message(file.string(), ": the checkpoint is cut off"));
  }
  std::memcpy(&number, rest.data(), sizeof number);
  rest.remove_prefix(sizeof number);
  return number;
}

} // namespace detail

/// Where the checkpoint before the one in `file` is kept.
inline std::filesystem::path checkpoint_before(std::filesystem::path file) {
  return file += ".before";
}

/// Writes a checkpoint; the one that was there stays as `file` plus ".before".
/// \param kind what it is of, one line, which the reader must name too
/// \throws Error naming the file if it cannot be written; what was there is then left as it was.
inline void write_checkpoint(const std::filesystem::path& file, std::string_view kind,
                             std::string_view content) {
  std::string text = detail::checkpoint_head(kind);
  text += detail::bytes_of(detail::byte_order);
  text += detail::bytes_of(static_cast<std::uint64_t>(content.size()));
  text += content;
  text += detail::bytes_of(detail::crc_of(text));
  // The new one is on disk under another name before the old one gives up its own.
  auto fresh = file;
  fresh += ".new";
  write_atomically(fresh, text, Durable::yes);
  std::error_code failure;
  if (std::filesystem::exists(file)) {
    std::filesystem::rename(file, checkpoint_before(file), failure);
  }
  if (!failure) {
    std::filesystem::rename(fresh, file, failure);
  }
  if (failure) {
    throw Error(message(file.string(), ": cannot be replaced: ", failure.message()));
  }
}

/// Reads one file.
/// \throws Error naming the file for one that is no checkpoint, of another kind or version, from a machine
/// with another order of bytes, cut off or damaged.
inline std::string read_one_checkpoint(const std::filesystem::path& file, std::string_view kind) {
  constexpr std::size_t most = std::size_t{1} << 40U;
  const std::string text = read_text(file, most);
  const auto refuse = [&](std::string_view what) { throw Error(message(file.string(), ": ", what)); };
  const std::string head = detail::checkpoint_head(kind);
  const std::string found = text.substr(0, text.substr(0, 4096).find('\n') + 1);
  if (!found.starts_with("scree checkpoint ")) {
    refuse("is no checkpoint");
  }
  if (found != head) {
    refuse(message("is a '", printable(found.substr(0, found.size() - 1), 200), "', not a '",
                   head.substr(0, head.size() - 1), "'"));
  }
  std::string_view rest = std::string_view{text}.substr(head.size());
  if (detail::taken<std::uint32_t>(file, rest) != detail::byte_order) {
    refuse("was written on a machine with another order of bytes");
  }
  const auto length = detail::taken<std::uint64_t>(file, rest);
  if (rest.size() < sizeof(std::uint32_t) || rest.size() - sizeof(std::uint32_t) != length) {
    refuse("the checkpoint is cut off");
  }
  std::string_view end = rest.substr(static_cast<std::size_t>(length));
  const std::string_view before = std::string_view{text}.substr(0, text.size() - end.size());
  if (detail::taken<std::uint32_t>(file, end) != detail::crc_of(before)) {
    refuse("the checkpoint is damaged: its checksum is another");
  }
  return std::string{rest.substr(0, static_cast<std::size_t>(length))};
}

/// Reads the newest checkpoint of `file` that is whole.
/// \throws Error with the reason of each where there is none.
inline Checkpoint read_checkpoint(const std::filesystem::path& file, std::string_view kind) {
  std::string reasons;
  for (const auto& candidate : {file, checkpoint_before(file)}) {
    try {
      return {read_one_checkpoint(candidate, kind), candidate, reasons};
    } catch (const Error& error) {
      reasons += (reasons.empty() ? "" : "; ") + std::string{error.what()};
    }
  }
  throw Error(reasons);
}

} // namespace scree

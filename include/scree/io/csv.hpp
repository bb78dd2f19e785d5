#pragma once
/// \file
/// Tables of numbers as comma separated text: one header line that names the columns, with units ("time_s"),
/// then one line per row. Lines that begin with '#' are comments.

#include "scree/core/error.hpp"
#include "scree/io/atomic_file.hpp"
#include "scree/io/number_text.hpp"
#include "scree/io/read_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace scree {

/// Writes a table as a run goes. Every row is handed to the system before `row` returns, so that a killed run
/// keeps each line that it had finished. `read_csv` accepts all that this class writes once it has a row.
class CsvWriter {
public:
  /// Creates `file`, replacing an older one, and writes the header.
  /// \param columns names with units; not empty, distinct, free of commas, quotes, line breaks and outer
  /// blanks.
  /// \param comment written above the header, each of its lines behind "# "; none if empty.
  /// \throws Error naming the file, for a bad name too.
  CsvWriter(std::filesystem::path file, std::vector<std::string> columns, std::string_view comment = "")
      : CsvWriter{std::move(file), std::move(columns), std::ios::trunc} {
    std::string head;
    for (std::size_t begin = 0; begin < comment.size();) {
      const auto end = std::min(comment.find('\n', begin), comment.size());
      head.append("# ").append(comment.substr(begin, end - begin)).append("\n");
      begin = end + 1;
    }
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      head.append(c == 0 ? "" : ",").append(columns_[c]);
    }
    put(head.append("\n"));
  }

  /// Goes on with a table that this class wrote behind its first `bytes` bytes; the rest is cut off.
  /// \param columns as the table has them
  /// \throws Error naming the file, where it has fewer bytes.
  static CsvWriter go_on(std::filesystem::path file, std::vector<std::string> columns, std::uintmax_t bytes) {
    std::error_code failure;
    const std::uintmax_t size = std::filesystem::file_size(file, failure);
    if (!failure && size < bytes) {
      throw Error(message(file.string(), ": has ", size, " bytes, fewer than the ", bytes,
                          " that were written before"));
    }
    if (!failure) {
      std::filesystem::resize_file(file, bytes, failure);
    }
    if (failure) {
      throw Error(message(file.string(), ": cannot be gone on with: ", failure.message()));
    }
    return CsvWriter{std::move(file), std::move(columns), std::ios::app};
  }

  /// Appends one row of finite numbers, one per column.
  /// \throws Error naming the file, and the column of a number that is not finite; nothing is written then.
  void row(std::span<const double> values) {
    if (values.size() != columns_.size()) {
      throw Error(message(file_.string(), ": a row of ", values.size(), " numbers for ", columns_.size(),
                          " columns"));
    }
    std::string line;
    for (std::size_t c = 0; c < values.size(); ++c) {
      if (!std::isfinite(values[c])) {
        throw Error(message(file_.string(), ": ", columns_[c], " = ", values[c], " in row ", rows_ + 1,
                            " is not a finite number"));
      }
      line.append(c == 0 ? "" : ",").append(number_text(values[c]));
    }
    put(line.append("\n"));
    ++rows_;
  }
  void row(std::initializer_list<double> values) {
    row(std::span<const double>{values.begin(), values.size()});
  }

  /// Written by this object.
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  /// Number of bytes that the file has by now, all of which are on its disk.
  /// \throws Error naming the file where they cannot be brought there.
  [[nodiscard]] std::uintmax_t bytes_on_disk() const {
    if (!bring_to_disk(file_)) {
      throw Error(message(file_.string(), ": cannot be brought to its disk"));
    }
    return std::filesystem::file_size(file_);
  }

private:
  /// \param how app or trunc
  CsvWriter(std::filesystem::path file, std::vector<std::string> columns, std::ios::openmode how)
      : file_{std::move(file)}, columns_{std::move(columns)} {
    check_columns();
    out_.open(file_, std::ios::binary | how);
    if (!out_) {
      throw Error(message(file_.string(), ": cannot be opened for writing"));
    }
  }

  void check_columns() const {
    if (columns_.empty()) {
      throw Error(message(file_.string(), ": a table needs a column"));
    }
    for (auto name = columns_.begin(); name != columns_.end(); ++name) {
      const bool blank_end = !name->empty() && (name->front() == ' ' || name->back() == ' ');
      if (name->empty() || blank_end || name->front() == '#' || parse_number(*name) ||
          name->find_first_of(",\"\r\n\t") != std::string::npos) {
        throw Error(message(file_.string(), ": \"", *name, "\" cannot name a column"));
      }
      if (std::find(columns_.begin(), name, *name) != name) {
        throw Error(message(file_.string(), ": two columns are named ", *name));
      }
    }
  }

  void put(const std::string& text) {
    out_.write(text.data(), static_cast<std::streamsize>(text.size()));
    out_.flush();
    if (!out_) {
      throw Error(message(file_.string(), ": cannot be written, is the disk full?"));
    }
  }

  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::ofstream out_;
  std::size_t rows_ = 0;
};

/// A table in memory. All columns have the same number of rows.
struct CsvTable {
  std::filesystem::path file;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> data; ///< one vector per column

  [[nodiscard]] std::size_t rows() const { return data.empty() ? 0 : data.front().size(); }

  /// The numbers of the column `name`.
  /// \throws Error naming the file and the columns that there are.
  [[nodiscard]] std::span<const double> column(std::string_view name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) {
      std::string known;
      for (const auto& column : columns) {
        known.append(known.empty() ? "" : ", ").append(column);
      }
      throw Error(message(file.string(), ": no column ", name, " among ", known));
    }
    return data[static_cast<std::size_t>(found - columns.begin())];
  }
};

/// How much `read_csv` takes before it refuses a file.
struct CsvLimits {
  std::size_t bytes = std::size_t{256} << 20U;
  std::size_t columns = 1000;
};

namespace detail {

/// A field as it is shown in a message: in quotes, one line, not too long.
inline std::string quoted(std::string_view field) {
  constexpr std::size_t most = 40;
  std::string shown{field.substr(0, most)};
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, '?');
  return '"' + shown + (field.size() > most ? "...\"" : "\"");
}

inline std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view{}
                                         : text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

inline std::vector<std::string_view> comma_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0;;) {
    const auto comma = line.find(',', begin);
    fields.push_back(trimmed(line.substr(begin, comma - begin)));
    if (comma == std::string_view::npos) {
      return fields;
    }
    begin = comma + 1;
  }
}

} // namespace detail

/// Reads a header and rows of finite numbers. Blank lines and comments are skipped; blanks around a field, CR
/// LF line ends and a UTF-8 byte order mark are accepted; quoted fields are not.
/// \throws Error "file:line: ..." for a file that is empty, has no rows, ends within a line, is larger than
/// `limits`, or has a ragged row, an empty field or one that is not a finite number.
inline CsvTable read_csv(const std::filesystem::path& file, const CsvLimits& limits = {}) {
  const std::string text = read_text(file, limits.bytes);
  std::string_view rest = text;
  if (rest.substr(0, 3) == "\xEF\xBB\xBF") {
    rest.remove_prefix(3);
  }
  CsvTable table{file, {}, {}};
  std::size_t number = 0;
  while (!rest.empty()) {
    ++number;
    const auto end = rest.find('\n');
    if (end == std::string_view::npos) {
      throw file_error(file, number, "the file is cut off, its last line has no end");
    }
    auto line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (!line.empty() && line.back() == '\r') {
      line.remove_suffix(1);
    }
    line = detail::trimmed(line);
    if (line.empty() || line.front() == '#') {
      continue;
    }
    const auto fields = detail::comma_fields(line);
    if (table.columns.empty()) {
      if (fields.size() > limits.columns) {
        throw file_error(file, number,
                         message(fields.size(), " columns, at most ", limits.columns, " are read"));
      }
      for (const auto name : fields) {
        if (name.empty() || name.find('"') != std::string_view::npos) {
          throw file_error(file, number, message(detail::quoted(name), " cannot name a column"));
        }
        if (parse_number(name)) {
          throw file_error(file, number, message("names of columns expected, not the number ", name));
        }
        if (std::find(table.columns.begin(), table.columns.end(), name) != table.columns.end()) {
          throw file_error(file, number, message("two columns are named ", name));
        }
        table.columns.emplace_back(name);
      }
      table.data.resize(fields.size());
      continue;
    }
    if (fields.size() != table.columns.size()) {
      throw file_error(file, number,
                       message(fields.size(), " fields in a table of ", table.columns.size(), " columns"));
    }
    for (std::size_t c = 0; c < fields.size(); ++c) {
      const auto value = parse_number(fields[c]);
      if (!value) {
        throw file_error(
            file, number,
            message(table.columns[c], " is ", detail::quoted(fields[c]), ", not a finite number"));
      }
      table.data[c].push_back(*value);
    }
  }
  if (table.columns.empty()) {
    throw file_error(file, number + 1, "the file holds no table");
  }
  if (table.rows() == 0) {
    throw file_error(file, number + 1, "the table holds no rows");
  }
  return table;
}

} // namespace scree

#pragma once
/// \file
/// validation.csv: one line for each finding, written as the cases end.

#include "finding.hpp"

#include "scree/core/error.hpp"
#include "scree/io/number_text.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace validation {

/// A field of a CSV file, quoted where it must be (RFC 4180).
inline std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\n") == std::string_view::npos) {
    return std::string{text};
  }
  std::string out = "\"";
  for (const char c : text) {
    out += c == '"' ? "\"\"" : std::string{c};
  }
  return out + "\"";
}

class Table {
public:
  /// \throws scree::Error naming the file.
  explicit Table(std::filesystem::path file) : file_{std::move(file)}, out_{file_, std::ios::trunc} {
    put("case,quantity,unit,reference,origin,source,simulated,error,error_is,tolerance,tolerance_grounds,"
        "pass,"
        "reason");
  }

  void add(const Finding& f) {
    std::string line;
    for (const std::string& field :
         {f.case_name, f.quantity, f.unit, scree::number_text(f.reference),
          std::string{name(f.source.origin)}, f.source.text, scree::number_text(f.simulated),
          scree::number_text(f.error()), std::string{f.tolerance.relative ? "relative" : "absolute"},
          scree::number_text(f.tolerance.size), f.tolerance.grounds, std::string{f.pass() ? "yes" : "no"},
          f.reason}) {
      line += line.empty() ? "" : ",";
      line += csv_field(field);
    }
    put(line);
  }

private:
  void put(const std::string& line) {
    out_ << line << '\n' << std::flush;
    if (!out_) {
      throw scree::Error(scree::message(file_.string(), ": cannot be written"));
    }
  }

  std::filesystem::path file_;
  std::ofstream out_;
};

} // namespace validation

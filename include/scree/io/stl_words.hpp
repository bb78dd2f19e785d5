#pragma once
/// \file
/// The words of a text STL file, and messages that name the line.

#include "scree/core/error.hpp"

#include <cctype>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <streambuf>
#include <string>
#include <string_view>

namespace scree::detail {

/// Splits a text file into words and knows the line of each. Never holds more than one word.
class StlWords {
public:
  StlWords(std::streambuf& input, const std::filesystem::path& file) : input_{input}, file_{file} {}

  /// The next word, or nothing at the end of the file.
  std::optional<std::string> next() {
    int c = input_.sgetc();
    while (is_space(c)) {
      skip();
      c = input_.sgetc();
    }
    if (c == end) {
      return std::nullopt;
    }
    std::string word;
    while (c != end && !is_space(c)) {
      if (word.size() == longest_word) {
        throw error(message("a word of more than ", longest_word, " characters"));
      }
      word.push_back(static_cast<char>(c));
      c = input_.snextc();
    }
    return word;
  }
  /// The next word; the file may not end here.
  std::string required(std::string_view what) {
    auto word = next();
    if (!word) {
      throw error(message("the file ends where ", what, " is expected"));
    }
    return *word;
  }
  void expect(std::string_view keyword) {
    const auto word = required(message("\"", keyword, "\""));
    if (!same(word, keyword)) {
      throw error(message("\"", word, "\" where \"", keyword, "\" is expected"));
    }
  }
  /// Skips to the end of the line.
  void finish_line() {
    for (int c = input_.sgetc(); c != end && c != '\n'; c = input_.snextc()) {
    }
  }
  [[nodiscard]] Error error(std::string_view what) const { return file_error(file_, line_, what); }

  /// Keywords are lower case by the letter of the format, but some programs write them in capitals.
  static bool same(std::string_view word, std::string_view keyword) {
    if (word.size() != keyword.size()) {
      return false;
    }
    for (std::size_t i = 0; i < word.size(); ++i) {
      if (std::tolower(static_cast<unsigned char>(word[i])) != keyword[i]) {
        return false;
      }
    }
    return true;
  }

private:
  static constexpr int end = std::streambuf::traits_type::eof();
  static constexpr std::size_t longest_word = 100;

  static bool is_space(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  void skip() { line_ += input_.sbumpc() == '\n' ? 1 : 0; }

  std::streambuf& input_;
  const std::filesystem::path& file_;
  std::size_t line_ = 1;
};

} // namespace scree::detail

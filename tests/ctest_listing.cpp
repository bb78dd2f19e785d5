/// \file
/// A doctest reporter that lists the test cases as calls of scree_add_case (cmake/AddCase.cmake) for CTest.

#include <doctest/doctest.h>

#include <array>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

namespace {

std::string_view label_of(std::string_view name) {
  constexpr std::array<std::string_view, 3> labels{"physics", "hidden-effects", "long"};
  for (const std::string_view label : labels) {
    if (name.starts_with(label) && name.substr(label.size()).starts_with(": ")) {
      return label;
    }
  }
  return "fast";
}

/// doctest splits a filter at commas, unless a backslash stands before them.
std::string filter_of(std::string_view name) {
  std::string filter;
  for (const char c : name) {
    if (c == ',' || c == '\\') {
      filter += '\\';
    }
    filter += c;
  }
  return filter;
}

class CtestListing : public doctest::IReporter {
public:
  explicit CtestListing(const doctest::ContextOptions& options) : out_{*options.cout} {}

  void report_query(const doctest::QueryData& query) override {
    std::set<std::string> names;
    for (unsigned i = 0; i < query.num_data; ++i) {
      const std::string name = query.data[i]->m_name;
      if (!names.insert(name).second) {
        throw std::runtime_error("two test cases of this folder are named \"" + name + "\"");
      }
      out_ << "scree_add_case([==[" << name << "]==] [==[" << filter_of(name) << "]==] " << label_of(name)
           << ")\n";
    }
  }

  void test_run_start() override {}
  void test_run_end(const doctest::TestRunStats&) override {}
  void test_case_start(const doctest::TestCaseData&) override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_end(const doctest::CurrentTestCaseStats&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}

private:
  std::ostream& out_;
};

} // namespace

DOCTEST_REGISTER_REPORTER("ctest", 1, CtestListing);

#include "make_measured/faults.hpp"

#include "scree/core/error.hpp"
#include "scree/io/number_text.hpp"
#include "support/comma_list.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <utility>

namespace make_measured {

using namespace scree;
namespace ex = scree::examples;

namespace {

/// "KEY=VALUE" as the two.
std::pair<std::string, std::string> halves(const char* option, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw Error(message(option, " = ", text, ": must be KEY=VALUE"));
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

} // namespace

void misread(const std::string& text, std::vector<ex::Reading>& readings) {
  for (const std::string& one : ex::comma_list(text)) {
    const auto [key, value] = halves("misread", one);
    const std::size_t point = std::min(key.find('.'), key.size());
    const std::string experiment = key.substr(0, point);
    const auto reading = std::find_if(readings.begin(), readings.end(),
                                      [&](const ex::Reading& r) { return r.experiment == experiment; });
    if (point == key.size() || reading == readings.end()) {
      throw Error(message("misread = ", one, ": '", key, "' is no EXPERIMENT.OBSERVABLE of this plan"));
    }
    const auto factor = parse_number(value);
    if (!factor) {
      throw Error(message("misread = ", one, ": '", value, "' is not a number"));
    }
    reading->gains[key.substr(point + 1)] = require("misread", *factor, {1e-3, 1e3});
  }
}

std::string as_it_was(const std::string& stated, const std::string& misstated) {
  toml::table top = toml::parse(stated);
  for (const std::string& one : ex::comma_list(misstated)) {
    const auto [key, value] = halves("misstated", one);
    toml::table* table = &top;
    std::size_t begin = 0;
    for (std::size_t point = key.find('.'); point != std::string::npos; point = key.find('.', begin)) {
      const std::string part = key.substr(begin, point - begin);
      begin = point + 1;
      // Only the last of an experiment's own keys need not be there, and may have tables of its own.
      toml::node* next = table->get(part);
      if (next == nullptr && table != &top) {
        next = &table->insert(part, toml::table{}).first->second;
      }
      if (next == nullptr || !next->is_table()) {
        throw Error(message("misstated = ", one, ": the plan has no table ", key.substr(0, point)));
      }
      table = next->as_table();
    }
    if (const auto number = parse_number(value)) {
      table->insert_or_assign(key.substr(begin), *number);
    } else {
      table->insert_or_assign(key.substr(begin), value);
    }
  }
  std::ostringstream out;
  out << top << '\n';
  return out.str();
}

} // namespace make_measured

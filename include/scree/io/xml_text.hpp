#pragma once
/// \file
/// Text within XML and HTML.

#include <string>
#include <string_view>

namespace scree {

/// Text that an XML or HTML reader gives back as it was, in content and in attributes between double quotes.
inline std::string xml_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
    case '&':
      escaped += "&amp;";
      break;
    case '<':
      escaped += "&lt;";
      break;
    case '>':
      escaped += "&gt;";
      break;
    case '"':
      escaped += "&quot;";
      break;
    default:
      escaped += c;
    }
  }
  return escaped;
}

} // namespace scree

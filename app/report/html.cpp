#include "app/report/html.h"

#include <cstddef>

namespace palpa::report {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

/// Length of the valid UTF-8 sequence at the beginning of a text; 0 if there is none.
std::size_t sequenceLength(std::string_view text) {
  const auto byte = [&](std::size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xC0) != 0x80) return 0;
  // Overlong forms, surrogates, and numbers above U+10FFFF.
  const unsigned second = byte(1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F))
    return 0;
  return length;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = sequenceLength(text);
    const auto first = static_cast<unsigned char>(text.front());
    const bool isControl = first < 0x20 && first != '\n' && first != '\t';
    if (length == 0 || isControl || first == 0x7F)
      result += kReplacement;
    else if (first == '&')
      result += "&amp;";
    else if (first == '<')
      result += "&lt;";
    else if (first == '>')
      result += "&gt;";
    else if (first == '"')
      result += "&quot;";
    else if (first == '\'')
      result += "&#39;";
    else
      result += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result;
}

std::string element(std::string_view name, const std::string& content,
                    std::string_view attributes) {
  std::string html = "<";
  html += name;
  if (!attributes.empty()) (html += ' ') += attributes;
  html += ">" + content + "</";
  html += name;
  return html + ">\n";
}

std::string HtmlTable::html() const {
  std::string rows;
  if (!columns_.empty()) {
    std::string names;
    for (const std::string& column : columns_) names += element("th", escaped(column), "scope=col");
    rows += element("thead", element("tr", names));
  }
  std::string body;
  for (const std::vector<std::string>& row : rows_) {
    std::string cells;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string text = escaped(row[k]);
      if (k == 0)
        cells += element("th", text, "scope=row");
      else
        cells += element("td", text,
                         columns_.empty() ? "" : "data-name=\"" + escaped(columns_.at(k)) + '"');
    }
    body += element("tr", cells);
  }
  rows += element("tbody", body);
  return element("table", rows, columns_.empty() ? "class=facts" : "class=cases");
}

}  // namespace palpa::report

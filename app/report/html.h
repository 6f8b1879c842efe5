#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

// HTML from text of users. Internal to app/report.
namespace palpa::report {

/// Text in which the characters that HTML interprets are replaced; bytes that are not UTF-8 and
/// control characters become U+FFFD.
std::string escaped(std::string_view text);

/// "<name attributes>content</name>\n"; `content` is HTML.
std::string element(std::string_view name, const std::string& content,
                    std::string_view attributes = {});

/// A table of text, which is escaped here.
class HtmlTable {
 public:
  /// A row of names above; on narrow screens each name stands before its cell instead.
  explicit HtmlTable(std::vector<std::string> columns) : columns_(std::move(columns)) {}
  /// Rows of a name and a value.
  HtmlTable() = default;

  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  bool isEmpty() const { return rows_.empty(); }
  std::string html() const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace palpa::report

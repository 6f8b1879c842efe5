#pragma once

#include <string>
#include <string_view>

namespace palpa::modeling {

/// Walks through a text line by line and word by word, without copies.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : rest_(text) {}

  /// Goes to the next line; false at the end of the text. Lines end with \n, \r\n or \r.
  bool nextLine();
  int line() const { return line_; }  ///< the first is 1

  /// The next word of the line; empty at its end.
  std::string_view word();
  /// What is left of the line, without blanks around it.
  std::string_view restOfLine() const;
  /// The text behind the line.
  std::string_view rest() const { return rest_; }

  /// The next word as a number. @throws ModelingError naming the line when it is none or not finite
  double number();
  long long integer();
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string_view rest_;
  std::string_view current_;
  int line_ = 0;
};

/// For messages: at most 40 characters, what cannot be printed replaced.
std::string excerpt(std::string_view text);

}  // namespace palpa::modeling

#pragma once

#include <string>
#include <string_view>

namespace palpa::modeling {

/// Reads a text line by line and word by word, without copies. The text must outlive the cursor.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : rest_(text) {}

  /// Goes to the next line; false at the end of the text. Lines end with \n, \r\n or \r.
  bool nextLine();
  int line() const { return line_; }  ///< the first is 1

  /// The next word of the line; empty at its end.
  std::string_view word();
  /// The unread part of the line, without blanks around it.
  std::string_view restOfLine() const;
  /// The text after the line.
  std::string_view rest() const { return rest_; }

  /// The next word as a number. Throws ModelingError that names the line if the word is not a
  /// number or not finite.
  double number();
  /// The next word as an integer, at most 2^32 - 1 in magnitude. Throws as number().
  long long integer();
  /// Throws ModelingError that begins with the line and ends with the remedy.
  [[noreturn]] void fail(const std::string& what,
                         const std::string& remedy = "export the file again") const;

 private:
  std::string_view rest_;
  std::string_view current_;
  int line_ = 0;
};

/// Text for messages: at most 40 characters, with unprintable characters replaced.
std::string excerpt(std::string_view text);

}  // namespace palpa::modeling

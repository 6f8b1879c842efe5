#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpa::docs {

/// A statement of the sources that can become a message, as a template: its texts in order, with
/// "…" for what is inserted.
struct MessageTemplate {
  std::string file;  // relative to the root
  int line;          // of its first text
  std::string text;
  std::vector<std::string> pieces;  // the parts between insertions, as they are written
};

/// The messages of the program's sources. In bem/, modeling/ and app/core/ every text of two words
/// and more counts, in the other folders of app/ those of statements that throw an error or refuse
/// something, in app/cli/ and app/gui/ also those with a word as "cannot", "not" or "needs". Texts
/// of assertions, of std::invalid_argument and std::logic_error (defects of the program), of JSON
/// and of shaders do not count.
std::vector<MessageTemplate> findMessages(const std::filesystem::path& root);

/// Does a text have two words or more?
bool isProse(const std::string& text);

/// Blanks as one, none at the ends.
std::string trimmed(const std::string& text);

/// Splits at every occurrence of the separator.
std::vector<std::string> split(const std::string& text, const std::string& separator);

}  // namespace palpa::docs

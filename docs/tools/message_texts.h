#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpa::docs {

/// A statement of the sources that can become a message, as a template: its texts in order, with
/// "…" for inserted values.
struct MessageTemplate {
  std::string file;  // relative to the root
  int line;          // of its first text
  std::string text;
  std::vector<std::string> pieces;  // the parts between insertions, as they are written
};

/// The messages in the sources of the program: every text of two or more words in bem/, modeling/
/// and app/core/; in the other folders of app/ the texts of statements that throw an error or
/// refuse something; in app/cli/ and app/gui/ also texts with a word like "cannot", "not" or
/// "needs". Not texts of assertions, std::invalid_argument and std::logic_error (defects of the
/// program), JSON and shaders.
std::vector<MessageTemplate> findMessages(const std::filesystem::path& root);

/// True if a text has two words or more.
bool isProse(const std::string& text);

/// The text with single blanks, none at its ends.
std::string trimmed(const std::string& text);

/// Splits at every occurrence of the separator.
std::vector<std::string> split(const std::string& text, const std::string& separator);

}  // namespace palpa::docs

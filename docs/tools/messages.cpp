#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

#include "docs/tools/message_texts.h"

// Keeps the list of messages in the user guide complete.
//   messages list ROOT: prints all messages of the sources as templates.
//   messages check ROOT PAGE NO_MESSAGES: fails unless the page has every text of a message in a
//     code span, and the sources have every code span in the first column of its tables. Each line
//     of NO_MESSAGES is a text that is no message, or a source file without messages.
namespace palpa::docs {
namespace {

std::string read(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The code spans of a line.
std::vector<std::string> codeSpans(const std::string& line) {
  const std::vector<std::string> parts = split(line, "`");
  std::vector<std::string> spans;
  for (std::size_t i = 1; i + 1 < parts.size(); i += 2) spans.push_back(trimmed(parts[i]));
  return spans;
}

/// What is left of a template when all known texts are taken out of it, the longest first.
std::string withoutKnown(std::string text, const std::set<std::string>& known) {
  std::vector<std::string> byLength(known.begin(), known.end());
  std::stable_sort(byLength.begin(), byLength.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  for (const std::string& piece : byLength)
    for (std::size_t at; (at = text.find(piece)) != std::string::npos;)
      text.replace(at, piece.size(), "…");
  return text;
}

int check(const std::string& root, const std::string& pageFile, const std::string& ignoredFile) {
  std::string shown;  // all code spans of the page
  std::vector<std::string> listed;
  for (const std::string& line : split(read(pageFile), "\n")) {
    for (const std::string& span : codeSpans(line)) shown += span + "\n";
    if (line.rfind("| ", 0) != 0) continue;
    for (const std::string& span : codeSpans(split(line, " | ")[0])) listed.push_back(span);
  }
  std::set<std::string> ignored;
  for (const std::string& line : split(read(ignoredFile), "\n"))
    if (!line.empty() && line[0] != '#') ignored.insert(trimmed(line));

  int problems = 0;
  std::set<std::string> known;  // all texts of the sources
  std::set<std::string> unused = ignored;
  for (const MessageTemplate& message : findMessages(root)) {
    unused.erase(message.file);
    for (const std::string& untrimmed : message.pieces) {
      const std::string piece = trimmed(untrimmed);
      if (!isProse(piece)) continue;
      known.insert(piece);
      unused.erase(piece);
      if (ignored.count(message.file) || ignored.count(piece) ||
          shown.find(piece) != std::string::npos)
        continue;
      std::printf("%s:%d: \"%s\" is missing on %s: say there what it means and what to do\n",
                  message.file.c_str(), message.line, piece.c_str(), pageFile.c_str());
      ++problems;
    }
  }
  for (const std::string& span : listed)
    for (const std::string& piece : split(withoutKnown(span, known), "…"))
      if (isProse(piece)) {
        std::printf("%s: \"%s\" in \"%s\" is no text of the program (any more)\n", pageFile.c_str(),
                    trimmed(piece).c_str(), span.c_str());
        ++problems;
      }
  for (const std::string& text : unused) {
    std::printf("%s: \"%s\" is no text of the program (any more)\n", ignoredFile.c_str(),
                text.c_str());
    ++problems;
  }
  if (listed.size() < 100) {
    std::printf("%s: only %zu messages are listed; the tables were not read as they should\n",
                pageFile.c_str(), listed.size());
    ++problems;
  }
  return problems > 0;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 2 && arguments[0] == "list") {
    for (const MessageTemplate& message : findMessages(arguments[1]))
      std::printf("%s:%d: %s\n", message.file.c_str(), message.line, trimmed(message.text).c_str());
    return 0;
  }
  if (arguments.size() == 4 && arguments[0] == "check")
    return check(arguments[1], arguments[2], arguments[3]);
  std::fprintf(stderr, "usage: messages list ROOT | check ROOT PAGE NO_MESSAGES\n");
  return 2;
}

}  // namespace
}  // namespace palpa::docs

int main(int argc, char** argv) {
  try {
    return palpa::docs::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "messages: %s\n", error.what());
    return 2;
  }
}

#include "modeling/exchange/brep_names.h"

namespace palpa::modeling {
namespace {

constexpr const char* kHeading = "\npalpa-face-names ";

/// A name with its line breaks escaped by backslashes, because each name takes one line.
std::string escaped(const std::string& name) {
  std::string result;
  for (const char c : name) {
    if (c == '\\') result += "\\\\";
    if (c == '\n') result += "\\n";
    if (c == '\r') result += "\\r";
    if (c != '\\' && c != '\n' && c != '\r') result += c;
  }
  return result;
}

std::string unescaped(const std::string& line) {
  std::string result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '\\' || i + 1 == line.size()) {
      if (line[i] != '\r') result += line[i];  // from Windows editors
      continue;
    }
    ++i;
    result += line[i] == 'n' ? '\n' : line[i] == 'r' ? '\r' : line[i];
  }
  return result;
}

}  // namespace

std::string brepNamesText(const std::vector<std::string>& names) {
  std::string text = kHeading + std::to_string(names.size()) + "\n";
  for (const std::string& name : names) text += escaped(name) + "\n";
  return text;
}

std::vector<std::string> brepNamesFrom(const std::string& text) {
  std::size_t at = text.rfind(kHeading);
  if (at == std::string::npos) return {};
  at = text.find('\n', at + 1);
  std::vector<std::string> names;
  while (at != std::string::npos && at + 1 < text.size()) {
    const std::size_t end = text.find('\n', at + 1);
    names.push_back(unescaped(text.substr(at + 1, end - at - 1)));
    at = end;
  }
  return names;
}

}  // namespace palpa::modeling

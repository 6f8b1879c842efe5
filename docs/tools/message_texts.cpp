#include "docs/tools/message_texts.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace palpa::docs {
namespace {

namespace fs = std::filesystem;

const std::string kGap = "…";

std::string textOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Literal {
  std::size_t begin;  // of its first quote
  std::size_t end;
  std::size_t statement;  // where the statement begins that it belongs to
  std::string text;
};

/// Walks over a source file, past comments and characters, and collects its texts. Texts with
/// nothing between them are one, as for the compiler.
class Scanner {
 public:
  explicit Scanner(const std::string& source) : source_(source) {}

  std::vector<Literal> literals() {
    while (at_ < source_.size()) step();
    return std::move(found_);
  }

 private:
  bool sees(const char* what) const {
    return source_.compare(at_, std::char_traits<char>::length(what), what) == 0;
  }
  void skipPast(const std::string& what) {
    const std::size_t place = source_.find(what, at_);
    at_ = place == std::string::npos ? source_.size() : place + what.size();
  }

  void step() {
    const char c = source_[at_];
    if (sees("//") || sees("#include")) return skipPast("\n");
    if (sees("/*")) return skipPast("*/");
    if (sees("R\"")) return raw();
    if (c == '"') return quoted();
    if (c == '\'' && (at_ == 0 || !std::isalnum(static_cast<unsigned char>(source_[at_ - 1]))))
      return character();
    if (c == ';' || c == '{' || c == '}') statement_ = at_ + 1;
    ++at_;
  }

  void raw() {
    const std::size_t open = source_.find('(', at_);
    const std::string close = ")" + source_.substr(at_ + 2, open - at_ - 2) + "\"";
    const std::size_t begin = at_;
    at_ = open;
    skipPast(close);
    add(begin, source_.substr(open + 1, at_ - close.size() - open - 1));
  }

  void quoted() {
    const std::size_t begin = at_;
    std::string text;
    for (++at_; at_ < source_.size() && source_[at_] != '"'; ++at_) {
      if (source_[at_] != '\\') {
        text += source_[at_];
        continue;
      }
      const char escaped = source_[++at_];
      text += escaped == 'n' || escaped == 't' ? ' ' : escaped;
    }
    ++at_;
    add(begin, text);
  }

  void character() {
    for (++at_; at_ < source_.size() && source_[at_] != '\''; ++at_)
      if (source_[at_] == '\\') ++at_;
    ++at_;
  }

  void add(std::size_t begin, const std::string& text) {
    const bool follows =
        !found_.empty() &&
        std::all_of(source_.begin() + static_cast<std::ptrdiff_t>(found_.back().end),
                    source_.begin() + static_cast<std::ptrdiff_t>(begin),
                    [](unsigned char c) { return std::isspace(c); });
    if (follows) {
      found_.back().text += text;
      found_.back().end = at_;
    } else {
      found_.push_back({begin, at_, statement_, text});
    }
  }

  const std::string& source_;
  std::size_t at_ = 0;
  std::size_t statement_ = 0;
  std::vector<Literal> found_;
};

/// The parts of a text between the placeholders of printf and Qt.
std::vector<std::string> piecesOf(const std::string& text) {
  static const std::regex kPlaceholder(R"(%(L?[0-9n]|[-+.0-9lz]*[a-zA-Z]|%))");
  std::vector<std::string> pieces;
  for (std::sregex_token_iterator it(text.begin(), text.end(), kPlaceholder, -1), end; it != end;
       ++it)
    pieces.push_back(*it);
  return pieces;
}

bool isForPeople(const std::string& folder, const std::string& statement, const std::string& text) {
  static const std::regex kDefect(
      R"(std::invalid_argument|std::logic_error|std::out_of_range|static_assert|\bassert\()");
  static const std::regex kJson(R"("\w+":)");
  static const std::regex kSaying(R"(\bthrow\s+[\w:]*(Error|Refused)\b|\b(refus|obstacle)\w*)");
  static const std::regex kRefusing(
      R"(\b(cannot|could|not|no|none|must|needs?|already|only|nothing|fail(s|ed)?|damaged|without|gone|lost|too|wrong|unknown|wait|first)\b)",
      std::regex::icase);
  if (std::regex_search(statement, kDefect)) return false;
  if (std::regex_search(text, kJson) || text.find("//VTK::") != std::string::npos) return false;
  if (folder == "base" || folder == "bem" || folder == "modeling" || folder == "app/core")
    return true;
  if (std::regex_search(statement, kSaying)) return true;
  return (folder == "app/cli" || folder == "app/gui") && std::regex_search(text, kRefusing);
}

void collect(const fs::path& file, const fs::path& root, const std::string& folder,
             std::vector<MessageTemplate>& messages) {
  const std::string source = textOf(file);
  std::size_t statement = std::string::npos;
  for (const Literal& literal : Scanner(source).literals()) {
    const std::string before = source.substr(literal.statement, literal.begin - literal.statement);
    if (!isForPeople(folder, before, literal.text)) continue;
    if (literal.statement != statement) {
      const auto line = std::count(
          source.begin(), source.begin() + static_cast<std::ptrdiff_t>(literal.begin), '\n');
      messages.push_back(
          {fs::relative(file, root).generic_string(), static_cast<int>(line) + 1, "", {}});
      statement = literal.statement;
    }
    MessageTemplate& message = messages.back();
    for (const std::string& piece : piecesOf(literal.text)) {
      message.pieces.push_back(piece);
      message.text += (message.text.empty() ? "" : kGap) + piece;
    }
  }
}

}  // namespace

bool isProse(const std::string& text) {
  static const std::regex kTwoWords(R"([A-Za-z][a-z']+[^A-Za-z]*\s[^A-Za-z]*[A-Za-z]?[a-z']+)");
  return std::regex_search(text, kTwoWords);
}

std::string trimmed(const std::string& text) {
  std::istringstream words(text);
  std::string result;
  for (std::string word; words >> word;) result += (result.empty() ? "" : " ") + word;
  return result;
}

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t to; (to = text.find(separator, from)) != std::string::npos;
       from = to + separator.size())
    parts.push_back(text.substr(from, to - from));
  parts.push_back(text.substr(from));
  return parts;
}

std::vector<MessageTemplate> findMessages(const fs::path& root) {
  std::vector<std::string> folders{"base", "bem", "modeling"};
  for (const auto& entry : fs::directory_iterator(root / "app"))
    if (entry.is_directory()) folders.push_back("app/" + entry.path().filename().string());
  std::sort(folders.begin() + 2, folders.end());
  std::vector<MessageTemplate> messages;
  for (const std::string& folder : folders) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h")
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) collect(file, root, folder, messages);
  }
  std::erase_if(messages, [](const MessageTemplate& message) {
    return std::none_of(message.pieces.begin(), message.pieces.end(), isProse);
  });
  return messages;
}

}  // namespace palpa::docs

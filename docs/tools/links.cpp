#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>

#include "docs/tools/message_texts.h"

// links ROOT: every link and picture in README.md, CHANGELOG.md and docs/ leads to a file of the
// project, every
// "#anchor" to a heading of its page, and every picture and every page is shown or linked
// somewhere. Links to the web are not followed.
namespace palpa::docs {
namespace {

namespace fs = std::filesystem;

struct Page {
  std::vector<std::string> links;
  std::set<std::string> anchors;
};

/// As GitHub names headings: lower case, without punctuation, "-" for blanks.
std::string anchorOf(const std::string& heading) {
  std::string text = heading;
  for (const char* mark : {"…", "–", "’", "“", "”", "·", "×", "→", "°", "²", "³"})
    for (std::size_t at; (at = text.find(mark)) != std::string::npos;)
      text.erase(at, std::char_traits<char>::length(mark));
  std::string anchor;
  for (const char character : text) {
    const auto c = static_cast<unsigned char>(character);
    if (c >= 0x80 || std::isalnum(c) || c == '_' || c == '-')
      anchor += static_cast<char>(std::tolower(c));
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

Page readPage(const fs::path& file) {
  static const std::regex kCode("`[^`]*`");
  static const std::regex kLink(R"re(\]\(([^()\s]+)\)|(?:src|href)="([^"]+)")re");
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  Page page;
  std::map<std::string, int> times;
  bool isFenced = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("```", 0) == 0) isFenced = !isFenced;
    if (isFenced) continue;
    if (line[0] == '#') {
      const std::string anchor = anchorOf(line.substr(line.find_first_not_of('#') + 1));
      const int before = times[anchor]++;
      page.anchors.insert(before == 0 ? anchor : anchor + "-" + std::to_string(before));
    }
    const std::string text = std::regex_replace(line, kCode, "");
    for (std::sregex_iterator it(text.begin(), text.end(), kLink), end; it != end; ++it)
      page.links.push_back((*it)[1].matched ? (*it)[1] : (*it)[2]);
  }
  return page;
}

bool isOfTheWeb(const std::string& link) {
  return link.find("://") != std::string::npos || link.rfind("mailto:", 0) == 0;
}

int check(const fs::path& root) {
  std::map<fs::path, Page> pages;
  std::set<fs::path> unused;
  for (const char* name : {"README.md", "CHANGELOG.md"}) pages[root / name] = readPage(root / name);
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
    const fs::path& file = entry.path();
    if (file.extension() == ".md") pages[file] = readPage(file);
    if (file.extension() == ".md" || file.extension() == ".png" || file.extension() == ".webp")
      unused.insert(file);
  }
  int problems = 0;
  int links = 0;
  for (const auto& [file, page] : pages)
    for (const std::string& link : page.links) {
      if (isOfTheWeb(link)) continue;
      ++links;
      const std::vector<std::string> parts = split(link, "#");
      const fs::path target =
          parts[0].empty() ? file : (file.parent_path() / parts[0]).lexically_normal();
      unused.erase(target);
      if (fs::is_directory(target))
        for (const auto& entry : fs::directory_iterator(target)) unused.erase(entry.path());
      const auto known = pages.find(target);
      const bool isThere = parts.size() == 1
                               ? fs::exists(target)
                               : known != pages.end() && known->second.anchors.count(parts[1]);
      if (isThere) continue;
      std::printf("%s: \"%s\" leads nowhere\n", file.c_str(), link.c_str());
      ++problems;
    }
  for (const fs::path& file : unused) {
    std::printf("%s: no page shows it or links to it\n", file.c_str());
    ++problems;
  }
  if (links < 50) {
    std::printf("only %d links were found; the pages were not read as they should\n", links);
    ++problems;
  }
  return problems > 0;
}

}  // namespace
}  // namespace palpa::docs

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: links ROOT\n");
    return 2;
  }
  try {
    return palpa::docs::check(std::filesystem::canonical(argv[1]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "links: %s\n", error.what());
    return 2;
  }
}

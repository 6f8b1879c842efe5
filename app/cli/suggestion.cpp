#include "app/cli/suggestion.h"

#include <algorithm>
#include <cctype>

namespace palpa::cli {
namespace {

constexpr std::size_t kLettersPerError = 3;

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Number of typing errors between two words (optimal string alignment: no letter changes twice).
std::size_t typingErrors(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t wrong = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + wrong});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

std::string didYouMean(std::string_view typed, const std::vector<std::string>& known) {
  const std::string word = lower(typed);
  const std::string* best = nullptr;
  std::size_t fewest = std::max<std::size_t>(1, word.size() / kLettersPerError) + 1;
  for (const std::string& each : known) {
    const std::size_t count = typingErrors(word, lower(each));
    if (count >= fewest) continue;
    fewest = count;
    best = &each;
  }
  if (!best && word.size() >= kLettersPerError) {
    const auto holds = std::find_if(known.begin(), known.end(), [&](const std::string& each) {
      return lower(each).find(word) != std::string::npos;
    });
    if (holds != known.end()) best = &*holds;
  }
  return best ? " (did you mean '" + *best + "'?)" : std::string();
}

}  // namespace palpa::cli

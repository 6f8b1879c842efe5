#include "modeling/exchange/text_cursor.h"

#include <charconv>
#include <cmath>

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0';
}

}  // namespace

std::string excerpt(std::string_view text) {
  std::string result(text.substr(0, 40));
  for (char& c : result)
    if (c < ' ' || c > '~') c = '?';
  return "\"" + result + (text.size() > 40 ? "…\"" : "\"");
}

bool TextCursor::nextLine() {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find_first_of("\r\n");
  current_ = rest_.substr(0, end);
  if (end == std::string_view::npos)
    rest_ = {};
  else
    rest_.remove_prefix(end + (rest_.substr(end, 2) == "\r\n" ? 2 : 1));
  ++line_;
  return true;
}

std::string_view TextCursor::word() {
  std::size_t begin = 0;
  while (begin < current_.size() && isBlank(current_[begin])) ++begin;
  std::size_t end = begin;
  while (end < current_.size() && !isBlank(current_[end])) ++end;
  const std::string_view found = current_.substr(begin, end - begin);
  current_.remove_prefix(end);
  return found;
}

std::string_view TextCursor::restOfLine() const {
  std::string_view text = current_;
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

double TextCursor::number() {
  std::string_view text = word();
  if (text.empty()) fail("a number is missing");
  const std::string_view shown = text;
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) fail(excerpt(shown) + " is too large or too small");
  if (error != std::errc() || end != text.data() + text.size())
    fail("expected a number, found " + excerpt(shown));
  if (!std::isfinite(value)) fail(excerpt(shown) + " is not finite");
  return value;
}

long long TextCursor::integer() {
  const double value = number();
  constexpr double kMaxIndex = 4294967295.0;
  if (value != std::floor(value) || std::abs(value) > kMaxIndex) fail("expected a whole number");
  return static_cast<long long>(value);
}

void TextCursor::fail(const std::string& what, const std::string& remedy) const {
  throw ModelingError("line " + std::to_string(line_) + ": " + what + "; " + remedy);
}

}  // namespace palpa::modeling

#include "app/verification/expression.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace palpa::verification {
namespace {

/// Recursive descent: sum = product {+|- product}; product = sign {*|/ sign};
/// sign = [-|+] sign | power; power = atom [** sign]; atom = number | name | sqrt(sum) | (sum).
class Parser {
 public:
  Parser(const std::string& text, const std::map<std::string, double>& names)
      : text_(text), names_(names) {}

  double value() {
    const double result = sum();
    if (peek() != '\0') fail("unexpected character");
    return result;
  }

 private:
  double sum() {
    double result = product();
    while (true) {
      if (take("+"))
        result += product();
      else if (take("-"))
        result -= product();
      else
        return result;
    }
  }
  double product() {
    double result = sign();
    while (true) {
      if (take("*"))
        result *= sign();
      else if (take("/"))
        result /= sign();
      else
        return result;
    }
  }
  double sign() {
    if (take("-")) return -sign();
    if (take("+")) return sign();
    return power();
  }
  double power() {
    const double base = atom();
    return take("**") ? std::pow(base, sign()) : base;
  }
  double atom() {
    if (take("(")) return closed(sum());
    const char first = peek();
    if (std::isdigit(static_cast<unsigned char>(first)) || first == '.') {
      double number = 0;
      const char* begin = text_.data() + place_;
      const auto [end, status] = std::from_chars(begin, text_.data() + text_.size(), number);
      if (status != std::errc()) fail("wrong number");
      place_ += static_cast<std::size_t>(end - begin);
      return number;
    }
    std::string name;
    while (place_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[place_])) || text_[place_] == '_'))
      name += text_[place_++];
    if (name == "sqrt") {
      if (!take("(")) fail("sqrt needs parentheses");
      return std::sqrt(closed(sum()));
    }
    if (name == "pi") return std::numbers::pi;
    const auto found = names_.find(name);
    if (found == names_.end()) fail(name.empty() ? "value missing" : "unknown name " + name);
    return found->second;
  }
  double closed(double value) {
    if (!take(")")) fail("closing parenthesis missing");
    return value;
  }

  char peek() {
    while (place_ < text_.size() && text_[place_] == ' ') ++place_;
    return place_ < text_.size() ? text_[place_] : '\0';
  }
  /// Takes an operator if it is next; "*" is not the beginning of "**".
  bool take(const std::string& symbol) {
    peek();
    if (text_.compare(place_, symbol.size(), symbol) != 0) return false;
    if (symbol == "*" && text_.compare(place_, 2, "**") == 0) return false;
    place_ += symbol.size();
    return true;
  }
  [[noreturn]] void fail(const std::string& reason) const {
    throw std::invalid_argument(reason + " at character " + std::to_string(place_) + " of '" +
                                text_ + "'");
  }

  const std::string& text_;
  const std::map<std::string, double>& names_;
  std::size_t place_ = 0;
};

}  // namespace

double evaluate(const std::string& expression, const std::map<std::string, double>& names) {
  // Parentheses are recursive calls.
  if (expression.size() > kMaxExpressionLength)
    throw std::invalid_argument("an expression of " + std::to_string(expression.size()) +
                                " characters is too long");
  return Parser(expression, names).value();
}

}  // namespace palpa::verification

#include "modeling/exchange/svg_values.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "modeling/error.h"
#include "modeling/exchange/text_cursor.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;

constexpr double kDegree = std::numbers::pi / 180.0;

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

}  // namespace

void SvgCursor::skipSeparators() {
  bool comma = false;
  while (!text_.empty() && (isBlank(text_.front()) || (!comma && text_.front() == ','))) {
    comma = comma || text_.front() == ',';
    text_.remove_prefix(1);
  }
}

bool SvgCursor::isAtEnd() {
  skipSeparators();
  return text_.empty();
}

char SvgCursor::take() {
  const char c = peek();
  if (!text_.empty()) text_.remove_prefix(1);
  return c;
}

bool SvgCursor::hasNumber() {
  skipSeparators();
  std::string_view rest = text_;
  if (!rest.empty() && (rest.front() == '+' || rest.front() == '-')) rest.remove_prefix(1);
  if (!rest.empty() && rest.front() == '.') rest.remove_prefix(1);
  return !rest.empty() && isDigit(rest.front());
}

double SvgCursor::number() {
  if (!hasNumber()) fail(text_.empty() ? "a number is missing" : "expected a number");
  std::string_view rest = text_;
  if (rest.front() == '+') rest.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc() || !std::isfinite(value)) fail("the number is too large or too small");
  text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
  return value;
}

bool SvgCursor::flag() {
  skipSeparators();
  const char c = peek();
  if (c != '0' && c != '1') fail("expected the flag 0 or 1 of an arc");
  take();
  return c == '1';
}

std::string_view SvgCursor::name() {
  skipSeparators();
  std::size_t length = 0;
  while (length < text_.size() && isLetter(text_[length])) ++length;
  const std::string_view found = text_.substr(0, length);
  text_.remove_prefix(length);
  return found;
}

void SvgCursor::expect(char c) {
  skipSeparators();
  if (peek() != c) fail(std::string("expected \"") + c + '"');
  take();
}

void SvgCursor::fail(const std::string& what) const {
  throw ModelingError("character " + std::to_string(all_ - text_.size() + 1) + ": " + what +
                      (text_.empty() ? "" : " at " + excerpt(text_.substr(0, 20))));
}

double svgLength(std::string_view text) {
  struct Unit {
    std::string_view name;
    double px;
  };
  constexpr std::array<Unit, 8> kUnits{{{"", 1.0},
                                        {"px", 1.0},
                                        {"mm", 96.0 / 25.4},
                                        {"cm", 960.0 / 25.4},
                                        {"in", 96.0},
                                        {"pt", 96.0 / 72.0},
                                        {"pc", 16.0},
                                        {"Q", 24.0 / 25.4}}};
  SvgCursor cursor(text);
  const double value = cursor.number();
  const std::string_view name = cursor.name();
  for (const Unit& unit : kUnits)
    if (unit.name == name && cursor.isAtEnd()) return value * unit.px;
  throw ModelingError("the length " + excerpt(text) +
                      " is not in px, mm, cm, in, pt, pc or Q, or without unit");
}

Eigen::Affine2d svgTransform(std::string_view text) {
  SvgCursor cursor(text);
  Eigen::Affine2d result = Eigen::Affine2d::Identity();
  while (!cursor.isAtEnd()) {
    const std::string_view name = cursor.name();
    if (name.empty() || name == "none") {
      if (name == "none" && cursor.isAtEnd()) break;
      cursor.fail("expected a transform");
    }
    cursor.expect('(');
    std::array<double, 6> a{};
    std::size_t count = 0;
    while (count < a.size() && cursor.hasNumber()) a[count++] = cursor.number();
    cursor.expect(')');
    Eigen::Affine2d one = Eigen::Affine2d::Identity();
    if (name == "matrix" && count == 6) {
      one.matrix().topRows<2>() << a[0], a[2], a[4], a[1], a[3], a[5];
    } else if (name == "translate" && (count == 1 || count == 2)) {
      one.translate(Vector2d(a[0], a[1]));
    } else if (name == "scale" && (count == 1 || count == 2)) {
      one.scale(Vector2d(a[0], count == 1 ? a[0] : a[1]));
    } else if (name == "rotate" && (count == 1 || count == 3)) {
      one.translate(Vector2d(a[1], a[2])).rotate(kDegree * a[0]).translate(-Vector2d(a[1], a[2]));
    } else if (name == "skewX" && count == 1) {
      one.matrix()(0, 1) = std::tan(kDegree * a[0]);
    } else if (name == "skewY" && count == 1) {
      one.matrix()(1, 0) = std::tan(kDegree * a[0]);
    } else {
      throw ModelingError("the transform " + excerpt(name) + " does not exist with " +
                          std::to_string(count) + " numbers");
    }
    result = result * one;
  }
  return result;
}

namespace {

/// Path data: commands and the state between them.
class PathReader {
 public:
  PathReader(DrawingBuilder& builder, std::string_view text) : builder_(builder), cursor_(text) {}

  void read() {
    char command = 0;
    while (!cursor_.isAtEnd()) {
      if (isLetter(cursor_.peek())) {
        const char letter = cursor_.take();
        if (command == 0 && letter != 'M' && letter != 'm') cursor_.fail("a path begins with M");
        command = letter;
      } else if (command == 0 || command == 'Z' || command == 'z') {
        cursor_.fail("expected a command");
      } else if (command == 'M' || command == 'm') {
        command = command == 'M' ? 'L' : 'l';
      }
      perform(command);
    }
    builder_.end();
  }

 private:
  Vector2d pair(const Vector2d& origin) {
    const double x = cursor_.number();
    return origin + Vector2d(x, cursor_.number());
  }

  void perform(char command) {
    const bool isRelative = command >= 'a';
    const char kind = isRelative ? static_cast<char>(command - 'a' + 'A') : command;
    const Vector2d present = at_;
    const Vector2d origin = isRelative ? present : Vector2d::Zero();
    Vector2d handle = present;  // reflected by S and T
    char handleOf = 0;
    switch (kind) {
      case 'M':
        at_ = start_ = pair(origin);
        builder_.moveTo(at_);
        break;
      case 'Z':
        builder_.close();
        at_ = start_;
        break;
      case 'L':
        at_ = pair(origin);
        builder_.lineTo(at_);
        break;
      case 'H':
        at_.x() = origin.x() + cursor_.number();
        builder_.lineTo(at_);
        break;
      case 'V':
        at_.y() = origin.y() + cursor_.number();
        builder_.lineTo(at_);
        break;
      case 'C':
      case 'S': {
        const Vector2d first = kind == 'C'        ? pair(origin)
                               : handleOf_ == 'C' ? Vector2d(2.0 * present - handle_)
                                                  : present;
        handle = pair(origin);
        handleOf = 'C';
        at_ = pair(origin);
        builder_.cubicTo(first, handle, at_);
        break;
      }
      case 'Q':
      case 'T':
        handle = kind == 'Q'        ? pair(origin)
                 : handleOf_ == 'Q' ? Vector2d(2.0 * present - handle_)
                                    : present;
        handleOf = 'Q';
        at_ = pair(origin);
        builder_.quadTo(handle, at_);
        break;
      case 'A':
        arc(present, origin);
        break;
      default:
        cursor_.fail(std::string("there is no path command \"") + command + '"');
    }
    handle_ = handle;
    handleOf_ = handleOf;
  }

  /// Elliptical arc between two points: SVG 1.1, appendix F.6.5.
  void arc(const Vector2d& from, const Vector2d& origin) {
    double rx = std::abs(cursor_.number()), ry = std::abs(cursor_.number());
    const double angle = kDegree * cursor_.number();
    const bool isLarge = cursor_.flag(), isPositive = cursor_.flag();
    const Vector2d to = at_ = pair(origin);
    if (from == to) return;
    if (!(rx > 0.0) || !(ry > 0.0)) {
      builder_.lineTo(to);
      return;
    }
    const Eigen::Rotation2Dd turn(angle);
    const Vector2d half = turn.inverse() * (0.5 * (from - to));
    const double needed = std::hypot(half.x() / rx, half.y() / ry);
    if (needed > 1.0) {
      rx *= needed;
      ry *= needed;
    }
    const Vector2d scaled(half.x() / rx, half.y() / ry);
    const double square = scaled.squaredNorm();
    const double factor =
        (isLarge == isPositive ? -1.0 : 1.0) * std::sqrt(std::max(0.0, 1.0 / square - 1.0));
    const Vector2d middle(factor * rx * scaled.y(), -factor * ry * scaled.x());
    const Vector2d centre = turn * middle + 0.5 * (from + to);
    const auto angleOf = [&](const Vector2d& p) { return std::atan2(p.y() / ry, p.x() / rx); };
    const double begin = angleOf(half - middle);
    double end = angleOf(-half - middle);
    if (isPositive && end < begin) end += 2.0 * std::numbers::pi;
    if (!isPositive && end > begin) end -= 2.0 * std::numbers::pi;
    builder_.arc(centre, turn * Vector2d(rx, 0.0), turn * Vector2d(0.0, ry), begin, end);
  }

  DrawingBuilder& builder_;
  SvgCursor cursor_;
  Vector2d at_ = Vector2d::Zero(), start_ = Vector2d::Zero(), handle_ = Vector2d::Zero();
  char handleOf_ = 0;  // C or Q: the command before had this kind of handle
};

}  // namespace

void addSvgPath(DrawingBuilder& builder, std::string_view text) {
  PathReader(builder, text).read();
}

}  // namespace palpa::modeling

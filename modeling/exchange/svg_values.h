#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string_view>

#include "modeling/exchange/drawing.h"

// Values of SVG attributes (SVG 1.1, sections 7.6, 8.3 and 4.2).
namespace palpa::modeling {

/// Cursor over the numbers, letters and flags of an attribute's value. Reading functions skip
/// separators first and throw ModelingError that names the character.
class SvgCursor {
 public:
  explicit SvgCursor(std::string_view text) : text_(text), all_(text.size()) {}

  /// Skips blanks, and at most one comma between numbers.
  void skipSeparators();
  bool isAtEnd();
  /// The next character without reading it; 0 at the end.
  char peek() const { return text_.empty() ? '\0' : text_.front(); }
  char take();
  /// True if a number begins here.
  bool hasNumber();
  double number();
  /// The digit 0 or 1 of an arc, which needs no separator after it.
  bool flag();
  /// The word of letters that begins here; may be empty.
  std::string_view name();
  void expect(char c);
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string_view text_;
  std::size_t all_;
};

/// Length in px: a number with a unit (px, mm, cm, in, pt, pc, Q) or none. Throws ModelingError for
/// relative units (%, em, …).
double svgLength(std::string_view text);

/// Map of a transform attribute, in px. Throws ModelingError.
Eigen::Affine2d svgTransform(std::string_view text);

/// Adds the paths of a path attribute (d), in px. Throws ModelingError.
void addSvgPath(DrawingBuilder& builder, std::string_view text);

}  // namespace palpa::modeling

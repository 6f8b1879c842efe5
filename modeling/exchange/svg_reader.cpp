// SVG files. Expat reads the XML: entities cannot grow without limit, and errors have a line.
#include <expat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "modeling/error.h"
#include "modeling/exchange/drawing.h"
#include "modeling/exchange/svg_values.h"
#include "modeling/exchange/text_cursor.h"

namespace palpa::modeling {
namespace {

using Eigen::Affine2d;
using Eigen::Vector2d;

constexpr double kPx = 25.4 / 96.0;  // mm
constexpr std::size_t kMaxDepth = 200;
constexpr std::size_t kMaxElements = 1'000'000;

/// Attributes of an element: name, value, …, null.
class Attributes {
 public:
  explicit Attributes(const XML_Char** list) : list_(list) {}

  std::optional<std::string_view> text(std::string_view name) const {
    for (const XML_Char** at = list_; *at; at += 2)
      if (name == at[0]) return at[1];
    return std::nullopt;
  }
  /// Length in px.
  double length(std::string_view name, double otherwise = 0.0) const {
    const auto value = text(name);
    if (!value) return otherwise;
    try {
      return svgLength(*value);
    } catch (const ModelingError& error) {
      throw ModelingError(std::string(name) + ": " + error.what());
    }
  }
  /// Value of a property, as an attribute or in the attribute style.
  std::string_view property(std::string_view name) const {
    const std::string_view style = text("style").value_or("");
    for (std::size_t at = style.find(name); at != std::string_view::npos;
         at = style.find(name, at + 1)) {
      const std::size_t colon = style.find_first_not_of(" \t\r\n", at + name.size());
      const bool isWhole = at == 0 || style[at - 1] == ';' || style[at - 1] == ' ';
      if (!isWhole || colon == std::string_view::npos || style[colon] != ':') continue;
      const std::size_t from = style.find_first_not_of(" \t\r\n", colon + 1);
      if (from == std::string_view::npos) return {};
      return style.substr(from, style.find_first_of("; \t\r\n", from) - from);
    }
    return text(name).value_or("");
  }

 private:
  const XML_Char** list_;
};

class SvgReader {
 public:
  SvgReader(std::string_view text, const Job& job)
      : job_(job), parser_(XML_ParserCreateNS(nullptr, '}'), &XML_ParserFree), text_(text) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), &SvgReader::onStart, &SvgReader::onEnd);
  }

  Drawing read() {
    // Expat counts its input in int; kMaxDrawingFile is smaller.
    const XML_Status status =
        XML_Parse(parser_.get(), text_.data(), static_cast<int>(text_.size()), XML_TRUE);
    if (problem_) std::rethrow_exception(problem_);
    if (status != XML_STATUS_OK)
      throw ModelingError("line " + std::to_string(XML_GetCurrentLineNumber(parser_.get())) + ": " +
                          XML_ErrorString(XML_GetErrorCode(parser_.get())) +
                          "; this is not a complete SVG file");
    drawing_.paths = builder_.take();
    return std::move(drawing_);
  }

 private:
  struct Level {
    Affine2d toMm = Affine2d::Identity();
    std::string layer;
    bool isSkipped = false;
  };

  static void onStart(void* self, const XML_Char* name, const XML_Char** attributes) noexcept {
    auto* reader = static_cast<SvgReader*>(self);
    if (reader->problem_) return;
    reader->guard([&] { reader->start(name, Attributes(attributes)); });
  }

  static void onEnd(void* self, const XML_Char* /*name*/) noexcept {
    auto* reader = static_cast<SvgReader*>(self);
    if (!reader->problem_ && !reader->levels_.empty()) reader->levels_.pop_back();
  }

  /// Exceptions must not pass through expat, which is C.
  template <class Work>
  void guard(const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      problem_ = std::current_exception();
      XML_StopParser(parser_.get(), XML_FALSE);
    }
  }

  void start(std::string_view name, const Attributes& attributes) {
    const int line = static_cast<int>(XML_GetCurrentLineNumber(parser_.get()));
    const std::string_view local = name.substr(name.rfind('}') + 1);
    const std::string place = "line " + std::to_string(line) + ": <" + plain(local) + ">";
    try {
      enter(name, local, place, attributes);
    } catch (const ModelingError& error) {
      if (std::string_view(error.what()).starts_with("line ")) throw;
      throw ModelingError(place + ": " + error.what(), error.kind());
    }
  }

  static std::string plain(std::string_view name) {
    const std::string quoted = excerpt(name);
    return quoted.substr(1, quoted.size() - 2);
  }

  void enter(std::string_view name, std::string_view local, const std::string& place,
             const Attributes& attributes) {
    job_.throwIfCancelled();
    if (++elements_ > kMaxElements)
      throw ModelingError("the file has more than " + std::to_string(kMaxElements) + " elements",
                          ModelingError::Kind::kTooLarge);
    if (levels_.size() >= kMaxDepth)
      throw ModelingError("elements are nested more than " + std::to_string(kMaxDepth) + " deep");
    if (levels_.empty()) {
      if (local != "svg") throw ModelingError("the file does not begin with <svg>");
      levels_.push_back({pageToMm(attributes), {}, false});
      return;
    }
    Level level = levels_.back();
    levels_.push_back(level);
    if (level.isSkipped) return;
    constexpr std::string_view kSvg = "http://www.w3.org/2000/svg";
    const bool isForeign = local.size() < name.size() && !name.starts_with(kSvg);
    if (isForeign || isDefinition(local)) {
      levels_.back().isSkipped = true;
      return;
    }
    const std::string_view visibility = attributes.property("visibility");
    if (attributes.property("display") == "none" || visibility == "hidden" ||
        visibility == "collapse") {
      levels_.back().isSkipped = true;
      ++drawing_.skipped["hidden"];
      return;
    }
    if (const auto transform = attributes.text("transform"))
      level.toMm = level.toMm * svgTransform(*transform);
    if (local == "g" || local == "a" || local == "switch") {
      constexpr auto kInkscape = "http://www.inkscape.org/namespaces/inkscape}";
      const auto label = attributes.text(std::string(kInkscape) + "label");
      if (const auto layer = label ? label : attributes.text("id"))
        if (level.layer.empty() || attributes.text(std::string(kInkscape) + "groupmode") == "layer")
          level.layer = *layer;
      levels_.back() = level;
      return;
    }
    builder_.begin(place, level.layer, level.toMm);
    if (addShape(local, attributes)) return;
    levels_.back().isSkipped = true;
    ++drawing_.skipped[plain(local)];
  }

  static bool isDefinition(std::string_view name) {
    for (const std::string_view each :
         {"defs", "symbol", "clipPath", "mask", "pattern", "marker", "metadata", "title", "desc",
          "style", "script", "linearGradient", "radialGradient", "filter"})
      if (name == each) return true;
    return false;
  }

  /// Map from user units to mm, y upwards from the lower edge of the page.
  Affine2d pageToMm(const Attributes& attributes) {
    const auto given = [&](const char* name) -> std::optional<double> {
      const auto value = attributes.text(name);
      if (!value || value->ends_with('%') || *value == "auto") return std::nullopt;
      const double px = attributes.length(name);
      if (!(px > 0.0)) throw ModelingError(std::string(name) + ": expected a length > 0");
      return px;
    };
    const auto width = given("width"), height = given("height");
    Affine2d toPx = Affine2d::Identity();
    double pageHeight = height.value_or(0.0);
    if (const auto box = attributes.text("viewBox")) {
      SvgCursor cursor(*box);
      std::array<double, 4> b{};
      for (double& value : b) value = cursor.number();
      if (!(b[2] > 0.0) || !(b[3] > 0.0)) throw ModelingError("viewBox: the size must be > 0");
      Vector2d scale(width ? *width / b[2] : 1.0, height ? *height / b[3] : 1.0);
      if (!width) scale.x() = scale.y();
      if (!height) scale.y() = scale.x();
      Vector2d rest = Vector2d::Zero();
      const std::string_view ratio =
          attributes.text("preserveAspectRatio").value_or("xMidYMid meet");
      if (!ratio.starts_with("none")) {
        const bool slices = ratio.find("slice") != std::string_view::npos;
        const double one = slices ? scale.maxCoeff() : scale.minCoeff();
        const Vector2d left = Vector2d(b[2], b[3]).cwiseProduct(scale - Vector2d(one, one));
        const auto share = [&](char letter) {
          const std::size_t at = ratio.find(letter);
          const std::string_view word =
              at == std::string_view::npos ? "Mid" : ratio.substr(at + 1, 3);
          return word == "Min" ? 0.0 : word == "Max" ? 1.0 : 0.5;
        };
        rest = Vector2d(share('x') * left.x(), share('Y') * left.y());
        scale = Vector2d(one, one);
      }
      if (!height) pageHeight = b[3] * scale.y();
      toPx.translate(rest).scale(scale).translate(-Vector2d(b[0], b[1]));
    }
    drawing_.unit =
        width || height ? "mm from the page" : "px (the file states no size of the page)";
    Affine2d toMm = Affine2d::Identity();
    toMm.scale(Vector2d(kPx, -kPx)).translate(Vector2d(0.0, -pageHeight));
    return toMm * toPx;
  }

  bool addShape(std::string_view name, const Attributes& a) {
    if (name == "path") {
      addSvgPath(builder_, a.text("d").value_or(""));
    } else if (name == "line") {
      builder_.moveTo({a.length("x1"), a.length("y1")});
      builder_.lineTo({a.length("x2"), a.length("y2")});
    } else if (name == "polyline" || name == "polygon") {
      addPolygon(a.text("points").value_or(""), name == "polygon");
    } else if (name == "rect") {
      addRectangle(a);
    } else if (name == "circle" || name == "ellipse") {
      const bool isCircle = name == "circle";
      const double rx = a.length(isCircle ? "r" : "rx"), ry = a.length(isCircle ? "r" : "ry");
      if (!(rx > 0.0) || !(ry > 0.0)) return true;  // draws nothing
      builder_.arc({a.length("cx"), a.length("cy")}, {rx, 0.0}, {0.0, ry}, 0.0,
                   2.0 * std::numbers::pi);
      builder_.close();
    } else {
      return false;
    }
    return true;
  }

  void addPolygon(std::string_view points, bool closed) {
    SvgCursor cursor(points);
    for (bool isFirst = true; !cursor.isAtEnd(); isFirst = false) {
      const double x = cursor.number();
      const Vector2d p(x, cursor.number());
      if (isFirst)
        builder_.moveTo(p);
      else
        builder_.lineTo(p);
    }
    if (closed) builder_.close();
  }

  void addRectangle(const Attributes& a) {
    const double x = a.length("x"), y = a.length("y");
    const double width = a.length("width"), height = a.length("height");
    if (!(width > 0.0) || !(height > 0.0)) return;  // draws nothing
    const auto radius = [&](const char* own, const char* other) {
      for (const char* name : {own, other})
        if (const auto value = a.text(name); value && *value != "auto") return a.length(name);
      return 0.0;
    };
    const double rx = std::clamp(radius("rx", "ry"), 0.0, 0.5 * width);
    const double ry = std::clamp(radius("ry", "rx"), 0.0, 0.5 * height);
    const bool isRound = rx > 0.0 && ry > 0.0;
    const Vector2d u(rx, 0.0), v(0.0, ry);
    constexpr double kQuarter = 0.5 * std::numbers::pi;
    const std::array<Vector2d, 4> corners{
        {{x + width, y}, {x + width, y + height}, {x, y + height}, {x, y}}};
    builder_.moveTo(isRound ? Vector2d(x + rx, y) : Vector2d(x, y));
    for (int k = 0; k < 4; ++k) {
      const Vector2d inwards(k < 2 ? -rx : rx, k == 0 || k == 3 ? ry : -ry);
      if (!isRound) {
        if (k < 3) builder_.lineTo(corners[k]);
        continue;
      }
      const Vector2d centre = corners[k] + inwards;
      const double from = (k - 1) * kQuarter;
      builder_.lineTo(centre + std::cos(from) * u + std::sin(from) * v);
      builder_.arc(centre, u, v, from, from + kQuarter);
    }
    builder_.close();
  }

  const Job& job_;
  std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser_;
  std::string_view text_;
  std::vector<Level> levels_;
  std::size_t elements_ = 0;
  DrawingBuilder builder_;
  Drawing drawing_;
  std::exception_ptr problem_;
};

}  // namespace

Drawing readSvg(std::string_view text, const std::string& source, const Job& job) {
  try {
    if (text.size() > kMaxDrawingFile)
      throw ModelingError("the file is too large", ModelingError::Kind::kTooLarge);
    Drawing drawing = SvgReader(text, job).read();
    if (!drawing.paths.empty()) return drawing;
    std::string skipped;
    for (const auto& [kind, count] : drawing.skipped)
      skipped += (skipped.empty() ? "; it has " : ", ") + std::to_string(count) + " " + kind;
    throw ModelingError("there is no line or curve that can become a profile" + skipped +
                        (drawing.skipped.count("text") > 0 ? ": convert texts to paths" : "") +
                        (drawing.skipped.count("use") > 0 ? ": unlink clones (use)" : ""));
  } catch (const ModelingError& error) {
    throw ModelingError(source + ": " + error.what(), error.kind());
  }
}

}  // namespace palpa::modeling

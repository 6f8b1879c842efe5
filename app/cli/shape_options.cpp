#include "app/cli/shape_options.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "app/cli/errors.h"
#include "app/cli/suggestion.h"
#include "app/cli/text.h"
#include "app/cli/values.h"
#include "modeling/project/profile_file.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::cli {
namespace {

using Shape = decltype(modeling::Primitive::shape);

/// Values of the given options, and defaults for the others.
class Values {
 public:
  Values(const std::string& shape, const std::map<std::string, std::string>& values)
      : shape_(shape), values_(values) {}

  double length(const char* option, double otherwise) const {
    return given(option) ? parsePositive(option, text(option)) : otherwise;
  }

  double lengthOrZero(const char* option, double otherwise) const {
    if (!given(option)) return otherwise;
    const double value = parseNumber(option, text(option));
    return value == 0.0 ? 0.0 : length(option, otherwise);
  }

  Eigen::Vector3d lengths(const char* option, const Eigen::Vector3d& otherwise) const {
    if (!given(option)) return otherwise;
    const Eigen::Vector3d value = parseVector(option, text(option));
    if (!(value.minCoeff() > 0))
      throw UsageError(std::string(option) + ": all lengths must be greater than zero");
    return value;
  }

  std::string file(const char* option) const {
    if (!given(option)) throw UsageError("new " + shape_ + " needs " + option + " FILE");
    return text(option);
  }

  int wholeNumber(const char* option, int otherwise) const {
    if (!given(option)) return otherwise;
    const double value = parseNumber(option, text(option));
    if (value != std::round(value) || std::abs(value) > 1e6)
      throw UsageError(std::string(option) + ": expected a whole number, found '" + text(option) +
                       "'");
    return static_cast<int>(value);
  }

 private:
  const std::string& text(const char* option) const { return values_.at(option); }
  bool given(const char* option) const { return !text(option).empty(); }

  const std::string& shape_;
  const std::map<std::string, std::string>& values_;
};

struct Option {
  const char* name;
  const char* type;
  const char* help;
};

constexpr Option kOptions[] = {
    {"--radius", "LENGTH", "Radius in mm (sphere 25, cylinder 20, capsule 10)"},
    {"--radii", "X,Y,Z", "Radii in mm (ellipsoid 30,20,15)"},
    {"--height", "LENGTH", "Height in mm (cylinder 60, cone 30, extrude 20)"},
    {"--size", "X,Y,Z", "Edge lengths in mm (box 40,30,20)"},
    {"--bottom-radius", "LENGTH", "Radius of the base in mm (cone 20)"},
    {"--top-radius", "LENGTH", "Radius of the top in mm, 0 for an apex (cone 10)"},
    {"--length", "LENGTH", "Length between the half spheres in mm (capsule 30)"},
    {"--major-radius", "LENGTH", "Radius of the ring's centre line in mm (torus 25)"},
    {"--minor-radius", "LENGTH", "Radius of the ring's section in mm (torus 8)"},
    {"--profile", "FILE", "Profile curve (revolve, extrude) or list of sections (loft), JSON"},
    {"--degree", "N", "Degree of all patches, 1 … 5 (default 3)"},
    {"--control-points", "N", "Control points per direction and patch (default: the shape's)"},
};

/// Where a body of this kind is fixed.
enum class Base { kBottomPatches, kLowestTenth };

struct Kind {
  const char* name;
  std::vector<const char*> options;  ///< beside --degree and --control-points
  Base base;
  std::function<Shape(const Values&)> shape;
};

const std::vector<Kind>& kinds() {
  using namespace modeling;
  static const std::vector<Kind> table{
      {"sphere",
       {"--radius"},
       Base::kLowestTenth,
       [](const Values& v) { return SphereShape{v.length("--radius", 25)}; }},
      {"ellipsoid",
       {"--radii"},
       Base::kLowestTenth,
       [](const Values& v) {
         return EllipsoidShape{v.lengths("--radii", {30, 20, 15})};
       }},
      {"box",
       {"--size"},
       Base::kBottomPatches,
       [](const Values& v) {
         return BoxShape{v.lengths("--size", {40, 30, 20})};
       }},
      {"cylinder",
       {"--radius", "--height"},
       Base::kBottomPatches,
       [](const Values& v) {
         return CylinderShape{v.length("--radius", 20), v.length("--height", 60)};
       }},
      {"cone",
       {"--bottom-radius", "--top-radius", "--height"},
       Base::kBottomPatches,
       [](const Values& v) {
         return ConeShape{v.length("--bottom-radius", 20), v.lengthOrZero("--top-radius", 10),
                          v.length("--height", 30)};
       }},
      {"capsule",
       {"--radius", "--length"},
       Base::kLowestTenth,
       [](const Values& v) {
         return CapsuleShape{v.length("--radius", 10), v.length("--length", 30)};
       }},
      {"torus",
       {"--major-radius", "--minor-radius"},
       Base::kLowestTenth,
       [](const Values& v) {
         return TorusShape{v.length("--major-radius", 25), v.length("--minor-radius", 8)};
       }},
      {"revolve",
       {"--profile"},
       Base::kLowestTenth,
       [](const Values& v) { return RevolveShape{readProfileCurve(v.file("--profile"))}; }},
      {"extrude",
       {"--profile", "--height"},
       Base::kBottomPatches,
       [](const Values& v) {
         return ExtrudeShape{readProfileCurve(v.file("--profile")), v.length("--height", 20)};
       }},
      {"loft",
       {"--profile"},
       Base::kBottomPatches,
       [](const Values& v) { return LoftShape{readSections(v.file("--profile"))}; }},
  };
  return table;
}

const Kind& kindNamed(const std::string& name) {
  for (const Kind& kind : kinds())
    if (kind.name == name) return kind;
  std::vector<std::string> known;
  for (const Kind& kind : kinds()) known.emplace_back(kind.name);
  const std::string suggestion = didYouMean(name, known);
  throw UsageError("there is no shape '" + name + "'" +
                   (suggestion.empty() ? "; known are " + shapeNames() : suggestion));
}

/// The lowest tenth of the body's height, the limit rounded to three digits.
modeling::Region lowestTenth(const modeling::Solid& solid) {
  constexpr int kSamples = 16;
  const modeling::SurfaceEvaluator surface(solid);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int patch = 0; patch < surface.patchCount(); ++patch)
    for (int i = 0; i <= kSamples; ++i)
      for (int j = 0; j <= kSamples; ++j) {
        const auto [uLow, uHigh] = surface.range(patch, 0);
        const auto [vLow, vHigh] = surface.range(patch, 1);
        const double z = surface
                             .position(patch, uLow + (uHigh - uLow) * i / kSamples,
                                       vLow + (vHigh - vLow) * j / kSamples)
                             .z();
        low = std::min(low, z);
        high = std::max(high, z);
      }
  const double limit = low + 0.1 * (high - low);
  // Relative to the height: far from z = 0, three digits of the limit itself could miss the body.
  const double unit = std::pow(10.0, std::floor(std::log10(high - low)) - 2.0);
  return modeling::Region::below(Eigen::Vector3d::UnitZ(),
                                 std::stod(format("%.10g", std::round(limit / unit) * unit)));
}

}  // namespace

std::string shapeNames() {
  std::string names;
  for (const Kind& kind : kinds()) names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

void ShapeOptions::declare(CLI::App& options) {
  for (const Option& option : kOptions)
    options.add_option(option.name, values_[option.name], option.help)->type_name(option.type);
}

modeling::Primitive ShapeOptions::primitive(const std::string& shape) const {
  const Kind& kind = kindNamed(shape);
  for (const auto& [option, value] : values_) {
    const bool known =
        option == "--degree" || option == "--control-points" ||
        std::find(kind.options.begin(), kind.options.end(), option) != kind.options.end();
    if (!known && !value.empty()) throw UsageError(option + " has no meaning for: " + shape);
  }
  const Values values(shape, values_);
  return {kind.shape(values), values.wholeNumber("--degree", 3),
          values.wholeNumber("--control-points", 0)};
}

modeling::Region baseOf(const modeling::Primitive& primitive, const modeling::Solid& solid) {
  if (kindNamed(modeling::shapeName(primitive)).base == Base::kLowestTenth)
    return lowestTenth(solid);
  std::vector<std::string> names;
  for (const modeling::Patch& patch : solid.patches())
    if (patch.name.rfind("bottom", 0) == 0) names.push_back(patch.name);
  return modeling::Region::ofPatches(names);
}

}  // namespace palpa::cli

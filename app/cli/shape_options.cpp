#include "app/cli/shape_options.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "app/cli/errors.h"
#include "app/cli/suggestion.h"
#include "app/cli/text.h"
#include "app/cli/values.h"
#include "modeling/exchange/profile_import.h"
#include "modeling/project/profile_file.h"

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

  std::string textOr(const char* option, const std::string& otherwise) const {
    return given(option) ? text(option) : otherwise;
  }

  double angleOr(const char* option, double otherwise) const {
    if (!given(option)) return otherwise;
    const double degrees = parseNumber(option, text(option));
    if (!(degrees >= 0.0) || degrees > 90.0)
      throw UsageError(std::string(option) + ": expected an angle from 0 to 90 degrees");
    return degrees * std::numbers::pi / 180.0;
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
    {"--profile", "FILE",
     "Profile curve (revolve, extrude): JSON, SVG or DXF; list of sections (loft): JSON"},
    {"--layer", "NAME", "Use only this layer of a drawing (SVG, DXF)"},
    {"--curve", "N", "Use this curve of a drawing; the error without it lists them"},
    {"--fit-tolerance", "LENGTH",
     "Largest distance in mm of the profile from a drawing (default: 1e-4 of its extent)"},
    {"--smooth-bends", "DEGREES",
     "Take lines of a drawing that turn by less for one smooth curve (default 0)"},
    {"--degree", "N", "Degree of all patches, 1 … 5 (default 3)"},
    {"--control-points", "N", "Control points per direction and patch (default: the shape's)"},
};

constexpr const char* kDrawingOptions[] = {"--layer", "--curve", "--fit-tolerance",
                                           "--smooth-bends"};

/// The profile in the file of --profile. Sets `deviation` if it is a drawing.
modeling::ProfileCurve profileFrom(const Values& values, bool mustBeClosed,
                                   std::optional<double>& deviation) {
  const std::string file = values.file("--profile");
  if (!modeling::isDrawingFile(file)) {
    for (const char* option : kDrawingOptions)
      if (!values.textOr(option, {}).empty())
        throw UsageError(std::string(option) + " has a meaning only for drawings (.svg, .dxf)");
    return modeling::readProfileCurve(file);
  }
  const modeling::ProfileDrawing drawing = modeling::readProfileDrawing(
      file, values.textOr("--layer", {}), values.length("--fit-tolerance", 0.0));
  const int number = values.wholeNumber("--curve", 0);
  if (number < 0) throw UsageError("--curve: curves are numbered from 1");
  const std::size_t path =
      number > 0 ? static_cast<std::size_t>(number) - 1 : modeling::onlyPath(drawing, mustBeClosed);
  const modeling::FittedProfile fitted =
      modeling::fitPath(drawing, path, {drawing.tolerance, values.angleOr("--smooth-bends", 0.0)});
  deviation = fitted.deviation;
  return fitted.curve;
}

struct Kind {
  const char* name;
  std::vector<const char*> options;  ///< beside --degree and --control-points
  std::function<Shape(const Values&, std::optional<double>& drawingDeviation)> shape;
};

const std::vector<Kind>& kinds() {
  using namespace modeling;
  static const std::vector<Kind> table{
      {"sphere",
       {"--radius"},
       [](const Values& v, auto&) { return SphereShape{v.length("--radius", 25)}; }},
      {"ellipsoid",
       {"--radii"},
       [](const Values& v, auto&) {
         return EllipsoidShape{v.lengths("--radii", {30, 20, 15})};
       }},
      {"box",
       {"--size"},
       [](const Values& v, auto&) {
         return BoxShape{v.lengths("--size", {40, 30, 20})};
       }},
      {"cylinder",
       {"--radius", "--height"},
       [](const Values& v, auto&) {
         return CylinderShape{v.length("--radius", 20), v.length("--height", 60)};
       }},
      {"cone",
       {"--bottom-radius", "--top-radius", "--height"},
       [](const Values& v, auto&) {
         return ConeShape{v.length("--bottom-radius", 20), v.lengthOrZero("--top-radius", 10),
                          v.length("--height", 30)};
       }},
      {"capsule",
       {"--radius", "--length"},
       [](const Values& v, auto&) {
         return CapsuleShape{v.length("--radius", 10), v.length("--length", 30)};
       }},
      {"torus",
       {"--major-radius", "--minor-radius"},
       [](const Values& v, auto&) {
         return TorusShape{v.length("--major-radius", 25), v.length("--minor-radius", 8)};
       }},
      {"revolve",
       {"--profile", "--layer", "--curve", "--fit-tolerance", "--smooth-bends"},
       [](const Values& v, auto& deviation) {
         return RevolveShape{profileFrom(v, false, deviation)};
       }},
      {"extrude",
       {"--profile", "--layer", "--curve", "--fit-tolerance", "--smooth-bends", "--height"},
       [](const Values& v, auto& deviation) {
         return ExtrudeShape{profileFrom(v, true, deviation), v.length("--height", 20)};
       }},
      {"loft",
       {"--profile"},
       [](const Values& v, auto&) {
         const std::string file = v.file("--profile");
         if (isDrawingFile(file))
           throw UsageError("--profile: a loft needs a list of sections (JSON); " + file +
                            " is a drawing");
         return LoftShape{readSections(file)};
       }},
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

ShapeOptions::Result ShapeOptions::primitive(const std::string& shape) const {
  const Kind& kind = kindNamed(shape);
  for (const auto& [option, value] : values_) {
    const bool known =
        option == "--degree" || option == "--control-points" ||
        std::find(kind.options.begin(), kind.options.end(), option) != kind.options.end();
    if (!known && !value.empty()) throw UsageError(option + " has no meaning for: " + shape);
  }
  const Values values(shape, values_);
  Result result;
  result.primitive = {kind.shape(values, result.drawingDeviation),
                      values.wholeNumber("--degree", 3), values.wholeNumber("--control-points", 0)};
  return result;
}

}  // namespace palpa::cli

#include "app/cli/drawing_options.h"

#include <charconv>
#include <map>

#include "app/cli/errors.h"
#include "app/cli/suggestion.h"
#include "app/cli/values.h"
#include "app/core/results/touch.h"

namespace palpa::cli {
namespace {

/// Directions from the eye into the scene.
const std::map<std::string, Eigen::Vector3d> kViews{{"front", {0, 1, 0}}, {"back", {0, -1, 0}},
                                                    {"left", {1, 0, 0}},  {"right", {-1, 0, 0}},
                                                    {"top", {0, 0, -1}},  {"bottom", {0, 0, 1}}};

std::vector<std::string> fieldNames() {
  std::vector<std::string> names;
  for (const app::SurfaceQuantityInfo& info : app::kSurfaceQuantities) names.push_back(info.name);
  return names;
}

std::vector<std::string> viewNames() {
  std::vector<std::string> names;
  for (const auto& [name, direction] : kViews) names.push_back(name);
  return names;
}

view::PictureSize parseSize(const std::string& text) {
  view::PictureSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    const bool inRange =
        size.width >= 160 && size.width <= 8192 && size.height >= 120 && size.height <= 8192;
    if (height.ec == std::errc() && height.ptr == end && inRange) return size;
  }
  throw UsageError("--size: expected WIDTHxHEIGHT from 160x120 to 8192x8192, found '" + text + "'");
}

std::array<double, 2> parseRange(const std::string& text, app::SurfaceQuantity field) {
  const auto comma = text.find(',');
  if (comma == std::string::npos)
    throw UsageError("--range: expected LOW,HIGH, found '" + text + "'");
  const std::array<double, 2> range{parseNumber("--range", text.substr(0, comma)),
                                    parseNumber("--range", text.substr(comma + 1))};
  if (!(range[0] < range[1]))
    throw UsageError("--range: the first number must be less than the second, found '" + text +
                     "'");
  if (app::infoOf(field).isLogarithmic && !(range[0] > 0))
    throw UsageError("--range: the colours of --field stiffness begin above 0, found '" + text +
                     "'");
  return range;
}

}  // namespace

void DrawingOptions::declare(CLI::App& options) {
  options
      .add_option("--field", field_,
                  "Colours: displacement (default), normal-traction, von-mises, stiffness (under "
                  "a fingertip), stiffness-gradient (where added material makes a touch "
                  "stiffer), none")
      ->type_name("NAME");
  options
      .add_option("--fingertip", fingertip_,
                  "Radius of the fingertip of --field stiffness, mm (default: as for touches)")
      ->type_name("LENGTH");
  options.add_flag("--gradient", options_.showGradient,
                   "Arrows at the control points: pulled along them, they make a touch stiffer");
  options
      .add_option("--gradient-of", gradientOf_,
                  "Name of that touch, also of --field stiffness-gradient (default: the first)")
      ->type_name("TOUCH");
  options
      .add_option("--view", view_,
                  "Direction of view: front, back, left, right, top, bottom, or x,y,z from the "
                  "eye into the scene (default: so that the touches are seen)")
      ->type_name("NAME|X,Y,Z");
  section_.declare(options);
  options
      .add_option("--range", range_,
                  "Ends of the colours LOW,HIGH in the unit of the field (default: its values)")
      ->type_name("LOW,HIGH");
  options.add_flag("--extremes", options_.showExtremes,
                   "Mark the smallest and the largest value that is drawn");
  options.add_option("--size", size_, "Size of the picture in pixels (default 1200x900)")
      ->type_name("WxH");
  options.add_option("--scale", scale_, "Draw displacements this many times larger (default 1)")
      ->type_name("FACTOR");
  options.add_option("--zoom", zoom_, "Larger than 1: closer (default 1: everything is seen)")
      ->type_name("FACTOR");
  options.add_flag("--parallel", options_.parallel, "Parallel instead of perspective projection");
  options.add_flag("--mesh-edges", options_.showMeshEdges, "Draw the edges of the mesh");
  options.add_flag("--reactions", options_.showReactions, "Draw the supports' reactions");
  options.add_flag("--no-ghost", noGhost_, "Do not draw the undeformed shape");
}

bool DrawingOptions::needsGradient(const report::PictureOptions& options) {
  return options.showGradient || options.field == app::SurfaceQuantity::kStiffnessGradient;
}

double DrawingOptions::fingertip(const bem::BoundaryMesh& mesh) const {
  return fingertip_.empty() ? app::defaultTouchRadius(mesh)
                            : parsePositive("--fingertip", fingertip_);
}

view::PictureSize DrawingOptions::size() const {
  return size_.empty() ? view::PictureSize{} : parseSize(size_);
}

report::PictureOptions DrawingOptions::read(bool isReplay, bool isNode) const {
  report::PictureOptions options = options_;
  const auto field = app::surfaceQuantityNamed(field_);
  if (!field) {
    throw UsageError("--field: there is no field '" + field_ + "'" +
                     didYouMean(field_, fieldNames()) +
                     "; known are displacement, normal-traction, von-mises, stiffness, "
                     "stiffness-gradient, none");
  }
  options.field = *field;
  if (!fingertip_.empty()) {
    if (options.field != app::SurfaceQuantity::kStiffness)
      throw UsageError("--fingertip has a meaning with --field stiffness alone");
    parsePositive("--fingertip", fingertip_);
  }
  checkGradient(options, isReplay, isNode);
  options.section = section_.plane();
  options.showUndeformed = !noGhost_ && !options.section;
  if (!range_.empty()) options.range = parseRange(range_, options.field);
  if (!scale_.empty()) options.displacementScale = parseNumber("--scale", scale_);
  if (!zoom_.empty()) options.zoom = parsePositive("--zoom", zoom_);
  readView(options);
  return options;
}

void DrawingOptions::checkGradient(const report::PictureOptions& options, bool isReplay,
                                   bool isNode) const {
  if (!gradientOf_.empty() && !needsGradient(options))
    throw UsageError("--gradient-of has a meaning with --gradient or --field stiffness-gradient");
  if (needsGradient(options) && isReplay)
    throw UsageError(
        "--gradient and --field stiffness-gradient need touches at rest; leave out --recording");
  if (needsGradient(options) && isNode)
    throw UsageError("a single node has no gradient of its stiffness; touch a place with --at");
}

void DrawingOptions::readView(report::PictureOptions& options) const {
  if (const auto view = kViews.find(view_); view != kViews.end()) {
    options.viewDirection = view->second;
  } else if (!view_.empty() && view_.find(',') == std::string::npos) {
    throw UsageError("--view: there is no view '" + view_ + "'" + didYouMean(view_, viewNames()) +
                     "; known are front, back, left, right, top, bottom, or a direction x,y,z");
  } else if (!view_.empty()) {
    options.viewDirection = parseVector("--view", view_);
    if (options.viewDirection->norm() == 0) throw UsageError("--view: the direction is zero");
  }
}

}  // namespace palpa::cli

#include <algorithm>
#include <charconv>
#include <map>

#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/film.h"
#include "app/cli/output_option.h"
#include "app/cli/project_input.h"
#include "app/cli/replay_report.h"
#include "app/cli/section_options.h"
#include "app/cli/state_report.h"
#include "app/cli/suggestion.h"
#include "app/cli/text.h"
#include "app/cli/touch_options.h"
#include "app/cli/values.h"
#include "app/core/design/stiffness_gradient.h"
#include "app/core/live/stiffness_worker.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/touch.h"
#include "app/report/state_picture.h"
#include "app/view/files/display.h"
#include "modeling/error.h"

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

class RenderCommand : public Command {
 public:
  std::string name() const override { return "render"; }
  std::string summary() const override { return "Draw the deformed solid into a PNG file"; }
  std::string example() const override {
    return "palpa-cli render ball.json --at 25,0,0 --displace -4,0,0 -o ball.png\n"
           "  palpa-cli render projects/sphere.json -o sphere.png   (the recorded touches)\n"
           "  palpa-cli render ball.json --recording hand.json --frames pictures --fps 25\n"
           "Without a display:\n"
           "  xvfb-run -a -s \"-screen 0 1600x1000x24\" palpa-cli render ball.json -o ball.png";
  }

  void declare(CLI::App& options) override {
    input_.declare(options);
    touch_.declare(options);
    output_.declare(options, "Picture to write (.png)");
    options
        .add_option("--recording", recording_,
                    "Draw a replay of what was recorded: the state --at-time, or --frames")
        ->type_name("FILE");
    options.add_option("--at-time", atTime_, "Which moment of the recording, s")->type_name("TIME");
    options
        .add_option("--frames", frames_,
                    "Folder for pictures of the whole recording: frame_00000.png, …")
        ->type_name("FOLDER");
    options.add_option("--fps", rate_, "Pictures per second, 1 to 1000 (default 30)")
        ->type_name("RATE");
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

  void run(const Context& context) override {
    // Whatever can be wrong without solving is better known before it.
    touch_.validate();
    validateRecording();
    report::PictureOptions pictureOptions = readPictureOptions();
    const view::PictureSize size = size_.empty() ? view::PictureSize{} : parseSize(size_);
    const modeling::Project project = touch_.touched(input_.read(context));
    const bool hasGradient = needsGradient(pictureOptions);
    if (hasGradient) requireGradient(project);
    view::requireDisplay();

    const auto model = app::buildTouchModel(project, {}, context.job());
    if (pictureOptions.field == app::SurfaceQuantity::kStiffness) {
      const double radius = fingertip_.empty() ? app::defaultTouchRadius(model->setup().mesh())
                                               : parsePositive("--fingertip", fingertip_);
      pictureOptions.compliances = app::stiffnessMap(model, radius, context.job());
      context.progress.clear();
    }
    if (hasGradient) addGradient(project, *model, pictureOptions, context);
    if (!recording_.empty()) {
      drawRecording(project, model, pictureOptions, size, context);
      return;
    }
    const bool touched = touch_.isGiven() || !project.touches.empty();
    drawState(project, model, touched ? touch_.play(*model, project, context) : model->rest(),
              pictureOptions, size, context);
  }

 private:
  static bool needsGradient(const report::PictureOptions& options) {
    return options.showGradient || options.field == app::SurfaceQuantity::kStiffnessGradient;
  }

  /// Throws ModelingError if the project has no gradient or no such touch.
  void requireGradient(const modeling::Project& project) const {
    if (const std::string obstacle = app::gradientObstacle(project); !obstacle.empty())
      throw modeling::ModelingError(input_.file() + ": " + obstacle);
    std::vector<std::string> names;
    for (const modeling::Touch& touch : project.touches) names.push_back(touch.name);
    if (names.empty())
      throw modeling::ModelingError(input_.file() +
                                    ": the project has no touches, so there is no gradient of a "
                                    "stiffness; record one, or touch with --at");
    if (!gradientOf_.empty() && std::find(names.begin(), names.end(), gradientOf_) == names.end())
      throw UsageError("--gradient-of: there is no touch '" + gradientOf_ + "'" +
                       didYouMean(gradientOf_, names));
  }

  void addGradient(const modeling::Project& project, const app::TouchModel& model,
                   report::PictureOptions& options, const Context& context) const {
    const app::TouchState state = app::playTouches(model, project.touches, 0, context.job());
    const auto contact = std::find_if(
        state.contacts.begin(), state.contacts.end(),
        [this](const auto& each) { return gradientOf_.empty() || each.name == gradientOf_; });
    options.gradient = app::StiffnessGradients(project, model, context.job())
                           .of(app::stiffnessRuleOf(*contact), context.job());
    context.progress.clear();
  }

  void validateRecording() const {
    if (recording_.empty()) {
      if (!atTime_.empty() || !frames_.empty() || !rate_.empty())
        throw UsageError("--at-time, --frames and --fps need --recording");
      if (!output_.isGiven()) throw UsageError("give the picture's name with -o");
      return;
    }
    if (touch_.isGiven() || touch_.hasSteps())
      throw UsageError(
          "--recording says itself what is touched; leave out --at, --node and "
          "--steps");
    if (frames_.empty() == atTime_.empty())
      throw UsageError("--recording needs either --at-time or --frames");
    if (atTime_.empty() == output_.isGiven())
      throw UsageError(output_.isGiven() ? "--frames names its pictures itself; leave out -o"
                                         : "--at-time needs the picture's name with -o");
    if (!rate_.empty() && frames_.empty()) throw UsageError("--fps needs --frames");
    rate();
    if (!atTime_.empty() && parseNumber("--at-time", atTime_) < 0)
      throw UsageError("--at-time: expected a number from 0 on, found '" + atTime_ + "'");
  }

  double rate() const {
    if (rate_.empty()) return 30;
    const double rate = parseNumber("--fps", rate_);
    if (rate < 1 || rate > 1000)
      throw UsageError("--fps: expected a number from 1 to 1000, found '" + rate_ + "'");
    return rate;
  }

  void drawState(const modeling::Project& project,
                 const std::shared_ptr<const app::TouchModel>& model, const app::TouchState& state,
                 const report::PictureOptions& pictureOptions, const view::PictureSize& size,
                 const Context& context) const {
    view::writePicture(report::makePicture(project, model, state, pictureOptions), size,
                       output_.path());
    const StateReport report{*model, state, {}};
    Json json = report.json();
    std::string text = report.text();
    output_.addTo(json, text);
    context.print(json, text);
  }

  void drawRecording(const modeling::Project& project,
                     const std::shared_ptr<const app::TouchModel>& model,
                     const report::PictureOptions& pictureOptions, const view::PictureSize& size,
                     const Context& context) const {
    const app::RecordingFile file = app::readRecording(recording_);
    const ReplayReport report(file, app::recordedModelOf(*model, project.name));
    const Film film(project, model, file.recording, pictureOptions);
    if (!atTime_.empty()) {
      drawState(project, model, film.at(parseNumber("--at-time", atTime_), context), pictureOptions,
                size, context);
      return;
    }
    const int count = film.draw(frames_, rate(), size, context);
    Json json{
        {"folder", frames_}, {"frames", count}, {"fps", rate()}, {"warnings", report.warnings()}};
    std::string text;
    for (const std::string& warning : report.warnings()) text += "warning    " + warning + "\n";
    context.print(json, text + format("written    %d pictures in ", count) + frames_ + "\n");
  }

  report::PictureOptions readPictureOptions() const {
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
    if (!gradientOf_.empty() && !needsGradient(options))
      throw UsageError("--gradient-of has a meaning with --gradient or --field stiffness-gradient");
    if (needsGradient(options) && !recording_.empty())
      throw UsageError(
          "--gradient and --field stiffness-gradient need touches at rest; leave out --recording");
    if (needsGradient(options) && touch_.isNode())
      throw UsageError("a single node has no gradient of its stiffness; touch a place with --at");
    options.section = section_.plane();
    options.showUndeformed = !noGhost_ && !options.section;
    if (!range_.empty()) options.range = parseRange(range_, options.field);
    if (!scale_.empty()) options.displacementScale = parseNumber("--scale", scale_);
    if (!zoom_.empty()) options.zoom = parsePositive("--zoom", zoom_);
    if (const auto view = kViews.find(view_); view != kViews.end()) {
      options.viewDirection = view->second;
    } else if (!view_.empty() && view_.find(',') == std::string::npos) {
      throw UsageError("--view: there is no view '" + view_ + "'" + didYouMean(view_, viewNames()) +
                       "; known are front, back, left, right, top, bottom, or a direction x,y,z");
    } else if (!view_.empty()) {
      options.viewDirection = parseVector("--view", view_);
      if (options.viewDirection->norm() == 0) throw UsageError("--view: the direction is zero");
    }
    return options;
  }

  ProjectInput input_;
  TouchOptions touch_;
  report::PictureOptions options_;
  SectionOptions section_;
  std::string range_;
  OutputOption output_;
  std::string recording_;
  std::string atTime_;
  std::string frames_;
  std::string rate_;
  std::string field_ = "displacement";
  std::string fingertip_;
  std::string gradientOf_;
  std::string view_;
  std::string size_;
  std::string scale_;
  std::string zoom_;
  bool noGhost_ = false;
};

}  // namespace

std::unique_ptr<Command> makeRenderCommand() {
  return std::make_unique<RenderCommand>();
}

}  // namespace palpa::cli

#include <algorithm>

#include "app/cli/commands.h"
#include "app/cli/drawing_options.h"
#include "app/cli/errors.h"
#include "app/cli/film.h"
#include "app/cli/output_option.h"
#include "app/cli/project_input.h"
#include "app/cli/replay_report.h"
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
    drawing_.declare(options);
  }

  void run(const Context& context) override {
    // Whatever can be wrong without solving is better known before it.
    touch_.validate();
    validateRecording();
    report::PictureOptions pictureOptions = drawing_.read(!recording_.empty(), touch_.isNode());
    const view::PictureSize size = drawing_.size();
    const modeling::Project project = touch_.touched(input_.read(context));
    const bool hasGradient = DrawingOptions::needsGradient(pictureOptions);
    if (hasGradient) requireGradient(project);
    view::requireDisplay();

    const auto model = app::buildTouchModel(project, {}, context.job());
    if (pictureOptions.field == app::SurfaceQuantity::kStiffness) {
      pictureOptions.compliances =
          app::stiffnessMap(model, drawing_.fingertip(model->setup().mesh()), context.job());
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
    const std::string& wanted = drawing_.gradientOf();
    if (!wanted.empty() && std::find(names.begin(), names.end(), wanted) == names.end())
      throw UsageError("--gradient-of: there is no touch '" + wanted + "'" +
                       didYouMean(wanted, names));
  }

  void addGradient(const modeling::Project& project, const app::TouchModel& model,
                   report::PictureOptions& options, const Context& context) const {
    const app::TouchState state = app::playTouches(model, project.touches, 0, context.job());
    const auto contact = std::find_if(state.contacts.begin(), state.contacts.end(),
                                      [&wanted = drawing_.gradientOf()](const auto& each) {
                                        return wanted.empty() || each.name == wanted;
                                      });
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

  ProjectInput input_;
  TouchOptions touch_;
  DrawingOptions drawing_;
  OutputOption output_;
  std::string recording_;
  std::string atTime_;
  std::string frames_;
  std::string rate_;
};

}  // namespace

std::unique_ptr<Command> makeRenderCommand() {
  return std::make_unique<RenderCommand>();
}

}  // namespace palpa::cli

#include <chrono>
#include <optional>
#include <sstream>

#include "app/cli/commands.h"
#include "app/cli/deformed_file.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/project_input.h"
#include "app/cli/refinement_options.h"
#include "app/cli/replay_report.h"
#include "app/cli/result_file.h"
#include "app/cli/sample_options.h"
#include "app/cli/state_report.h"
#include "app/cli/sweep_report.h"
#include "app/cli/text.h"
#include "app/cli/touch_options.h"
#include "app/cli/values.h"
#include "app/core/live/touch_replay.h"
#include "app/core/live/touch_table.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/error_estimate.h"
#include "app/core/results/state_series.h"
#include "modeling/error.h"

namespace palpa::cli {
namespace {

class TouchCommand : public Command {
 public:
  std::string name() const override { return "touch"; }
  std::string summary() const override { return "Touch a project's solid and report the forces"; }
  std::string example() const override {
    return "palpa-cli touch ball.json --at 25,0,0 --displace -2,0,0\n"
           "  palpa-cli touch ball.json --at 25,0,0 --kind force --force -0.5,0,0 --radius 8\n"
           "  palpa-cli touch ball.json --at 0,0,25 --kind push --displace 3,0,-2 --friction 0.2\n"
           "  palpa-cli touch ball.json --at 0,0,25 --kind ball --displace 0,0,-2 --radius 10 "
           "--friction 0.5\n"
           "  palpa-cli touch ball.json --at 0,0,25 --displace 0,0,-2 --at 25,0,0 --kind pin\n"
           "    (two at once: the options of each follow its --at)\n"
           "  palpa-cli touch bracket.step --place auto --depth 1%   (opposite to the support)\n"
           "  palpa-cli touch bracket.step --place auto --force-error 2%   (refines the mesh "
           "for it)\n"
           "  palpa-cli touch projects/sphere.json   (plays the project's touches)\n"
           "  palpa-cli touch ball.json --at 0,0,25 --kind ball --displace 0,0,-2 --radius 6 "
           "--sweep 20 -o curve.csv\n"
           "  palpa-cli touch ball.json --recording hand.json -o forces.csv\n"
           "  palpa-cli touch ball.json --recording hand.json --fps 50 -o hand.pvd   (for "
           "ParaView)";
  }

  void declare(CLI::App& options) override {
    input_.declare(options);
    input_.declareModel(options);
    touch_.declare(options);
    refinement_.declare(options);
    samples_.declare(options);
    options
        .add_option("--recording", recording_,
                    "Replay what was recorded in the window (Simulate > Save recording) or by a "
                    "script, a thousand steps a second")
        ->type_name("FILE");
    options
        .add_option("--sweep", sweep_,
                    "Play the touches at N equal parts of their displacements and forces, too: a "
                    "force-depth curve, 1 to 1000 steps")
        ->type_name("N");
    output_.declare(
        options, resultFileHelp() +
                     "; .csv with --sweep (the curve) or --recording (the forces of every step); "
                     ".pvd with one of these (a series of meshes with fields, for ParaView)");
    options
        .add_option("--fps", rate_,
                    "Meshes per second of a --recording in a .pvd series, 1 to 1000 (default 30)")
        ->type_name("RATE");
    deformed_.declare(options);
  }

  void run(const Context& context) override {
    touch_.validate();
    refinement_.validate();
    // Its number is of another place on every mesh.
    if (refinement_.isGiven() && touch_.isNode())
      throw UsageError("--force-error has no meaning for a single node");
    samples_.validate();
    if (!recording_.empty()) {
      replay(context);
      return;
    }
    const int sweepSteps = sweep_.empty() ? 0 : parseSweep();
    if (!rate_.empty()) throw UsageError("--fps needs --recording");
    const bool isCurve = sweepSteps > 0 && isTableName();
    const bool isSeries = sweepSteps > 0 && isSeriesName();
    if (output_.isGiven() && !isCurve && !isSeries) requireResultFileName(output_.path());
    deformed_.validate();
    ReadBody read = input_.readWithNotes(context.job());
    if (!touch_.isGiven() && read.project.touches.empty()) {
      throw modeling::ModelingError(input_.file() +
                                    ": the project has no recorded touches; give one with --place "
                                    "auto, or with --at x,y,z --displace x,y,z");
    }
    modeling::Project project = touch_.touched(read.project);
    if (read.project.supports.empty() && !project.supports.empty())
      read.held = modeling::proposeSupport(project.body);
    double touchSeconds = 0;
    const auto play = [&](const app::TouchModel& of, const modeling::Project& touched,
                          const Job& job) {
      const auto start = std::chrono::steady_clock::now();
      app::TouchState state = touch_.play(of, touched, context, job);
      touchSeconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      app::addErrors(of, state, job);
      return state;
    };
    const app::ErrorGoal goal = refinement_.goal();
    app::RefinedTouch touched =
        app::refineTouch(project, goal, input_.buildOptions(), play, context.job());
    const auto model = touched.model;
    const app::TouchState& state = touched.state;
    project = touched.project;
    std::vector<app::SweepRow> rows;
    if (sweepSteps > 0) rows = touch_.sweep(*model, project, sweepSteps, context);
    if (isSeries) touch_.writeSeries(*model, rows, output_.path(), context);
    const StateReport report{*model, state, samples_.evaluate(*model, state), touchSeconds,
                             samples_.hasFormerName()};
    Json json = preparation(read, project);
    json.update(report.json());
    if (refinement_.isGiven()) json["refinement"] = refinementJson(touched, goal);
    if (sweepSteps > 0) json["sweep"] = sweepJson(rows);
    if (isCurve) {
      std::ostringstream table;
      app::writeSweep(rows, table);
      writeText(table.str(), output_.path());
    } else if (output_.isGiven() && !isSeries) {
      writeResult(*model, state, json, output_.path());
    }
    deformed_.write(project, *model, state, context);
    context.print(json, preparationText(read) +
                            (refinement_.isGiven() ? refinementText(touched, goal) : "") +
                            report.text() + sweepText(rows));
  }

 private:
  /// What the program chose: the body of a CAD or mesh file, the support, the place.
  Json preparation(const ReadBody& read, const modeling::Project& project) const {
    Json json;
    if (input_.isImported()) json["import"] = cli::toJson(read);
    if (read.held) json["proposed_support"] = cli::toJson(*read.held);
    if (touch_.isPlaced()) json["place"] = placeJson(project.touches.front());
    return json;
  }

  std::string preparationText(const ReadBody& read) const {
    std::string text;
    if (input_.isImported()) text += cli::toText(read);
    if (read.held)
      text +=
          "held on    " + read.held->description() + " (proposed, as the file has no support)\n";
    return text;
  }

  static Json placeJson(const modeling::Touch& touch) {
    Json json{{"at_mm", cli::toJson(touch.at)}, {"radius_mm", *touch.radius}};
    const double depth = touch.vector.norm();
    if (modeling::infoOf(touch.kind).isForce || depth == 0) return json;
    json["direction"] = cli::toJson(Eigen::Vector3d(touch.vector / depth));
    json["depth_mm"] = depth;
    return json;
  }

  bool isTableName() const { return output_.ending() == ".csv"; }
  bool isSeriesName() const { return output_.ending() == ".pvd"; }

  double parseRate() const {
    using Series = app::ReplaySeries;
    if (rate_.empty()) return Series::kUsualRate;
    const double rate = parseNumber("--fps", rate_);
    if (rate < Series::kMinRate || rate > Series::kMaxRate)
      throw UsageError("--fps: expected a number from 1 to 1000, found '" + rate_ + "'");
    return rate;
  }

  int parseSweep() const {
    if (touch_.isNode()) throw UsageError("--sweep has no meaning for a single node");
    return parseCount("--sweep", sweep_, app::kMaxSweepSteps);
  }

  void replay(const Context& context) {
    if (touch_.isGiven() || touch_.hasSteps() || samples_.isGiven() || !sweep_.empty() ||
        refinement_.isGiven())
      throw UsageError(
          "--recording says itself what is touched; leave out --at, --node, --steps, --sweep, "
          "--sample and --force-error");
    const bool isTable = isTableName(), isSeries = isSeriesName();
    if (output_.isGiven() && !isTable && !isSeries && output_.ending() != ".json")
      throw UsageError(
          "-o: with --recording expected a name that ends in .csv, .pvd or .json, found '" +
          output_.path() + "'");
    if (!rate_.empty() && !isSeries) throw UsageError("--fps needs a series: -o NAME.pvd");
    const double rate = parseRate();
    const app::RecordingFile file = app::readRecording(recording_);
    const modeling::Project project = input_.read(context);
    const auto model = app::buildTouchModel(project, input_.buildOptions(), context.job());
    ReplayReport report(file, app::recordedModelOf(*model, project.name));
    std::ostringstream text;
    app::TouchTable table(text);
    const auto body = std::make_shared<const app::TouchableModel>(model);
    std::optional<app::ReplaySeries> series;
    if (isSeries) series.emplace(body, rate, output_.path());
    std::uint64_t step = 0;
    app::replay(body, file.recording, context.job(), [&](const app::TouchSnapshot& snapshot) {
      if (isTable) table.add(snapshot, step);
      if (series) series->add(snapshot, step);
      report.add(snapshot, step++);
    });
    context.progress.clear();
    Json json = report.json();
    std::string words = report.text();
    if (series) {
      series->commit();
      json["meshes"] = series->size();
      words += format("written    %zu meshes to ", series->size()) + output_.path() + "\n";
    } else if (output_.isGiven()) {
      writeText(isTable ? text.str() : jsonText(json), output_.path());
    }
    context.print(json, words);
  }

  ProjectInput input_;
  TouchOptions touch_;
  RefinementOptions refinement_;
  SampleOptions samples_;
  std::string recording_;
  std::string sweep_;
  std::string rate_;
  OutputOption output_;
  DeformedFile deformed_;
};

}  // namespace

std::unique_ptr<Command> makeTouchCommand() {
  return std::make_unique<TouchCommand>();
}

}  // namespace palpa::cli

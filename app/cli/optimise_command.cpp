#include "app/cli/commands.h"
#include "app/cli/design_options.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/project_input.h"
#include "app/cli/text.h"
#include "app/core/design/shape_search.h"
#include "modeling/project/project_file.h"

namespace palpa::cli {
namespace {

using modeling::DesignTarget;

const char* unitOf(const DesignTarget& target) {
  return target.kind == DesignTarget::Kind::kForce ? "N" : "N/mm";
}

Json targetJson(const DesignTarget& target, double before, double after) {
  const bool isForce = target.kind == DesignTarget::Kind::kForce;
  const std::string unit = isForce ? "_N" : "_N_per_mm";
  Json json{{"touch", target.touch}, {"kind", isForce ? "force" : "stiffness"}};
  if (target.depth) json["depth_mm"] = *target.depth;
  json["wanted" + unit] = target.value;
  json["before" + unit] = before;
  json["after" + unit] = after;
  json["relative_error"] = after / target.value - 1;
  return json;
}

Json stepJson(const app::ShapeStep& step) {
  Json json{{"step", step.number}, {"accepted", step.isAccepted}};
  if (!step.problem.empty()) {
    json["problem"] = step.problem;
    return json;
  }
  json["values"] = step.values;
  json["volume_mm3"] = step.volume;
  if (step.thinnest) json["smallest_thickness_mm"] = *step.thinnest;
  json["largest_movement_mm"] = step.largestMovement;
  return json;
}

std::string stepText(const app::ShapeStep& step, const std::vector<DesignTarget>& targets) {
  std::string text = format("step %2d    ", step.number);
  if (!step.problem.empty()) return text + "refused: " + step.problem + "\n";
  for (std::size_t i = 0; i < targets.size(); ++i)
    text += (i > 0 ? ", " : "") + format("%.5g %s", step.values[i], unitOf(targets[i]));
  text += format("; volume %.5g mm³", step.volume);
  if (step.thinnest) text += format(", thinnest %.3g mm", *step.thinnest);
  text += format(", moved up to %.3g mm", step.largestMovement);
  return text + (step.isAccepted ? "\n" : " (taken back)\n");
}

class OptimiseCommand : public Command {
 public:
  std::string name() const override { return "optimise"; }
  std::string summary() const override {
    return "Find a shape with the stiffnesses or forces that touches should have";
  }
  std::string example() const override {
    return "palpa-cli optimise projects/box.json --target \"press the top=1.25\" -o stiffer.json\n"
           "  palpa-cli optimise ball.json --target \"poke=2N@1.5mm\" --move top --mirror x "
           "--largest-movement 3 -o ball-2n.json\n"
           "  palpa-cli optimise projects/design/two-stiffness-pad.json -o pad.json   (targets of "
           "the project)";
  }

  void declare(CLI::App& options) override {
    input_.declare(options);
    design_.declare(options);
    output_.declare(options,
                    "Project to write if the targets are reached; the design is stored in it");
    options.add_flag("--nearest", writesNearest_,
                     "With -o: also write the nearest shape if the targets are not reached");
  }

  void run(const Context& context) override {
    if (writesNearest_ && !output_.isGiven()) throw UsageError("--nearest needs -o FILE");
    const modeling::Project project = input_.read(context);
    const modeling::Design design = design_.design(project);
    const app::ShapeResult result = app::findShape(project, design, {}, context.job());
    Json json = reportJson(design, result);
    std::string text = reportText(design, result);
    context.progress.clear();
    if (output_.isGiven() && (result.isReached || writesNearest_)) {
      modeling::Project found = result.project;
      found.design = design;
      modeling::writeProject(found, output_.path());
      output_.addTo(json, text);
    }
    context.print(json, text);
    if (!result.isReached)
      throw ReportedFailure(
          "the targets cannot be reached; limited by " + result.limits.front().text,
          kCannotBeSolved);
  }

 private:
  static Json reportJson(const modeling::Design& design, const app::ShapeResult& result) {
    Json json{{"reached", result.isReached}, {"targets", Json::array()}, {"limits", Json::array()}};
    const app::ShapeStep &first = result.steps.front(), &last = result.final;
    for (std::size_t i = 0; i < design.targets.size(); ++i)
      json["targets"].push_back(targetJson(design.targets[i], first.values[i], last.values[i]));
    for (const app::ShapeLimit& limit : result.limits)
      json["limits"].push_back({{"kind", app::nameOf(limit.kind)}, {"text", limit.text}});
    json["moved_points"] = result.movedPoints;
    json["largest_movement_mm"] = last.largestMovement;
    json["volume_before_mm3"] = first.volume;
    json["volume_mm3"] = last.volume;
    if (last.thinnest) {
      json["smallest_thickness_before_mm"] = *first.thinnest;
      json["smallest_thickness_mm"] = *last.thinnest;
    }
    json["steps"] = Json::array();
    for (const app::ShapeStep& step : result.steps) json["steps"].push_back(stepJson(step));
    return json;
  }

  static std::string reportText(const modeling::Design& design, const app::ShapeResult& result) {
    std::string text;
    for (const app::ShapeStep& step : result.steps) text += stepText(step, design.targets);
    const app::ShapeStep &first = result.steps.front(), &last = result.final;
    for (std::size_t i = 0; i < design.targets.size(); ++i) {
      const DesignTarget& target = design.targets[i];
      text += format("target     %s: %.5g %s", target.touch.c_str(), target.value, unitOf(target));
      if (target.depth) text += format(" at %.4g mm", *target.depth);
      text += format(", found %.5g %s (%+.2f %%), before %.5g %s\n", last.values[i], unitOf(target),
                     100 * (last.values[i] / target.value - 1), first.values[i], unitOf(target));
    }
    text += format("shape      %d control points moved, up to %.4g mm\n", result.movedPoints,
                   last.largestMovement) +
            format("volume     %.6g mm³, before %.6g mm³ (%+.2f %%)\n", last.volume, first.volume,
                   100 * (last.volume / first.volume - 1));
    if (last.thinnest)
      text += format("thinnest   %.4g mm, before %.4g mm\n", *last.thinnest, *first.thinnest);
    for (const app::ShapeLimit& limit : result.limits) text += "limit      " + limit.text + "\n";
    return text + (result.isReached ? "reached    all targets\n"
                                    : "reached    not all targets: this is the nearest shape\n");
  }

  ProjectInput input_;
  DesignOptions design_;
  OutputOption output_;
  bool writesNearest_ = false;
};

}  // namespace

std::unique_ptr<Command> makeOptimiseCommand() {
  return std::make_unique<OptimiseCommand>();
}

}  // namespace palpa::cli

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/text.h"
#include "app/cli/verify_report.h"
#include "app/verification/convergence.h"
#include "app/view/charts/convergence_plot.h"
#include "app/view/files/display.h"
#include "app/view/files/errors.h"

namespace palpa::cli {
namespace {

using verification::ReferenceData;
using verification::Result;
using verification::Task;

/// Contents of the plot: the series of each engine.
std::vector<view::ErrorCurve> curvesOf(const std::vector<Result>& results) {
  std::vector<view::ErrorCurve> curves;
  for (const Result& result : results) {
    if (result.steps.empty()) continue;
    const bool isTriangles = result.engine == nameOf(verification::Engine::kTriangles);
    view::ErrorCurve curve{
        isTriangles ? "triangles" : "cubic splines", {}, {}, {}, isTriangles ? 2 : 4};
    for (const verification::ConvergenceStep& step : result.steps) {
      curve.coefficients.push_back(step.coefficients);
      curve.sizes.push_back(step.size);
      curve.errors.push_back(step.error);
    }
    // Colours as in docs/convergence.md.
    curves.insert(isTriangles ? curves.end() : curves.begin(), curve);
  }
  return curves;
}

class VerifyCommand : public Command {
 public:
  std::string name() const override { return "verify"; }
  std::string summary() const override {
    return "Check the engines against exact and finite element solutions";
  }
  std::string example() const override {
    return "palpa-cli verify --quick\n"
           "  palpa-cli verify --engine splines --case kelvin_exterior_sphere a_cyl_side\n"
           "  palpa-cli verify --all --plot convergence.png";
  }

  void declare(CLI::App& options) override {
    options
        .add_option("--engine", engine_,
                    "splines, triangles, quadratic (six-node triangles) or all")
        ->check(CLI::IsMember({"splines", "triangles", "quadratic", "both", "all"}).description(""))
        ->type_name("NAME");
    options
        .add_option("--case", names_,
                    "Run only these cases, or families of cases that differ in their material")
        ->type_name("NAME");
    options.add_flag("--quick", isQuick_,
                     "A few cases with one material each, in a fraction of the time");
    options.add_flag("--all", showsAll_, "Show every quantity, not only the nearest to its bound");
    options.add_option("--plot", plot_, "Draw the series of refinements into a PNG file")
        ->type_name("FILE");
    options
        .add_option("--reference", reference_,
                    "Folder with other reference data: analytic.json and fem.json")
        ->type_name("FOLDER");
  }

  void run(const Context& context) override {
    if (!plot_.empty() && std::filesystem::path(plot_).extension() != ".png")
      throw UsageError("--plot: expected a name that ends in .png, found '" + plot_ + "'");
    const auto has = [this](const char* name) { return engine_ == "all" || engine_ == name; };
    // "both" is the spelling of versions with two engines.
    const bool isBoth = engine_ == "both";
    const verification::Plan plan = makePlan(
        reference_.empty() ? ReferenceData::builtIn() : ReferenceData::read(reference_),
        {has("triangles") || isBoth, has("splines") || isBoth, has("quadratic"), names_, isQuick_});
    checkPlan(plan);
    std::string noPlot = reasonForNoPlot();
    if (!noPlot.empty()) std::cerr << "palpa-cli: no plot will be drawn: " << noPlot << '\n';

    VerifyReport report(plan.omitted);
    for (std::size_t k = 0; k < plan.tasks.size(); ++k) {
      const Task& task = plan.tasks[k];
      const double done = static_cast<double>(k) / static_cast<double>(plan.tasks.size());
      const std::string what = task.name + " (" + task.engine + ")";
      context.progress.show(what, done);
      Job job = context.job();
      job.throwIfCancelled();
      job.progress = [&](Phase phase, double) {
        context.progress.show(what + ": " + std::string(nameOf(phase)), done);
      };
      report.add(task.run(job));
    }
    context.progress.clear();
    context.print(report.json(), report.text(showsAll_));
    if (!plot_.empty() && noPlot.empty()) noPlot = draw(report.results());
    if (report.failures() > 0)
      throw ReportedFailure(
          format("%d of the numbers are not within their tolerances", report.failures()),
          kCannotBeSolved);
    if (!noPlot.empty()) throw ReportedFailure("no plot was drawn: " + noPlot);
  }

 private:
  void checkPlan(const verification::Plan& plan) const {
    const auto isSolution = [](const Task& task) { return task.engine != "-"; };
    if (std::none_of(plan.tasks.begin(), plan.tasks.end(), isSolution))
      throw UsageError("there is nothing to run: " + plan.omitted.at(0).reason);
    const auto isSeries = [](const Task& task) {
      return task.name == verification::kConvergenceName;
    };
    if (!plot_.empty() && std::none_of(plan.tasks.begin(), plan.tasks.end(), isSeries))
      throw UsageError(std::string("--plot draws the case ") + verification::kConvergenceName +
                       ", which --case leaves out");
  }

  /// Checked before the long work, which runs without a plot, too.
  std::string reasonForNoPlot() const {
    if (plot_.empty()) return {};
    try {
      view::requireDisplay();
      return {};
    } catch (const view::NoDisplayError& error) {
      return error.what();
    }
  }

  /// Reason why the plot could not be drawn; empty if it was drawn.
  std::string draw(const std::vector<Result>& results) const {
    try {
      view::drawConvergence(curvesOf(results), plot_);
      return {};
    } catch (const view::ViewError& error) {
      return error.what();
    }
  }

  std::string engine_ = "all";
  std::vector<std::string> names_;
  bool isQuick_ = false, showsAll_ = false;
  std::string plot_;
  std::string reference_;
};

}  // namespace

std::unique_ptr<Command> makeVerifyCommand() {
  return std::make_unique<VerifyCommand>();
}

}  // namespace palpa::cli

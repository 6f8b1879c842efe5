#include <array>
#include <optional>
#include <sstream>

#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/result_file.h"
#include "app/cli/text.h"
#include "app/cli/touch_options.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/comparison.h"
#include "app/core/results/error_estimate.h"
#include "app/core/results/surface_correspondence.h"
#include "app/report/comparison_report.h"
#include "app/view/files/display.h"
#include "base/atomic_file.h"
#include "bem/base/error.h"
#include "modeling/error.h"
#include "modeling/project/project_file.h"

namespace palpa::cli {
namespace {

constexpr std::array kLetters{"A", "B"};

using Report = report::ComparedVariants;

std::shared_ptr<const app::TouchModel> build(const modeling::Project& project,
                                             const std::string& file, const Context& context) {
  // Messages of the solver name no file, and here there are two.
  try {
    return app::buildTouchModel(project, {}, context.job());
  } catch (const bem::SolverError& error) {
    throw bem::SolverError(error.kind(), file + ": " + error.what());
  } catch (const modeling::ModelingError& error) {
    throw modeling::ModelingError(file + ": " + error.what(), error.kind());
  }
}

Json toJson(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

Json toJson(const Report& of) {
  Json report;
  for (std::size_t k = 0; k < 2; ++k)
    report[k == 0 ? "a" : "b"] = {
        {"file", of.files[k]},
        {"error_estimate", toJson(of.comparison.states[k].state.errorEstimate)}};
  report["touches"] = Json::array();
  for (std::size_t k = 0; k < of.comparison.touches.size(); ++k) {
    const app::CarriedTouch& carried = of.comparison.carried[k];
    report["touches"].push_back({{"name", of.comparison.touches[k].name},
                                 {"kind", modeling::infoOf(of.comparison.touches[k].kind).name},
                                 {"at_a_mm", cli::toJson(of.comparison.touches[k].at)},
                                 {"at_b_mm", cli::toJson(carried.touch.at)},
                                 {"carried_mm", carried.distance},
                                 {"turned", carried.isTurned}});
  }
  report["rows"] = Json::array();
  for (const app::ComparisonRow& row : of.comparison.rows())
    report["rows"].push_back({{"part", app::nameOf(row.part)},
                              {"name", row.name},
                              {"figure", app::infoOf(row.figure).name},
                              {"a", toJson(row.values[0])},
                              {"b", toJson(row.values[1])},
                              {"difference", toJson(row.difference())},
                              {"relative_difference", toJson(row.relativeDifference())},
                              {"relative_error_a", toJson(row.errors[0])},
                              {"relative_error_b", toJson(row.errors[1])},
                              {"within_errors", row.isWithinErrors()}});
  report["corresponding_share"] = of.share;
  report["corresponding_reach_mm"] = of.reach;
  return report;
}

std::string number(const std::optional<double>& value) {
  return value ? format("%.4g", *value) : std::string("-");
}

std::string rowText(const app::ComparisonRow& row) {
  const app::ComparedFigureInfo& info = app::infoOf(row.figure);
  const std::string label = std::string(info.label) + ", " + info.unit;
  const auto relative = row.relativeDifference();
  std::string text =
      format("           %-30s %10s %10s %10s %9s", label.c_str(), number(row.values[0]).c_str(),
             number(row.values[1]).c_str(), number(row.difference()).c_str(),
             relative ? format("%+.1f %%", 100 * *relative).c_str() : "");
  if (row.difference() != 0 && row.isWithinErrors()) text += "  within the estimated errors";
  return text + "\n";
}

std::string toText(const Report& of) {
  std::string text;
  for (std::size_t k = 0; k < 2; ++k) {
    text += format("%-10s %s", kLetters[k], of.files[k].c_str());
    const auto& error = of.comparison.states[k].state.errorEstimate;
    if (error && *error > 0)
      text += format(": displacements and forces good to about %.2g %% (estimated)", 100 * *error);
    text += "\n";
  }
  for (const app::CarriedTouch& carried : of.comparison.carried) {
    if (carried.distance < 1e-6 && !carried.isTurned) continue;
    text += format("carried    %s: the nearest surface point of B is %.3g mm away",
                   carried.touch.name.c_str(), carried.distance);
    text += carried.isTurned ? ", on a side that faces away\n" : "\n";
  }
  text += format("%-10s %-30s %10s %10s %10s %9s\n", "", "", "A", "B", "B - A", "B/A - 1");
  std::string part;
  for (const app::ComparisonRow& row : of.comparison.rows()) {
    const std::string now = app::nameOf(row.part) + (row.name.empty() ? "" : " " + row.name);
    if (now != part) text += now + "\n";
    part = now;
    text += rowText(row);
  }
  return text + format("surfaces   %.0f %% of A's surface has a point of B within %.3g mm\n",
                       100 * of.share, of.reach);
}

class CompareCommand : public Command {
 public:
  std::string name() const override { return "compare"; }
  std::string summary() const override {
    return "Compare two variants of a project under the same touches";
  }
  std::string example() const override {
    return "palpa-cli compare ball.json thicker.json --at 0,0,25 --displace 0,0,-2\n"
           "  palpa-cli compare a.json b.json   (plays the touches of A's project on both)\n"
           "  palpa-cli compare a.json b.json -o comparison.csv\n"
           "  palpa-cli compare a.json b.json -o comparison.html   (with pictures)";
  }

  void declare(CLI::App& options) override {
    for (std::size_t k = 0; k < 2; ++k)
      options
          .add_option(kLetters[k], files_[k],
                      std::string("Project file of variant ") + kLetters[k] + " (JSON)")
          ->required()
          ->type_name("");
    touch_.declare(options);
    output_.declare(
        options,
        "File to write: .csv (the table), .json (the report), .png (both variants side by "
        "side, with common colours), .html (pictures and tables)");
  }

  void run(const Context& context) override {
    touch_.validate();
    if (touch_.isNode() || touch_.hasSteps())
      throw UsageError("--node and --steps have no meaning for a comparison");
    requireKnownEnding();
    const std::string ending = output_.ending();
    const bool isDrawn = ending == ".png" || ending == ".html";
    std::optional<AtomicFile> file;
    if (isDrawn) {
      // Before the long work: whether it can be drawn and written.
      view::requireDisplay();
      file.emplace(output_.path());
    }
    const Report report = compare(context);
    const Json json = toJson(report);
    if (isDrawn) {
      file->write(ending == ".png" ? picture(report) : document(report));
      file->commit();
    } else if (ending == ".csv") {
      std::ostringstream table;
      app::writeComparison(report.comparison.rows(), table);
      writeText(table.str(), output_.path());
    } else if (output_.isGiven()) {
      writeText(jsonText(json), output_.path());
    }
    context.print(json, toText(report));
  }

 private:
  void requireKnownEnding() const {
    if (!output_.isGiven()) return;
    for (const char* known : {".csv", ".json", ".png", ".html"})
      if (output_.ending() == known) return;
    throw UsageError("-o: expected a name that ends in .csv, .json, .png or .html, found '" +
                     output_.path() + "'");
  }

  static std::string picture(const Report& of) {
    return view::pictureBytes(report::comparisonPictures(of), report::kComparedPictureSize);
  }

  static std::string document(const Report& of) {
    const std::array<view::Picture, 2> pictures = report::comparisonPictures(of);
    std::array<std::string, 2> files;
    for (std::size_t k = 0; k < 2; ++k)
      files[k] = view::pictureBytes(pictures[k], report::kComparedPictureSize);
    return report::comparisonDocument(of, {{}, PALPA_VERSION, report::dateNow()}, files);
  }

  Report compare(const Context& context) const {
    std::array projects{touch_.touched(modeling::readProject(files_[0])),
                        modeling::readProject(files_[1])};
    // The elements of both follow the same touches.
    projects[1].touches = projects[0].touches;
    std::array<std::optional<app::VariantPlayer>, 2> players;
    for (std::size_t k = 0; k < 2; ++k)
      players[k].emplace(app::Variant{files_[k], build(projects[k], files_[k], context),
                                      projects[k].material.densityKgPerM3},
                         modeling::DisplaySettings{1, 1}, context.job());
    auto& [a, b] = players;
    Report report{files_,
                  projects,
                  {a->variant().model, b->variant().model},
                  app::compareVariants(*a, *b, projects[0].touches, context.job())};
    app::estimateErrors(*a, *b, report.comparison, context.job());
    const app::SurfaceCorrespondence surfaces(*a->drawn(), *b->drawn(), context.job());
    context.progress.clear();
    report.share = surfaces.share();
    report.reach = surfaces.reach();
    return report;
  }

  std::array<std::string, 2> files_;
  TouchOptions touch_;
  OutputOption output_;
};

}  // namespace

std::unique_ptr<Command> makeCompareCommand() {
  return std::make_unique<CompareCommand>();
}

}  // namespace palpa::cli

#include <filesystem>

#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/project_input.h"
#include "app/cli/state_report.h"
#include "app/cli/text.h"
#include "app/cli/touch_options.h"
#include "app/core/results/touch_study.h"
#include "app/report/touch_report.h"
#include "app/view/files/display.h"
#include "base/atomic_file.h"
#include "modeling/error.h"
#include "modeling/project/proposed_support.h"

namespace palpa::cli {
namespace {

class ReportCommand : public Command {
 public:
  std::string name() const override { return "report"; }
  std::string summary() const override {
    return "Write a report of a project's touches with pictures, tables and errors";
  }
  std::string example() const override {
    return "palpa-cli report projects/box.json -o box.html\n"
           "  palpa-cli report ball.json --at 0,0,25 --kind ball --displace 0,0,-2 --radius 6 -o "
           "ball.html\n"
           "Without a display:\n"
           "  xvfb-run -a -s \"-screen 0 1600x1000x24\" palpa-cli report projects/box.json -o "
           "box.html";
  }

  void declare(CLI::App& options) override {
    input_.declare(options);
    touch_.declare(options);
    output_.declare(options, "Report to write (.html)")->required();
  }

  void run(const Context& context) override {
    touch_.validate();
    if (touch_.isNode() || touch_.hasSteps())
      throw UsageError("--node and --steps have no meaning for a report");
    requireHtml();
    ReadBody read = input_.readWithNotes(context.job());
    const modeling::Project project = touch_.touched(read.project);
    if (read.project.supports.empty() && !project.supports.empty())
      read.held = modeling::proposeSupport(project.body);
    if (!report::isReportable(project))
      throw modeling::ModelingError(
          input_.file() +
          ": there is nothing to report, as the project has no touches and no loads; give a touch "
          "with --place auto, or with --at x,y,z --displace x,y,z");
    // Before the long work: whether the pictures can be drawn and the file can be written.
    view::requireDisplay();
    AtomicFile file(output_.path());

    const app::TouchStudy study = app::makeTouchStudy(project, nullptr, context.job());
    const std::vector<report::ReportPicture> pictures = report::reportPictures(study);
    std::vector<std::string> files;
    for (const report::ReportPicture& each : pictures) {
      context.job().throwIfCancelled();
      context.progress.show(
          "draw", static_cast<double>(files.size()) / static_cast<double>(pictures.size()));
      files.push_back(view::pictureBytes(each.picture, report::kReportPictureSize));
    }
    context.progress.clear();
    const std::string html = report::reportDocument(study, sourceOf(read), pictures, files);
    file.write(html);
    context.job().throwIfCancelled();
    file.commit();
    print(study, static_cast<double>(html.size()), context);
  }

 private:
  void requireHtml() const {
    if (output_.ending() == ".html") return;
    if (output_.ending() == ".pdf")
      throw UsageError(
          "-o: palpa-cli writes reports as .html; for a PDF, print the .html file in a browser, or "
          "use File > Export report in the window");
    throw UsageError("-o: expected a name that ends in .html, found '" + output_.path() + "'");
  }

  report::ReportSource sourceOf(const ReadBody& read) const {
    // The name alone: a report is passed on, and folders are private.
    report::ReportSource source{std::filesystem::path(input_.file()).filename().string(),
                                PALPA_VERSION, report::dateNow()};
    if (input_.isImported()) source.notes = read.notes;
    if (read.held)
      source.notes.push_back("The file has no support; one was proposed on " +
                             read.held->description() + ".");
    return source;
  }

  /// The reports of `solve` and `touch` on the states.
  void print(const app::TouchStudy& study, double bytes, const Context& context) const {
    const app::TouchModel& model = *study.model;
    Json json{{"file", output_.path()},
              {"bytes", bytes},
              {"rest", StateReport{model, study.rest, {}}.json()}};
    std::string text;
    if (!study.project.touches.empty()) {
      const StateReport together{model, study.together, {}};
      json["together"] = together.json();
      text = together.text();
    } else {
      text = StateReport{model, study.rest, {}}.text();
    }
    json["alone"] = Json::array();
    for (const app::TouchStudy::Single& each : study.alone) {
      Json alone{{"touch", study.project.touches[each.touch].name}};
      alone.update(StateReport{model, each.state, {}}.json());
      json["alone"].push_back(std::move(alone));
    }
    context.print(json,
                  text + format("written    %.1f MB to ", bytes / 1e6) + output_.path() + "\n");
  }

  ProjectInput input_;
  TouchOptions touch_;
  OutputOption output_;
};

}  // namespace

std::unique_ptr<Command> makeReportCommand() {
  return std::make_unique<ReportCommand>();
}

}  // namespace palpa::cli

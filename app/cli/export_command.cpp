#include "app/cli/body_file.h"
#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/page_options.h"
#include "app/cli/project_input.h"
#include "app/core/page/touch_page_file.h"
#include "base/atomic_file.h"
#include "modeling/exchange/file_format.h"

namespace palpa::cli {
namespace {

class ExportCommand : public Command {
 public:
  std::string name() const override { return "export"; }
  std::string summary() const override {
    return "Write a project's body to a CAD or mesh file, or a page to touch it in a browser";
  }
  std::string example() const override {
    return "palpa-cli export ball.json -o ball.step\n"
           "  palpa-cli export ball.json -o touch.html --places 200 --page-size 12";
  }

  void declare(CLI::App& options) override {
    input_.declare(options);
    output_
        .declare(options, "File to write: " + modeling::endingsText(modeling::isCad) +
                              " (the solid), " + modeling::endingsText(modeling::isWritableMesh) +
                              " (its mesh), " + modeling::endingsText(modeling::isPage) +
                              " (a page to touch the body)")
        ->required();
    page_.declare(options);
  }

  void run(const Context& context) override {
    const auto format = modeling::fileFormatOf(output_.path());
    if (format == modeling::FileFormat::kProject)
      throw UsageError(
          "export: --output must be a CAD or mesh file or a page; palpa-cli convert copies "
          "projects");
    modeling::requireFormat(output_.path(), modeling::isExported);
    const bool isPage = format == modeling::FileFormat::kPage;
    if (page_.isGiven() && !isPage)
      throw UsageError("--places, --page-size and --radius are for pages: name the file .html");
    const app::TouchPageSettings settings = page_.settings();
    const ReadBody read = input_.readWithNotes(context.job());
    Json report{{"file", output_.path()}};
    report.update(toJson(read));
    std::string text = output_.path() + ": written from " + input_.file() + "\n" + toText(read);
    if (isPage) {
      const app::TouchPage page =
          app::makeTouchPage(read.project, PALPA_VERSION, settings, context.job());
      const std::string html = app::touchPageText(page);
      replaceFile(html, output_.path());
      report["page"] = toJson(page, static_cast<double>(html.size()));
      text += toText(page, static_cast<double>(html.size()));
    } else {
      writeBody(read.project, output_.path(), input_.hasEdgeLength(), context.job());
    }
    context.progress.clear();
    context.print(report, text);
  }

 private:
  ProjectInput input_;
  OutputOption output_;
  PageOptions page_;
};

}  // namespace

std::unique_ptr<Command> makeExportCommand() {
  return std::make_unique<ExportCommand>();
}

}  // namespace palpa::cli

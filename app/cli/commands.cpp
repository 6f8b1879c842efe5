#include "app/cli/commands.h"

namespace palpa::cli {

std::vector<std::unique_ptr<Command>> allCommands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(makeNewCommand());
  commands.push_back(makeMaterialsCommand());
  commands.push_back(makeInfoCommand());
  commands.push_back(makeCheckCommand());
  commands.push_back(makeMeasureCommand());
  commands.push_back(makeEditCommand());
  commands.push_back(makeMeshCommand());
  commands.push_back(makeSolveCommand());
  commands.push_back(makeTouchCommand());
  commands.push_back(makeGradientCommand());
  commands.push_back(makeOptimiseCommand());
  commands.push_back(makeCompareCommand());
  commands.push_back(makeSectionCommand());
  commands.push_back(makeRenderCommand());
  commands.push_back(makeReportCommand());
  commands.push_back(makeImportCommand());
  commands.push_back(makeExportCommand());
  commands.push_back(makeConvertCommand());
  commands.push_back(makeServeCommand());
  commands.push_back(makeVerifyCommand());
  return commands;
}

}  // namespace palpa::cli

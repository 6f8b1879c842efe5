#pragma once

#include <memory>

#include "app/cli/command.h"

namespace palpa::cli {

std::unique_ptr<Command> makeNewCommand();
std::unique_ptr<Command> makeMaterialsCommand();
std::unique_ptr<Command> makeInfoCommand();
std::unique_ptr<Command> makeCheckCommand();
std::unique_ptr<Command> makeMeasureCommand();
std::unique_ptr<Command> makeEditCommand();
std::unique_ptr<Command> makeMeshCommand();
std::unique_ptr<Command> makeSolveCommand();
std::unique_ptr<Command> makeTouchCommand();
std::unique_ptr<Command> makeGradientCommand();
std::unique_ptr<Command> makeOptimiseCommand();
std::unique_ptr<Command> makeCompareCommand();
std::unique_ptr<Command> makeSectionCommand();
std::unique_ptr<Command> makeRenderCommand();
std::unique_ptr<Command> makeReportCommand();
std::unique_ptr<Command> makeImportCommand();
std::unique_ptr<Command> makeExportCommand();
std::unique_ptr<Command> makeConvertCommand();
std::unique_ptr<Command> makeServeCommand();
std::unique_ptr<Command> makeVerifyCommand();

}  // namespace palpa::cli

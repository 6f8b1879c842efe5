#pragma once

#include <QString>
#include <functional>
#include <string>

#include "app/gui/document/editor.h"
#include "tests/reliability/campaign.h"

// Common part of the campaigns that drive a window: a parent process watches the window's process,
// and prints the last actions when that dies or stands still.
namespace palpa::reliability {

/// Writes an action to the log at once, so that the last one is there after a crash.
using ActionLog = std::function<void(const QString&)>;

/// Actions of the window's process: gets a folder with files to be opened and overwritten
/// (examples, a mesh, a CAD file, a recording, and two files that cannot be read); returns the exit
/// code. An Application exists, confined to the folder: settings, caches and temporary files are
/// there.
using WindowProcess = std::function<int(const QString& folder, const ActionLog& log)>;

/// Runs `drive` in a child process. Fails the campaign if the process crashes or logs nothing for
/// four minutes; then gdb, if it is installed, prints the stacks of its threads. Returns the exit
/// code. Option of the campaign: "--log".
int runWatched(Campaign& campaign, char** argv, const WindowProcess& drive);

/// Requires that the saved text is readable, and that undoing and redoing all steps lead to it.
void checkProject(Campaign& campaign, gui::Editor& editor);

}  // namespace palpa::reliability

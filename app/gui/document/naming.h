#pragma once

#include <QString>
#include <string>

#include "app/gui/document/editor.h"

// Names of the things of a project, and what can be done to things that have one.
namespace palpa::gui {

/// Renames a patch, or says through Editor::refused why not. True when it has the name now.
bool renamePatch(Editor& editor, int patch, const QString& name);
/// The same for a support, load or touch, which stays selected when it was.
bool renameNamed(Editor& editor, const Selection::Named& which, const QString& name);
bool renameProject(Editor& editor, const QString& name);

/// Adds a copy with a name of its own and selects it.
void duplicate(Editor& editor, const Selection::Named& which);

/// Deletes the selected support, load or touch. Where something else is selected, says through
/// Editor::refused why it cannot be deleted.
void deleteSelected(Editor& editor);

/// "Sphere", "Extrusion", …; "Solid" when it is not known, "Mesh body".
QString bodyTitle(const modeling::Project& project);

}  // namespace palpa::gui

#pragma once

#include <QString>
#include <string>

#include "app/gui/document/editor.h"

// Renaming, duplicating and deleting the named items of a project.
namespace palpa::gui {

/// Renames a patch. False, with a reason in Editor::refused, if the name cannot be given.
bool renamePatch(Editor& editor, int patch, const QString& name);
/// The same for a support, load, touch or measurement. A selected item stays selected.
bool renameNamed(Editor& editor, const Selection::Named& which, const QString& name);
bool renameProject(Editor& editor, const QString& name);

/// Adds a copy with a free name and selects it.
void duplicate(Editor& editor, const Selection::Named& which);

/// Deletes the selected support, load, touch or measurement. For any other selection
/// Editor::refused states why it cannot be deleted.
void deleteSelected(Editor& editor);

/// "Sphere", "Box", …; "Solid" without a known primitive; "Mesh body".
QString bodyTitle(const modeling::Project& project);

}  // namespace palpa::gui

#pragma once

#include <QString>
#include <optional>

#include "app/gui/workspace/workspace.h"
#include "modeling/exchange/cad_import.h"

namespace palpa::gui {

/// What the user chose in an ImportDialog.
struct ImportChoice {
  modeling::ImportOptions options;
  modeling::FileBodies found;  ///< all solids of the file
  std::size_t current = 0;     ///< the selected one
  bool takesAll = false;
};

/// Lists the solids of a CAD or mesh file in the background and asks which to import and how. None
/// if the user cancelled or the file cannot be read; the editor then emits `refused`.
std::optional<ImportChoice> askImportChoice(const Workspace& workspace, const QString& file);

/// Asks for a folder and writes a project file there for each solid. Returns the file of the
/// selected solid; empty if the user cancelled or it could not be written. Solids that could not be
/// imported are told with `refused`.
QString importAllSolids(const Workspace& workspace, const QString& file,
                        const ImportChoice& choice);

}  // namespace palpa::gui

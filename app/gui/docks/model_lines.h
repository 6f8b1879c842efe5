#pragma once

#include <QString>
#include <vector>

#include "app/gui/document/editor.h"

// Contents of the rows of the model tree. Internal to app/gui/docks.
namespace palpa::gui {

/// Kind of a row: the fixed rows, then the rows of the lists below them.
enum class ModelRow : quintptr {
  kProject,
  kBody,
  kPatches,
  kEdges,
  kSupports,
  kLoads,
  kTouches,
  kMeasurements,
  kMaterial,
  kMesh,
  kPatch,
  kEdge,
  kSupport,
  kLoad,
  kTouch,
  kMeasurement,
};

/// One line of the model tree.
struct ModelLine {
  QString name;    ///< of a list with names: the name itself, which can be edited
  QString detail;  ///< second column
  QString icon;    ///< name for icon()
  QString tip;

  bool operator==(const ModelLine&) const = default;
};
using ModelLines = std::vector<ModelLine>;

/// Line of a fixed row.
ModelLine lineOf(ModelRow row, const Editor& editor);

// Lines of the lists, in the order of the project.
/// Patches of a solid, or faces of a mesh body.
ModelLines patchLines(const Editor& editor);
/// Edges of a solid; empty for a mesh body.
ModelLines edgeLines(const Editor& editor);
ModelLines supportLines(const Editor& editor);
ModelLines loadLines(const Editor& editor);
ModelLines touchLines(const Editor& editor);
/// With the values, or the reason why a measurement has none.
ModelLines measurementLines(Editor& editor);

}  // namespace palpa::gui

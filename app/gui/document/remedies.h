#pragma once

#include <QString>
#include <functional>
#include <vector>

#include "app/gui/document/editor.h"

namespace palpa::gui {

/// A step that may let a model be built that cannot be built at present; each is one step of undo.
struct Remedy {
  QString text;  ///< of a button
  QString tip;
  std::function<void()> apply;
};

/// Remedies for the failure of the last build, the best first; empty if there is none that one
/// click can do, or if the build did not fail. The editor must outlive them.
std::vector<Remedy> remediesOf(Editor& editor);

/// Gives the material the density of the similar material of the library.
Remedy usualDensity(Editor& editor);

}  // namespace palpa::gui

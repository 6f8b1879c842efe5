#pragma once

#include <QString>
#include <vector>

#include "modeling/project/project.h"

namespace palpa::gui {

/// Project built into the program.
struct Example {
  QString name;         ///< file name without ending
  QString title;        ///< for menus
  QString description;  ///< one sentence
};

/// From simple to elaborate.
std::vector<Example> examples();

/// The project of an example. Throws ModelingError for an unknown name.
modeling::Project readExample(const QString& name);

}  // namespace palpa::gui

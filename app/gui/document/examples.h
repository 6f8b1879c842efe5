#pragma once

#include <QString>
#include <vector>

#include "modeling/project/project.h"

namespace palpa::gui {

/// A project that comes with the program, built into it.
struct Example {
  QString name;   ///< of its file, without ending
  QString title;  ///< for menus
  QString what;   ///< one sentence
};

/// From simple to elaborate.
std::vector<Example> examples();

/// The project of an example. @throws ModelingError when there is none of this name
modeling::Project readExample(const QString& name);

}  // namespace palpa::gui

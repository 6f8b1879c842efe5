#pragma once

#include <QString>
#include <vector>

#include "modeling/project/project.h"

namespace palpa::gui {

/// Project built into the program.
struct Example {
  QString name;         ///< file in projects/, without ending
  QString title;        ///< for menus
  QString description;  ///< one sentence
};

/// From simple to elaborate.
std::vector<Example> examples();

/// With targets, for the panel Targets: worked examples of "Make it feel like this" in the guide.
std::vector<Example> designExamples();

/// The project of an example, of either list. Throws ModelingError for an unknown name.
modeling::Project readExample(const QString& name);

}  // namespace palpa::gui

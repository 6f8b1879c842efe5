#pragma once

#include <functional>

#include "app/gui/document/editor.h"
#include "modeling/project/design.h"

// Edits of the design section of the project.
namespace palpa::gui {

/// The design of the project; the default one if it has none.
modeling::Design designOf(const modeling::Project& project);

/// Changes the design by one command; a design that equals the default is removed. False if the
/// editor refused it.
bool editDesign(Editor& editor, const std::function<void(modeling::Design&)>& change);

/// A new target for the touch with this name: its stiffness is to be `stiffness`, N/mm, with four
/// digits; 1 N/mm if it is not positive.
modeling::DesignTarget targetFor(const std::string& touch, double stiffness);

/// Rounds to four significant digits.
double withFourDigits(double value);

}  // namespace palpa::gui

#include "app/gui/document/design_edit.h"

#include <cmath>

namespace palpa::gui {

modeling::Design designOf(const modeling::Project& project) {
  return project.design.value_or(modeling::Design{});
}

bool editDesign(Editor& editor, const std::function<void(modeling::Design&)>& change) {
  modeling::Design design = designOf(editor.project());
  change(design);
  modeling::SetDesign command;
  if (design != modeling::Design{}) command.design = std::move(design);
  if (command.design == editor.project().design) return true;
  return editor.perform(command);
}

double withFourDigits(double value) {
  if (!(value > 0) || !std::isfinite(value)) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 3);
  // A power of ten below one has no exact double: dividing by its inverse gives the typed number.
  return unit < 1 ? std::round(value / unit) / std::round(1 / unit)
                  : std::round(value / unit) * unit;
}

modeling::DesignTarget targetFor(const std::string& touch, double stiffness) {
  modeling::DesignTarget target;
  target.touch = touch;
  if (stiffness > 0 && std::isfinite(stiffness)) target.value = withFourDigits(stiffness);
  return target;
}

}  // namespace palpa::gui

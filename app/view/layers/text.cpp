#include "app/view/layers/text.h"

#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace palpa::view {

vtkSmartPointer<vtkTextActor> makeText(const std::string& text, const TextStyle& style) {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(text.c_str());
  actor->SetTextScaleModeToNone();
  vtkTextProperty* property = actor->GetTextProperty();
  property->SetFontFamilyToArial();
  // At 72 dots per inch, which Viewport sets, a point is a pixel.
  property->SetFontSize(static_cast<int>(std::lround(std::max(style.size, 6.0))));
  property->SetBold(style.bold);
  property->SetItalic(false);
  property->SetShadow(false);
  property->SetColor(style.colour[0], style.colour[1], style.colour[2]);
  property->SetJustificationToLeft();
  property->SetVerticalJustificationToBottom();
  property->SetLineSpacing(1.15);
  actor->GetPositionCoordinate()->SetCoordinateSystemToDisplay();
  return actor;
}

Eigen::Vector2d textSize(vtkTextActor* text, vtkRenderer* renderer) {
  double size[2] = {0, 0};
  text->GetSize(renderer, size);
  return {size[0], size[1]};
}

}  // namespace palpa::view

#include "app/view/arrows.h"

#include <vtkActor.h>
#include <vtkConeSource.h>
#include <vtkLineSource.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>
#include <vtkTubeFilter.h>

#include <algorithm>
#include <array>

#include "app/view/camera_fit.h"
#include "app/view/colour_map.h"
#include "app/view/flat.h"
#include "app/view/text.h"

namespace palpa::view {
namespace {

constexpr int kSides = 32;

vtkSmartPointer<vtkActor> makePart(vtkAlgorithmOutput* shape, const Colour& colour,
                                   double opacity) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(shape);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(colour[0], colour[1], colour[2]);
  setArrowLooks(property, opacity);
  return actor;
}

/// Shaft and head of an arrow as solid bodies.
std::array<vtkSmartPointer<vtkActor>, 2> makeArrow(const PlacedArrow& arrow, double bodyDiagonal,
                                                   const Colour& colour, double opacity) {
  const Eigen::Vector3d along = arrow.tip - arrow.tail;
  const double length = along.norm();
  const double shrink = std::min(1.0, 0.6 * length / (kArrowHeadLength * bodyDiagonal));
  const double headLength = shrink * kArrowHeadLength * bodyDiagonal;
  const Eigen::Vector3d direction = along / length;
  const Eigen::Vector3d neck = arrow.tip - headLength * direction;

  vtkNew<vtkLineSource> line;
  line->SetPoint1(arrow.tail.x(), arrow.tail.y(), arrow.tail.z());
  line->SetPoint2(neck.x(), neck.y(), neck.z());
  vtkNew<vtkTubeFilter> shaft;
  shaft->SetInputConnection(line->GetOutputPort());
  shaft->SetRadius(shrink * kArrowShaftRadius * bodyDiagonal);
  shaft->SetNumberOfSides(kSides);
  shaft->CappingOn();

  const Eigen::Vector3d middle = arrow.tip - 0.5 * headLength * direction;
  vtkNew<vtkConeSource> head;
  head->SetCenter(middle.x(), middle.y(), middle.z());
  head->SetDirection(direction.x(), direction.y(), direction.z());
  head->SetHeight(headLength);
  head->SetRadius(shrink * kArrowHeadRadius * bodyDiagonal);
  head->SetResolution(kSides);
  return {makePart(shaft->GetOutputPort(), colour, opacity),
          makePart(head->GetOutputPort(), colour, opacity)};
}

PlacedArrow place(const ForceArrow& arrow, double length) {
  const Eigen::Vector3d vector = length * arrow.force.normalized();
  if (arrow.anchor == ForceArrow::Anchor::kTail) return {arrow.at, arrow.at + vector, &arrow};
  return {arrow.at - vector, arrow.at, &arrow};
}

}  // namespace

const Eigen::Vector3d& PlacedArrow::freeEnd() const {
  return arrow->anchor == ForceArrow::Anchor::kTail ? tip : tail;
}

const Eigen::Vector3d& PlacedArrow::heldEnd() const {
  return arrow->anchor == ForceArrow::Anchor::kTail ? tail : tip;
}

void setArrowLooks(vtkProperty* property, double opacity) {
  property->SetOpacity(opacity);
  property->SetAmbient(0.35);
  property->SetDiffuse(0.70);
  property->SetSpecular(0.15);
  property->SetSpecularPower(20);
  property->BackfaceCullingOn();
}

const Colour& arrowColour(ForceArrow::Role role) {
  return role == ForceArrow::Role::kApplied ? kAppliedForceColour : kReactionColour;
}

std::vector<PlacedArrow> placeArrows(const std::vector<ForceArrow>& arrows, double longest) {
  double largest = 0;
  for (const ForceArrow& arrow : arrows) largest = std::max(largest, arrow.force.norm());
  std::vector<PlacedArrow> placed;
  for (const ForceArrow& arrow : arrows) {
    const double force = arrow.force.norm();
    if (force > 0) placed.push_back(place(arrow, longest * std::max(force / largest, 0.25)));
  }
  return placed;
}

std::vector<PlacedArrow> placeLiveArrows(const LiveArrows& arrows, double longest) {
  // Far below a pixel there is no direction worth drawing.
  constexpr double kMinShare = 1e-3;
  std::vector<PlacedArrow> placed;
  for (const ForceArrow& arrow : arrows.arrows) {
    const double share = arrow.force.norm() / arrows.fullForce;
    if (share > kMinShare) placed.push_back(place(arrow, longest * std::min(share, 1.0)));
  }
  return placed;
}

void addArrows(const std::vector<PlacedArrow>& arrows, double bodyDiagonal, double opacity,
               vtkRenderer* renderer) {
  for (const PlacedArrow& placed : arrows) {
    const Colour& colour = arrowColour(placed.arrow->role);
    for (const auto& part : makeArrow(placed, bodyDiagonal, colour, opacity)) {
      renderer->AddActor(part);
    }
  }
}

void addArrowLabels(const std::vector<PlacedArrow>& arrows, double fontSize,
                    const Rectangle& bounds, Occupancy& occupancy, vtkRenderer* scene,
                    vtkRenderer* overlay) {
  for (const PlacedArrow& placed : arrows) {
    occupancy.addSegment(toPixels(placed.tail, scene), toPixels(placed.tip, scene), Cover::kMark);
  }
  for (const PlacedArrow& placed : arrows) {
    if (placed.arrow->label.empty()) continue;
    const auto text =
        makeText(placed.arrow->label, {fontSize, true, arrowColour(placed.arrow->role)});
    const Eigen::Vector2d end = toPixels(placed.freeEnd(), scene);
    LabelWish wish;
    wish.anchor = end;
    wish.towards = end - toPixels(placed.heldEnd(), scene);
    wish.size = textSize(text, overlay);
    wish.gap = 0.55 * fontSize;
    const Rectangle place = placeLabel(wish, bounds, occupancy);
    if (occupancy.meanCover(place) > 0) {
      const double pad = 0.25 * fontSize;
      addFlatRectangle({place.left - pad, place.bottom - pad, place.right + pad, place.top + pad},
                       {1, 1, 1}, overlay, 0.85);
    }
    occupancy.addRectangle(place, Cover::kMark);
    placeText(text, {place.left, place.bottom}, overlay);
  }
}

}  // namespace palpa::view

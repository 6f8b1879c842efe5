#include "app/view/arrows.h"

#include <vtkActor.h>
#include <vtkConeSource.h>
#include <vtkLineSource.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTubeFilter.h>

#include <algorithm>

#include "app/view/camera_fit.h"
#include "app/view/colour_map.h"
#include "app/view/flat.h"
#include "app/view/text.h"

namespace palpa::view {
namespace {

/// Thickness relative to the body's diagonal, the same for all arrows: only the length speaks.
constexpr double kShaftRadius = 0.0075;
constexpr double kHeadRadius = 0.021;
constexpr double kHeadLength = 0.062;
constexpr int kSides = 32;

const Colour& colourOf(const ForceArrow& arrow) {
  return arrow.role == ForceArrow::Role::kApplied ? kAppliedForceColour : kReactionColour;
}

void addPart(vtkAlgorithmOutput* shape, const Colour& colour, double opacity,
             vtkRenderer* renderer) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(shape);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(colour[0], colour[1], colour[2]);
  property->SetOpacity(opacity);
  property->SetAmbient(0.35);
  property->SetDiffuse(0.70);
  property->SetSpecular(0.15);
  property->SetSpecularPower(20);
  property->BackfaceCullingOn();
  renderer->AddActor(actor);
}

}  // namespace

const Eigen::Vector3d& PlacedArrow::freeEnd() const {
  return arrow->anchor == ForceArrow::Anchor::kTail ? tip : tail;
}

const Eigen::Vector3d& PlacedArrow::heldEnd() const {
  return arrow->anchor == ForceArrow::Anchor::kTail ? tail : tip;
}

std::vector<PlacedArrow> placeArrows(const SurfaceScene& scene, double bodyDiagonal) {
  double largest = 0;
  for (const ForceArrow& arrow : scene.arrows) largest = std::max(largest, arrow.force.norm());
  std::vector<PlacedArrow> placed;
  for (const ForceArrow& arrow : scene.arrows) {
    const double force = arrow.force.norm();
    if (force == 0) continue;
    const double length = scene.arrowLength * bodyDiagonal * std::max(force / largest, 0.25);
    const Eigen::Vector3d vector = length * arrow.force / force;
    if (arrow.anchor == ForceArrow::Anchor::kTail) {
      placed.push_back({arrow.at, arrow.at + vector, &arrow});
    } else {
      placed.push_back({arrow.at - vector, arrow.at, &arrow});
    }
  }
  return placed;
}

void addArrows(const std::vector<PlacedArrow>& arrows, double bodyDiagonal, double opacity,
               vtkRenderer* renderer) {
  for (const PlacedArrow& placed : arrows) {
    const Eigen::Vector3d along = placed.tip - placed.tail;
    const double length = along.norm();
    const double shrink = std::min(1.0, 0.6 * length / (kHeadLength * bodyDiagonal));
    const double headLength = shrink * kHeadLength * bodyDiagonal;
    const Eigen::Vector3d direction = along / length;
    const Eigen::Vector3d neck = placed.tip - headLength * direction;

    vtkNew<vtkLineSource> line;
    line->SetPoint1(placed.tail.x(), placed.tail.y(), placed.tail.z());
    line->SetPoint2(neck.x(), neck.y(), neck.z());
    vtkNew<vtkTubeFilter> shaft;
    shaft->SetInputConnection(line->GetOutputPort());
    shaft->SetRadius(shrink * kShaftRadius * bodyDiagonal);
    shaft->SetNumberOfSides(kSides);
    shaft->CappingOn();
    addPart(shaft->GetOutputPort(), colourOf(*placed.arrow), opacity, renderer);

    const Eigen::Vector3d middle = placed.tip - 0.5 * headLength * direction;
    vtkNew<vtkConeSource> head;
    head->SetCenter(middle.x(), middle.y(), middle.z());
    head->SetDirection(direction.x(), direction.y(), direction.z());
    head->SetHeight(headLength);
    head->SetRadius(shrink * kHeadRadius * bodyDiagonal);
    head->SetResolution(kSides);
    addPart(head->GetOutputPort(), colourOf(*placed.arrow), opacity, renderer);
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
    const auto text = makeText(placed.arrow->label, {fontSize, true, colourOf(*placed.arrow)});
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

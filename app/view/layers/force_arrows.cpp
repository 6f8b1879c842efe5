#include "app/view/layers/force_arrows.h"

#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <Eigen/Geometry>

namespace palpa::view {
namespace {

constexpr double kMaxLoadLength = 0.17;  // of the body's diagonal
constexpr double kMinLoadShare = 0.25;
constexpr double kFullGradientLength = 0.18;
constexpr double kGradientSlimness = 0.6;
constexpr double kOutdated = 0.3;  // opacity
constexpr double kFaint = 0.22;
constexpr double kStrong = 0.9;
constexpr double kFontSize = 13;  // logical pixels
constexpr double kGap = 8;
constexpr double kCover = 7;
constexpr double kMargin = 0.04;  // of the picture, between an arrow and its edge
/// An arrow suits a body as large as this many heights of the view, if the body is larger.
constexpr double kLargest = 2.2;

vtkSmartPointer<vtkActor> makeActor(vtkPolyData* surface, double opacity) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->SetColorModeToDirectScalars();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetOpacity(opacity);
  property->SetAmbient(0.35);
  property->SetDiffuse(0.70);
  property->SetSpecular(0.15);
  property->SetSpecularPower(20);
  property->BackfaceCullingOn();
  actor->VisibilityOff();
  return actor;
}

// Reactions take the quiet colour of text, applied forces a strong one.
Colour colourOf(ForceArrow::Role role, const ViewportTheme& theme) {
  switch (role) {
    case ForceArrow::Role::kApplied:
      return kAppliedForceColour;
    case ForceArrow::Role::kGradient:
      return kGradientColour;
    case ForceArrow::Role::kReaction:
      break;
  }
  return mixed(theme.text, theme.body, 0.25);
}

}  // namespace

ForceArrows::ForceArrows(vtkRenderer* scene, vtkRenderer* shineThrough, vtkRenderer* overlay)
    : solid_(makeActor(mesh_.surface(), 1)),
      faint_(makeActor(mesh_.surface(), kFaint)),
      strong_(makeActor(weights_.surface(), kStrong)),
      texts_(overlay) {
  blendInOrder(faint_);
  blendInOrder(strong_);
  scene->AddActor(solid_);
  shineThrough->AddActor(faint_);
  shineThrough->AddActor(strong_);
}

void ForceArrows::set(const std::vector<ForceArrow>& arrows, double bodyDiagonal,
                      const ViewportTheme& theme, double pixelRatio) {
  show({arrows, largestForce(arrows), kMinLoadShare}, kMaxLoadLength * bodyDiagonal, bodyDiagonal,
       theme, pixelRatio);
}

void ForceArrows::set(const LiveArrows& arrows, double bodyDiagonal, const ViewportTheme& theme,
                      double pixelRatio) {
  show(arrows, kFullArrowLength * bodyDiagonal, bodyDiagonal, theme, pixelRatio);
}

void ForceArrows::set(const GradientDrawing& gradient, double bodyDiagonal,
                      const ViewportTheme& theme, double pixelRatio) {
  slimness_ = kGradientSlimness;
  const double share = gradient.isOutdated ? kOutdated : 1;
  blendInOrder(solid_);
  solid_->GetProperty()->SetOpacity(share);
  faint_->GetProperty()->SetOpacity(share * kFaint);
  show(gradient.arrows, kFullGradientLength * bodyDiagonal, bodyDiagonal, theme, pixelRatio);
}

void ForceArrows::show(const LiveArrows& arrows, double longest, double bodyDiagonal,
                       const ViewportTheme& theme, double pixelRatio) {
  theme_ = theme;
  pixelRatio_ = pixelRatio;
  ends_.clear();
  std::vector<Label> before = std::move(labels_);
  labels_.clear();
  bodyDiagonal_ = bodyDiagonal;
  std::vector<std::string> words;
  for (const PlacedArrow& placed : placeArrows(arrows, longest)) {
    ends_.push_back(placed.tail);
    ends_.push_back(placed.tip);
    if (placed.arrow->kind == ForceArrow::Kind::kMoment) addTurn(placed);
    labels_.push_back({placed.freeEnd(), placed.heldEnd(), colourOf(placed.arrow->role, theme)});
    labels_.back().isHeldAtTip = placed.arrow->anchor == ForceArrow::Anchor::kTip;
    labels_.back().kind = placed.arrow->kind;
    words.push_back(placed.arrow->label);
  }
  // An equal number of arrows: probably the same ones, a little later.
  if (before.size() == labels_.size())
    for (std::size_t i = 0; i < labels_.size(); ++i) labels_[i].choice = before[i].choice;
  texts_.set(words, {kFontSize * pixelRatio, false, theme.text});
  updateVisibility();
}

void ForceArrows::addTurn(const PlacedArrow& placed) {
  const Eigen::Vector3d along = placed.freeEnd() - placed.heldEnd();
  const Eigen::Vector3d first = along.unitOrthogonal();
  const Eigen::Vector3d second = along.normalized().cross(first);
  const double radius = std::min(kTurnRadius * bodyDiagonal_, kMaxTurnShare * along.norm());
  for (const Eigen::Vector3d& out :
       {first, second, Eigen::Vector3d(-first), Eigen::Vector3d(-second)})
    ends_.push_back(placed.heldEnd() + kTurnAt * along + radius * out);
}

void ForceArrows::fitToView(const Turntable& camera) {
  const double thickness = std::min(bodyDiagonal_, kLargest * camera.visibleHeight());
  const double margin = kMargin * std::min(camera.width(), camera.height());
  bool isSame = thickness == thickness_;
  thickness_ = thickness;
  for (Label& label : labels_) {
    const double share =
        thickness / bodyDiagonal_ *
        shareInPicture(camera, label.held,
                       label.held + thickness / bodyDiagonal_ * (label.free - label.held), margin);
    isSame = isSame && share == label.share;
    label.share = share;
  }
  if (isSame) return;
  using Kind = ForceArrow::Kind;
  std::vector<SolidArrow> solids, weights;
  for (const Label& label : labels_) {
    const Eigen::Vector3d free = label.shownFree();
    const Eigen::Vector3d& tail = label.isHeldAtTip ? free : label.held;
    const Eigen::Vector3d& tip = label.isHeldAtTip ? label.held : free;
    if (label.kind == Kind::kMoment)
      solids.push_back(SolidArrow::turning(tail, tip, label.isHeldAtTip ? 1 - kTurnAt : kTurnAt,
                                           thickness, label.frame));
    else
      (label.kind == Kind::kWeight ? weights : solids)
          .push_back(SolidArrow::of(tail, tip, slimness_ * thickness, label.frame));
  }
  mesh_.set(solids);
  weights_.set(weights);
}

void ForceArrows::setVisible(bool visible) {
  visible_ = visible;
  updateVisibility();
}

void ForceArrows::updateVisibility() {
  const bool visible = visible_ && !labels_.empty();
  solid_->SetVisibility(visible);
  faint_->SetVisibility(visible);
  strong_->SetVisibility(visible);
}

void ForceArrows::update(const Turntable& camera, std::vector<PixelBox>& taken,
                         FlatShapes& shapes) {
  if (!visible_) {
    texts_.hideAll();
    return;
  }
  fitToView(camera);
  const Eigen::Vector2d pad = kPlatePad * pixelRatio_;
  const Eigen::Vector2d picture(camera.width(), camera.height());
  std::vector<std::optional<SeenArrow>> seen;
  for (const Label& label : labels_) {
    seen.push_back(
        seenPart(camera.toPixel(label.held), camera.toPixel(label.shownFree()), picture));
    if (seen.back()) addArrowCover(*seen.back(), kCover * pixelRatio_, taken);
  }
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    if (texts_.extent(i).isZero() || !seen[i]) {
      texts_.hide(i);
      continue;
    }
    const ArrowLabelWish wish{seen[i]->free, seen[i]->free - seen[i]->held,
                              texts_.extent(i) + 2 * pad};
    const ArrowLabelPlace place =
        placeArrowLabel(wish, picture, kGap * pixelRatio_, taken, labels_[i].choice);
    labels_[i].choice = place.choice;
    const PixelBox& plate = place.box;
    taken.push_back(plate);
    shapes.addPlate(plate.low, plate.high, labels_[i].frame, theme_, pixelRatio_);
    texts_.place(i, plate.low + pad, camera.height());
  }
}

}  // namespace palpa::view

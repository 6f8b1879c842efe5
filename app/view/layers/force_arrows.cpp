#include "app/view/layers/force_arrows.h"

#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include "app/view/scene/arrows.h"

namespace palpa::view {
namespace {

constexpr double kMaxLoadLength = 0.17;  // of the body's diagonal
constexpr double kMinLoadShare = 0.25;
constexpr double kFaint = 0.22;
constexpr double kFontSize = 13;  // logical pixels
constexpr double kGap = 8;
constexpr double kCover = 7;

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

}  // namespace

ForceArrows::ForceArrows(vtkRenderer* scene, vtkRenderer* shineThrough, vtkRenderer* overlay)
    : solid_(makeActor(mesh_.surface(), 1)),
      faint_(makeActor(mesh_.surface(), kFaint)),
      texts_(overlay) {
  blendInOrder(faint_);
  scene->AddActor(solid_);
  shineThrough->AddActor(faint_);
}

void ForceArrows::set(const std::vector<ForceArrow>& arrows, double bodyDiagonal,
                      const ViewportTheme& theme, double pixelRatio) {
  double largest = 0;
  for (const ForceArrow& arrow : arrows) largest = std::max(largest, arrow.force.norm());
  show({arrows, largest, kMinLoadShare}, kMaxLoadLength * bodyDiagonal, bodyDiagonal, theme,
       pixelRatio);
}

void ForceArrows::set(const LiveArrows& arrows, double bodyDiagonal, const ViewportTheme& theme,
                      double pixelRatio) {
  show(arrows, kFullArrowLength * bodyDiagonal, bodyDiagonal, theme, pixelRatio);
}

void ForceArrows::show(const LiveArrows& arrows, double longest, double bodyDiagonal,
                       const ViewportTheme& theme, double pixelRatio) {
  theme_ = theme;
  pixelRatio_ = pixelRatio;
  ends_.clear();
  std::vector<Label> before = std::move(labels_);
  labels_.clear();
  std::vector<SolidArrow> solids;
  std::vector<std::string> words;
  for (const PlacedArrow& placed : placeArrows(arrows, longest)) {
    ends_.push_back(placed.tail);
    ends_.push_back(placed.tip);
    // Reactions take the quiet colour of text, applied forces a strong one.
    const Colour colour = placed.arrow->role == ForceArrow::Role::kApplied
                              ? kAppliedForceColour
                              : mixed(theme.text, theme.body, 0.25);
    solids.push_back(SolidArrow::of(placed.tail, placed.tip, bodyDiagonal, colour));
    labels_.push_back({placed.freeEnd(), placed.heldEnd(), colour});
    words.push_back(placed.arrow->label);
  }
  // An equal number of arrows: probably the same ones, a little later.
  if (before.size() == labels_.size())
    for (std::size_t i = 0; i < labels_.size(); ++i) labels_[i].choice = before[i].choice;
  mesh_.set(solids);
  texts_.set(words, {kFontSize * pixelRatio, false, theme.text});
  updateVisibility();
}

void ForceArrows::setVisible(bool visible) {
  visible_ = visible;
  updateVisibility();
}

void ForceArrows::updateVisibility() {
  const bool visible = visible_ && !labels_.empty();
  solid_->SetVisibility(visible);
  faint_->SetVisibility(visible);
}

void ForceArrows::update(const Turntable& camera, std::vector<PixelBox>& taken,
                         FlatShapes& shapes) {
  if (!visible_) {
    texts_.hideAll();
    return;
  }
  const Eigen::Vector2d pad = kPlatePad * pixelRatio_;
  const Eigen::Vector2d picture(camera.width(), camera.height());
  std::vector<std::optional<SeenArrow>> seen;
  for (const Label& label : labels_) {
    seen.push_back(seenPart(camera.toPixel(label.held), camera.toPixel(label.free), picture));
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

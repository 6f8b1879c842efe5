#include "app/view/load_arrows.h"

#include <algorithm>
#include <cmath>

#include "app/view/arrows.h"
#include "app/view/text.h"

namespace palpa::view {
namespace {

constexpr double kLongest = 0.17;   // of the body's diagonal
constexpr double kThickness = 0.6;  // of the arrows in pictures: they stand among handles and lines
constexpr double kFaint = 0.22;
constexpr double kFontSize = 13;  // logical pixels

}  // namespace

LoadArrows::LoadArrows(vtkRenderer* scene, vtkRenderer* shineThrough, vtkRenderer* overlay)
    : scene_(scene), shineThrough_(shineThrough), overlay_(overlay) {}

void LoadArrows::clear() {
  for (const auto& actor : solid_) scene_->RemoveActor(actor);
  for (const auto& actor : faint_) shineThrough_->RemoveActor(actor);
  for (const Label& label : labels_) overlay_->RemoveActor2D(label.text);
  solid_.clear();
  faint_.clear();
  labels_.clear();
  ends_.clear();
}

void LoadArrows::set(const std::vector<ForceArrow>& arrows, double bodyDiagonal,
                     const ViewportTheme& theme, double pixelRatio) {
  clear();
  plate_ = mixed(theme.backgroundTop, theme.body, 0.05);
  pixelRatio_ = pixelRatio;
  for (const PlacedArrow& placed : placeArrows(arrows, kLongest * bodyDiagonal)) {
    ends_.push_back(placed.tail);
    ends_.push_back(placed.tip);
    // Reactions are quiet: they take the colour of text, applied forces one that stands out.
    const Colour colour = placed.arrow->role == ForceArrow::Role::kApplied
                              ? arrowColour(placed.arrow->role)
                              : mixed(theme.text, theme.body, 0.25);
    for (const auto& part : makeArrow(placed, kThickness * bodyDiagonal, colour, 1)) {
      scene_->AddActor(part);
      solid_.push_back(part);
    }
    for (const auto& part : makeArrow(placed, kThickness * bodyDiagonal, colour, kFaint)) {
      blendInOrder(part);
      shineThrough_->AddActor(part);
      faint_.push_back(part);
    }
    if (placed.arrow->label.empty()) continue;
    Label label;
    label.text = makeText(placed.arrow->label, {kFontSize * pixelRatio, false, theme.text});
    label.frame = colour;
    label.free = placed.freeEnd();
    label.held = placed.heldEnd();
    label.size = textSize(label.text, overlay_);
    overlay_->AddActor2D(label.text);
    labels_.push_back(label);
  }
  setVisible(visible_);
}

void LoadArrows::setVisible(bool visible) {
  visible_ = visible;
  for (const auto& actor : solid_) actor->SetVisibility(visible);
  for (const auto& actor : faint_) actor->SetVisibility(visible);
}

void LoadArrows::update(const Turntable& camera, FlatShapes& shapes) {
  for (const Label& label : labels_) {
    const Eigen::Vector2d end = camera.toPixel(label.free);
    const Eigen::Vector2d other = camera.toPixel(label.held);
    const bool visible = visible_ && end.allFinite() && other.allFinite();
    label.text->SetVisibility(visible);
    if (!visible) continue;
    const Eigen::Vector2d along = end - other;
    const Eigen::Vector2d away =
        along.norm() > 0 ? Eigen::Vector2d(along.normalized()) : Eigen::Vector2d(0, -1);
    // The label's box touches, in the direction of the arrow, a circle around its end.
    const Eigen::Vector2d half = 0.5 * label.size;
    const double gap = 14 * pixelRatio_;
    // As the plates of tools.
    const Eigen::Vector2d pad = Eigen::Vector2d(6, 4) * pixelRatio_;
    // Within the view as long as the arrow's end is there.
    const Eigen::Vector2d size(camera.width(), camera.height());
    const Eigen::Vector2d margin = half + pad;
    Eigen::Vector2d center =
        end + gap * away + Eigen::Vector2d(half.x() * away.x(), half.y() * away.y());
    if ((end.array() >= 0).all() && (end.array() <= size.array()).all())
      center = center.cwiseMin(size - margin).cwiseMax(margin);
    const Eigen::Vector2d low = (center - half - pad).array().round();
    const Eigen::Vector2d high = (center + half + pad).array().round();
    shapes.addRectangle(low, high, plate_, 0.90);
    shapes.addFrame(low, high, std::max(1.0, std::round(pixelRatio_)), label.frame, 0.7);
    label.text->SetPosition(std::round(center.x() - half.x()),
                            std::round(camera.height() - center.y() - half.y()));
  }
}

}  // namespace palpa::view

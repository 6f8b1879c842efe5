#include "app/gui/tools/support_tool.h"

#include <algorithm>
#include <cmath>

#include "app/gui/tools/brush.h"
#include "app/gui/tools/motion_geometry.h"
#include "app/gui/tools/support_options.h"

namespace palpa::gui {
namespace {

using Kind = Selection::Kind;

constexpr double kBrushShare = 0.06;    // of the body's size: initial radius
constexpr double kRadiusStep = 1.15;    // factor of [ and ]
constexpr double kPixelStep = 6.0;      // between two samples of the surface while painting
constexpr double kPointSpacing = 0.25;  // of the radius, between two points of a stroke

}  // namespace

double SupportTool::radius() const {
  return radius_ ? *radius_ : roundLengthBelow(kBrushShare * bodySize());
}

void SupportTool::setRadius(double radius) {
  radius_ = std::clamp(radius, 1e-4 * bodySize(), 10.0 * bodySize());
  Q_EMIT changed();
}

void SupportTool::setBrush(Brush brush) {
  if (brush == brush_) return;
  cancel();
  hideHover();
  brush_ = brush;
  Q_EMIT changed();
}

modeling::Support::Kind SupportTool::kind() const {
  return selected(Kind::kSupport) ? painted().kind : newKind_;
}

void SupportTool::setKind(modeling::Support::Kind kind) {
  newKind_ = kind;
  if (const auto name = selected(Kind::kSupport)) {
    modeling::Support support = painted();
    if (support.kind != kind) {
      support.kind = kind;
      editor_.perform(modeling::SetSupport{*name, support});
    }
  }
  Q_EMIT changed();
}

modeling::Support SupportTool::painted() const {
  const auto& supports = editor_.project().supports;
  if (const auto name = selected(Kind::kSupport))
    if (const auto* support = findNamed(supports, *name)) return *support;
  modeling::Support fresh;
  fresh.name = freeName(tr("support").toStdString(), supports);
  fresh.kind = newKind_;
  return fresh;
}

bool SupportTool::put(modeling::Support support) {
  const std::string name = support.name;
  const bool isThere = findNamed(editor_.project().supports, name) != nullptr;
  if (support.where.parts.empty())
    return !isThere || editor_.perform(modeling::RemoveSupport{name});
  if (isThere) return editor_.perform(modeling::SetSupport{name, std::move(support)});
  if (!editor_.perform(modeling::AddSupport{std::move(support)})) return false;
  editor_.select(Selection::of(Kind::kSupport, name));
  return true;
}

bool SupportTool::press(const PointerEvent& event) {
  if (event.button != Qt::LeftButton) return false;
  const auto place = scene_.placeAt(event.pixel);
  if (!place) return true;
  editor_.beginGroup(tr("Paint support"));
  isPainting_ = true;
  hasBegunStroke_ = false;
  last_ = event.pixel;
  erases_ = brush_ == Brush::kPatch ? namesPatch(painted().where, patchName(place->patch))
                                    : (event.modifiers & Qt::ControlModifier) != 0;
  paintAlong(event.pixel);
  return true;
}

bool SupportTool::move(const PointerEvent& event) {
  if (isPainting_) paintAlong(event.pixel);
  last_ = event.pixel;
  hover(event.pixel);
  return isPainting_;
}

bool SupportTool::release(const PointerEvent& event) {
  if (event.button != Qt::LeftButton || !isPainting_) return false;
  isPainting_ = false;
  editor_.endGroup();
  Q_EMIT changed();
  return true;
}

bool SupportTool::cancel() {
  if (!isPainting_) return false;
  isPainting_ = false;
  editor_.cancelGroup();
  hideHover();
  Q_EMIT changed();
  return true;
}

void SupportTool::paintAlong(const Eigen::Vector2d& pixel) {
  // Fast motion skips pixels: paint the surface between them, too.
  const int steps =
      std::clamp(static_cast<int>(std::ceil((pixel - last_).norm() / kPixelStep)), 1, 40);
  for (int i = 1; i <= steps; ++i) {
    const auto place = scene_.placeAt(last_ + (pixel - last_) * i / steps);
    if (!place) {
      hasBegunStroke_ = false;  // outside the body: begin another stroke
      continue;
    }
    if (brush_ == Brush::kPatch)
      paintPatch(place->patch);
    else if (erases_)
      eraseAt(*place);
    else
      paintAt(place->position);
  }
  last_ = pixel;
}

void SupportTool::paintPatch(int patch) {
  modeling::Support support = painted();
  if (namesPatch(support.where, patchName(patch)) != erases_) return;
  setPatch(support.where, patchName(patch), !erases_);
  put(std::move(support));
}

void SupportTool::extend(std::vector<modeling::RegionPart>& parts,
                         const Eigen::Vector3d& position) const {
  auto* stroke =
      hasBegunStroke_ && !parts.empty() ? std::get_if<modeling::Stroke>(&parts.back()) : nullptr;
  // A jump across a silhouette does not follow the surface: begin another stroke.
  if (stroke && (stroke->points.back() - position).norm() > 4.0 * radius()) stroke = nullptr;
  if (stroke && stroke->points.size() >= modeling::Stroke::kMaxPoints) stroke = nullptr;
  if (!stroke)
    parts.emplace_back(modeling::Stroke{{position}, radius()});
  else if ((stroke->points.back() - position).norm() >= kPointSpacing * radius())
    stroke->points.push_back(position);
}

void SupportTool::paintAt(const Eigen::Vector3d& position) {
  modeling::Support support = painted();
  const modeling::Region before = support.where;
  eraseStrokes(support.where.except, position);
  extend(support.where.parts, position);
  if (support.where == before) return;
  hasBegunStroke_ = put(std::move(support));
}

void SupportTool::eraseStrokes(std::vector<modeling::RegionPart>& parts,
                               const Eigen::Vector3d& position) const {
  std::vector<modeling::RegionPart> left;
  for (const modeling::RegionPart& part : parts) {
    const auto* stroke = std::get_if<modeling::Stroke>(&part);
    if (!stroke || stroke->value(position) > radius()) {
      left.push_back(part);
      continue;
    }
    const auto pieces = withoutNear(*stroke, position, radius());
    left.insert(left.end(), pieces.begin(), pieces.end());
  }
  parts = std::move(left);
}

void SupportTool::eraseAt(const SurfacePlace& place) {
  modeling::Support support = painted();
  const modeling::Region before = support.where;
  eraseStrokes(support.where.parts, place.position);
  // Patches and half spaces cannot be cut: the stroke becomes an exception.
  std::vector<modeling::RegionPart> others = support.where.parts;
  std::erase_if(others,
                [](const auto& part) { return std::holds_alternative<modeling::Stroke>(part); });
  const bool isInside = modeling::namedPatches(others, editor_.project().body)[place.patch] ||
                        modeling::isInSpace(others, place.position);
  if (isInside) extend(support.where.except, place.position);
  if (support.where == before) return;
  hasBegunStroke_ = put(std::move(support)) && isInside;
}

void SupportTool::hover(const Eigen::Vector2d& pixel) {
  const auto place = scene_.placeAt(pixel);
  if (brush_ == Brush::kPatch) {
    scene_.setHoveredPatch(place ? std::optional(place->patch) : std::nullopt);
    view::ToolDrawing drawing;
    if (place) drawing.labels.push_back({place->position, patchName(place->patch)});
    draw(drawing);
    return;
  }
  view::ToolDrawing drawing;
  if (place)
    for (auto& line : ringOnSurface(scene_.surface(), place->position, radius()))
      drawing.lines.push_back({std::move(line), view::ToolDrawing::Style::kPreview, true});
  draw(drawing);
}

bool SupportTool::wantsKey(const QKeyEvent& event) const {
  return brush_ == Brush::kRound &&
         (event.key() == Qt::Key_BracketLeft || event.key() == Qt::Key_BracketRight);
}

bool SupportTool::key(QKeyEvent* event) {
  if (!wantsKey(*event)) return false;
  setRadius(event->key() == Qt::Key_BracketLeft ? radius() / kRadiusStep : radius() * kRadiusStep);
  hasBegunStroke_ = false;  // a stroke has one radius
  hover(last_);
  return true;
}

std::vector<KeyHelp::Row> SupportTool::keyRows() const {
  return {{tr("Brush: smaller, larger; erase"), tr("[ and ]; Ctrl")}};
}

QString SupportTool::hint() const {
  if (brush_ == Brush::kPatch)
    return tr(
        "Click a patch or drag over patches to support them; click a supported patch to remove it");
  return tr("Drag over the surface to support it, Ctrl erases; [ and ] change the radius "
            "(%1)")
      .arg(shownLength(radius()));
}

QWidget* SupportTool::makeOptions(QWidget* parent) {
  return new SupportOptions(*this, editor_, settings_, parent);
}

}  // namespace palpa::gui

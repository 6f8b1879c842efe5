#include "app/gui/dialogs/bodies_preview.h"

#include <Eigen/Geometry>
#include <map>

#include "app/gui/base/appearance.h"

namespace palpa::gui {
namespace {

/// Sides of triangles that no other triangle has: the edges of faces, whose surfaces are not
/// joined.
std::vector<std::array<int, 2>> openSides(const modeling::FileBody& body) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto& n : body.surface)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(n[k], n[(k + 1) % 3])];
  std::vector<std::array<int, 2>> sides;
  for (const auto& [side, count] : uses)
    if (count == 1) sides.push_back({side.first, side.second});
  return sides;
}

/// CAD faces are smooth inside; the triangles of mesh files are drawn flat.
void addBody(const modeling::FileBody& body, int index, view::ViewportBody& drawn) {
  const int first = static_cast<int>(drawn.positions.size());
  const bool isFlat = body.faces == 0;
  if (!isFlat) {
    drawn.positions.insert(drawn.positions.end(), body.positions.begin(), body.positions.end());
    drawn.normals.resize(drawn.positions.size(), Eigen::Vector3d::Zero());
    std::vector<std::array<int, 2>> sides = openSides(body);
    for (auto& [a, b] : sides) {
      a += first;
      b += first;
    }
    for (auto& line : view::linesBetween(sides)) drawn.borders.push_back(std::move(line));
  }
  for (const auto& [a, b, c] : body.surface) {
    const auto& p = body.positions;
    const Eigen::Vector3d normal = (p[b] - p[a]).cross(p[c] - p[a]);
    std::array<int, 3> corners{first + a, first + b, first + c};
    if (isFlat) {
      const int start = static_cast<int>(drawn.positions.size());
      corners = {start, start + 1, start + 2};
      for (const int corner : {a, b, c}) drawn.positions.push_back(p[corner]);
      drawn.normals.resize(drawn.positions.size(), Eigen::Vector3d::Zero());
    }
    for (const int corner : corners) drawn.normals[corner] += normal;
    drawn.triangles.push_back(corners);
    drawn.patchOfTriangle.push_back(index);
  }
}

}  // namespace

class BodiesPreview::PickTool : public Tool {
 public:
  explicit PickTool(BodiesPreview& preview) : preview_(preview) {}

  bool press(const PointerEvent& event) override {
    if (event.button != Qt::LeftButton) return false;
    const auto hit = preview_.viewport().surfaceAt(event.pixel);
    if (hit) Q_EMIT preview_.picked(preview_.bodyOfTriangle_[hit->triangle]);
    return true;
  }
  QString hint() const override { return {}; }
  KeyHelp keyHelp() const override { return {}; }

 private:
  BodiesPreview& preview_;
};

BodiesPreview::BodiesPreview(QWidget* parent)
    : ViewportWidget(parent), tool_(std::make_unique<PickTool>(*this)) {
  setObjectName("preview");
  setAccessibleName(tr("Preview"));
  viewport().setTheme(viewportTheme(currentTheme()));
  setTool(tool_.get());
}

BodiesPreview::~BodiesPreview() {
  setTool(nullptr);
}

void BodiesPreview::showBodies(const modeling::FileBodies& found) {
  view::ViewportBody drawn;
  for (std::size_t i = 0; i < found.bodies.size(); ++i)
    addBody(found.bodies[i], static_cast<int>(i), drawn);
  for (Eigen::Vector3d& normal : drawn.normals) {
    const double length = normal.norm();
    normal = length > 0.0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::UnitZ();
  }
  bodyOfTriangle_ = drawn.patchOfTriangle;
  count_ = found.bodies.size();
  viewport().setBody(drawn);
  if (isFresh_) viewport().lookFrom(view::StandardView::kIsometric);
  isFresh_ = false;
  viewport().fit();
  update();
}

void BodiesPreview::mark(std::size_t body) {
  std::vector<view::Mark> marks(bodyOfTriangle_.size(), view::Mark::kNone);
  if (count_ > 1)
    for (std::size_t t = 0; t < marks.size(); ++t)
      if (bodyOfTriangle_[t] == static_cast<int>(body)) marks[t] = view::Mark::kSelected;
  viewport().setMarks(marks);
  update();
}

}  // namespace palpa::gui

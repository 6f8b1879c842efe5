#include "app/gui/simulate/load_marks.h"

#include "app/gui/view/condition_marks.h"
#include "app/view/scene/arrows.h"

namespace palpa::gui {

void LoadMarks::find() {
  marks_.clear();
  const app::DrawnBody* drawn = simulation_.drawn();
  if (!drawn || editor_.model().get() != &drawn->model()) return;
  const app::RebuildStatus status = editor_.rebuildStatus();
  if (status.modelRevision != status.revision) return;
  const modeling::DisplayMesh& mesh = drawn->mesh();
  const ShownSurface surface{mesh.positions, mesh.triangles, mesh.patchOfTriangle};
  const auto body = simulation_.body();
  for (view::ForceArrow& arrow : loadArrows(editor_.project(), surface, settings_.units())) {
    Mark mark{std::move(arrow)};
    if (mark.arrow.kind != view::ForceArrow::Kind::kWeight)
      mark.place = body->surface().tree().nearest(mark.arrow.at);
    marks_.push_back(std::move(mark));
  }
}

std::vector<view::ForceArrow> LoadMarks::arrows() const {
  std::vector<view::ForceArrow> arrows;
  for (const Mark& mark : marks_) {
    arrows.push_back(mark.arrow);
    arrows.back().at =
        mark.place ? mark.arrow.at + simulation_.scale() * simulation_.displacementAt(*mark.place)
                   : view::volumeCentre(simulation_.shape().positions,
                                        simulation_.drawn()->mesh().triangles);
  }
  return arrows;
}

}  // namespace palpa::gui

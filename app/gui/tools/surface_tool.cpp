#include "app/gui/tools/surface_tool.h"

#include <algorithm>

namespace palpa::gui {

void SurfaceTool::deactivate() {
  cancel();
  hideHover();
}

KeyHelp SurfaceTool::keyHelp() const {
  return {tr("Tools on the surface"), keyRows()};
}

void SurfaceTool::draw(const view::ToolDrawing& drawing) {
  widget_.viewport().setToolDrawing(drawing);
  widget_.updateQuickly();
}

void SurfaceTool::hideHover() {
  scene_.setHoveredPatch(std::nullopt);
  widget_.viewport().setToolDrawing({});
  widget_.update();
}

std::optional<std::string> SurfaceTool::selected(Selection::Kind kind) const {
  const auto& named = editor_.selection().named;
  return named && named->kind == kind ? std::optional(named->name) : std::nullopt;
}

std::string SurfaceTool::patchName(int patch) const {
  return modeling::patchNames(editor_.project().body)[patch];
}

QString SurfaceTool::shownLength(double length) const {
  return shown(length, Quantity::kLength, settings_.units(), 3);
}

double SurfaceTool::bodySize() const {
  const auto [low, high] = modeling::boundingBox(editor_.project().body);
  return (high - low).maxCoeff();
}

bool namesPatch(const modeling::Region& region, const std::string& patch) {
  return std::any_of(region.parts.begin(), region.parts.end(), [&](const auto& part) {
    const auto* set = std::get_if<modeling::PatchSet>(&part);
    return set && std::find(set->patches.begin(), set->patches.end(), patch) != set->patches.end();
  });
}

void setPatch(modeling::Region& region, const std::string& patch, bool isInside) {
  if (namesPatch(region, patch) == isInside) return;
  const auto isSet = [](const auto& part) {
    return std::holds_alternative<modeling::PatchSet>(part);
  };
  if (isInside) {
    const auto found = std::find_if(region.parts.begin(), region.parts.end(), isSet);
    if (found == region.parts.end())
      region.parts.emplace_back(modeling::PatchSet{{patch}});
    else
      std::get<modeling::PatchSet>(*found).patches.push_back(patch);
    return;
  }
  for (auto& part : region.parts)
    if (auto* set = std::get_if<modeling::PatchSet>(&part)) std::erase(set->patches, patch);
  std::erase_if(region.parts, [](const auto& part) {
    const auto* set = std::get_if<modeling::PatchSet>(&part);
    return set && set->patches.empty();
  });
}

}  // namespace palpa::gui

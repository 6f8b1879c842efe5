#include "app/cli/mesh_report.h"

#include "app/cli/text.h"
#include "base/count_text.h"

namespace palpa::cli {

std::string toText(const modeling::MeshSimplification& simplification) {
  const auto& [below, moved, vanishedFaces, partsBelow, cutPins, filledHoles] = simplification;
  if (!(below > 0)) return "";
  const auto count = [](int number, const char* noun, const char* what) {
    return countText(number) + ' ' + noun + (number == 1 ? " " : "s ") + what;
  };
  std::string text = format("simplified features below %.3g mm are meshed over", below);
  if (vanishedFaces > 0) text += " (" + count(vanishedFaces, "face", "vanished") + ')';
  if (cutPins + filledHoles > 0) {
    text += "; ";
    if (cutPins > 0) text += count(cutPins, "pin", "cut off");
    if (cutPins > 0 && filledHoles > 0) text += " and ";
    if (filledHoles > 0) text += count(filledHoles, "hole", "filled");
    text += format(", all below %.3g mm", partsBelow);
  }
  return text + format("; the surface moved by up to %.3g mm\n", moved);
}

void addTo(Json& report, const modeling::MeshSimplification& simplification) {
  const auto& [below, moved, vanishedFaces, partsBelow, cutPins, filledHoles] = simplification;
  if (below > 0)
    report["simplified"] = {
        {"features_below_mm", below},   {"moved_mm", moved},   {"vanished_faces", vanishedFaces},
        {"parts_below_mm", partsBelow}, {"cut_pins", cutPins}, {"filled_holes", filledHoles}};
}

Json toJson(const modeling::SurfaceMesh& mesh, const modeling::MeshQuality& quality) {
  Json report{{"nodes", mesh.positions.size()},
              {"triangles", mesh.triangles.size()},
              {"quality",
               {{"smallest_angle_degrees", quality.smallestAngle},
                {"largest_aspect", quality.largestAspect},
                {"shortest_edge_mm", quality.shortestEdge},
                {"mean_edge_mm", quality.meanEdge},
                {"longest_edge_mm", quality.longestEdge}}}};
  addTo(report, mesh.simplification);
  return report;
}

std::string toText(const modeling::SurfaceMesh& mesh, const modeling::MeshQuality& quality) {
  return "mesh       " + countText(mesh.positions.size()) + " nodes, " +
         countText(mesh.triangles.size()) + " triangles\n" +
         format("edges      %.3g … %.3g mm, mean %.3g mm\n", quality.shortestEdge,
                quality.longestEdge, quality.meanEdge) +
         format("quality    smallest angle %.1f°, largest aspect %.2f\n", quality.smallestAngle,
                quality.largestAspect) +
         toText(mesh.simplification);
}

}  // namespace palpa::cli

#include "app/cli/mesh_report.h"

#include "app/cli/text.h"
#include "app/report/state_words.h"
#include "base/count_text.h"

namespace palpa::cli {

std::string toText(const modeling::MeshSimplification& simplification) {
  const std::string text = report::simplificationText(simplification);
  return text.empty() ? text : "simplified " + text + "\n";
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

#include "app/cli/mesh_report.h"

#include "app/cli/text.h"
#include "base/count_text.h"

namespace palpa::cli {

namespace {

std::string simplificationText(const modeling::MeshSimplification& simplification) {
  const auto& [below, moved, vanishedFaces] = simplification;
  if (!(below > 0)) return "";
  const std::string faces = vanishedFaces > 0
                                ? " (" + countText(vanishedFaces) +
                                      (vanishedFaces == 1 ? " face" : " faces") + " vanished)"
                                : "";
  return format(
      "simplified features below %.3g mm are meshed over%s; the surface moved by up to %.3g mm\n",
      below, faces.c_str(), moved);
}

}  // namespace

Json toJson(const modeling::SurfaceMesh& mesh, const modeling::MeshQuality& quality) {
  Json report{{"nodes", mesh.positions.size()},
              {"triangles", mesh.triangles.size()},
              {"quality",
               {{"smallest_angle_degrees", quality.smallestAngle},
                {"largest_aspect", quality.largestAspect},
                {"shortest_edge_mm", quality.shortestEdge},
                {"mean_edge_mm", quality.meanEdge},
                {"longest_edge_mm", quality.longestEdge}}}};
  if (const auto& [below, moved, vanishedFaces] = mesh.simplification; below > 0)
    report["simplified"] = {
        {"features_below_mm", below}, {"moved_mm", moved}, {"vanished_faces", vanishedFaces}};
  return report;
}

std::string toText(const modeling::SurfaceMesh& mesh, const modeling::MeshQuality& quality) {
  return "mesh       " + countText(mesh.positions.size()) + " nodes, " +
         countText(mesh.triangles.size()) + " triangles\n" +
         format("edges      %.3g … %.3g mm, mean %.3g mm\n", quality.shortestEdge,
                quality.longestEdge, quality.meanEdge) +
         format("quality    smallest angle %.1f°, largest aspect %.2f\n", quality.smallestAngle,
                quality.largestAspect) +
         simplificationText(mesh.simplification);
}

}  // namespace palpa::cli

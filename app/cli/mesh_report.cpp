#include "app/cli/mesh_report.h"

#include "app/cli/text.h"
#include "base/count_text.h"

namespace palpa::cli {

Json toJson(const modeling::SurfaceMesh& mesh, const modeling::MeshQuality& quality) {
  return {{"nodes", mesh.positions.size()},
          {"triangles", mesh.triangles.size()},
          {"quality",
           {{"smallest_angle_degrees", quality.smallestAngle},
            {"largest_aspect", quality.largestAspect},
            {"shortest_edge_mm", quality.shortestEdge},
            {"mean_edge_mm", quality.meanEdge},
            {"longest_edge_mm", quality.longestEdge}}}};
}

std::string toText(const modeling::SurfaceMesh& mesh, const modeling::MeshQuality& quality) {
  return "mesh       " + countText(mesh.positions.size()) + " nodes, " +
         countText(mesh.triangles.size()) + " triangles\n" +
         format("edges      %.3g … %.3g mm, mean %.3g mm\n", quality.shortestEdge,
                quality.longestEdge, quality.meanEdge) +
         format("quality    smallest angle %.1f°, largest aspect %.2f\n", quality.smallestAngle,
                quality.largestAspect);
}

}  // namespace palpa::cli

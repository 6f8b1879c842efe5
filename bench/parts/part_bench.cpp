// One part of another program, touched by Palpa and by CalculiX on a mesh made independently by
// Gmsh: prints a line of CSV (--header: the names of its columns). The exit status is 3 with a
// reason on standard error if the part is left out. Called by scripts/compare-calculix.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <deque>
#include <map>
#include <numeric>
#include <set>

#include "bench/parts/calculix_grab.h"
#include "bench/parts/gmsh.h"
#include "bench/parts/part_touch.h"
#include "bench/timing.h"

namespace {

using namespace palpa;
using bench::LeftOut;
using bench::TetrahedralMesh;
using Eigen::Vector3d;

constexpr int kLeftOut = 3;
constexpr std::size_t kMaxTouchedNodes = 1500;  // the constraint couples all of them
constexpr double kRatio = 1.6;                  // of the sizes of two meshes

constexpr const char* kHeader =
    "part,faces,engine,palpa_nodes,palpa_seconds,support,radius_mm,wished_radius_mm,depth_mm,"
    "palpa_N,stated_error_N,coarse_nodes,fine_nodes,coarse_N,fine_N,force_difference_N,calculix_"
    "seconds,volume_difference";

/// The mesh with only those faces that are connected with the touched one within the mask, as in
/// Palpa: the far side of a thin body stays free.
TetrahedralMesh touchedFaces(const TetrahedralMesh& mesh, const Vector3d& at, double radius) {
  const auto reaches = [&](const std::array<int, 6>& face) {
    for (const int node : face)
      if ((mesh.nodes[node] - at).norm() < radius) return true;
    return false;
  };
  std::map<std::pair<int, int>, std::vector<std::size_t>> facesOfEdge;
  std::size_t nearest = 0;
  double least = 1e300;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& n = mesh.faces[f];
    for (std::size_t k = 0; k < 3; ++k) facesOfEdge[std::minmax(n[k], n[(k + 1) % 3])].push_back(f);
    const double d = ((mesh.nodes[n[0]] + mesh.nodes[n[1]] + mesh.nodes[n[2]]) / 3 - at).norm();
    if (d < least) least = d, nearest = f;
  }
  std::set<std::size_t> kept{nearest};
  for (std::deque<std::size_t> open{nearest}; !open.empty(); open.pop_front()) {
    const auto& n = mesh.faces[open.front()];
    for (std::size_t k = 0; k < 3; ++k)
      for (const std::size_t other : facesOfEdge[std::minmax(n[k], n[(k + 1) % 3])])
        if (reaches(mesh.faces[other]) && kept.insert(other).second) open.push_back(other);
  }
  TetrahedralMesh part;
  part.isQuadratic = mesh.isQuadratic;
  part.nodes = mesh.nodes;
  for (const std::size_t f : kept) part.faces.push_back(mesh.faces[f]);
  return part;
}

/// Volume inside the curved faces, mm³.
double enclosedVolume(const TetrahedralMesh& mesh) {
  std::vector<int> all(mesh.faces.size());
  std::iota(all.begin(), all.end(), 0);
  double sum = 0;
  visitFaces(mesh, all, 1,
             [&](int, const bench::FaceFunctions&, const Vector3d& x, const Vector3d& area) {
               sum += x.dot(area) / 3;
             });
  return std::abs(sum);
}

struct Reference {
  int nodes = 0;
  double volume = 0;
  bench::CalculixGrab grab;
};

Reference solve(const bench::GmshPart& gmsh, const bench::PartTouch& part, double fineness,
                double size) {
  const double largest = fineness * size * 3 * part.volume / part.area;
  const TetrahedralMesh mesh =
      gmsh.mesh({largest, largest / 6, std::min(largest, fineness * part.radius / 4)});
  const bench::SurfaceMask mask =
      makeSurfaceMask(touchedFaces(mesh, part.at, part.radius), part.at, part.radius);
  if (mask.nodes.size() > kMaxTouchedNodes)
    throw LeftOut("the touch covers " + std::to_string(mask.nodes.size()) + " nodes of Gmsh");
  std::fprintf(stderr, "gmsh       %d nodes, %zu tetrahedra, %zu nodes touched\n", mesh.nodeCount(),
               mesh.tetrahedra.size(), mask.nodes.size());
  Reference found{mesh.nodeCount(), enclosedVolume(mesh),
                  grabWithCalculix(mesh, part.material, mask, part.displacement)};
  const Vector3d& f = found.grab.force;
  std::fprintf(stderr, "calculix   (%.6g, %.6g, %.6g) N, %.1f s\n", f.x(), f.y(), f.z(),
               found.grab.seconds);
  return found;
}

void compare(const std::string& file, double size, int maxNodes, int maxReferenceNodes) {
  const bench::PartTouch part = bench::touchPart(file, maxNodes);
  const double palpa = part.force.norm();
  std::fprintf(stderr,
               "palpa      %s, %d nodes, (%.6g, %.6g, %.6g) N ± %.2g %%, %.1f s\n"
               "touch      at (%.6g, %.6g, %.6g) mm, radius %.4g mm (wished %.4g)\n",
               part.engine.c_str(), part.nodes, part.force.x(), part.force.y(), part.force.z(),
               100 * part.error, part.seconds, part.at.x(), part.at.y(), part.at.z(), part.radius,
               part.wishedRadius);
  const bench::GmshPart gmsh(file, part);
  Reference coarse, fine;
  const double seconds = bench::secondsFor([&] {
    coarse = solve(gmsh, part, 1, size);
    if (coarse.nodes * kRatio * kRatio * kRatio > maxReferenceNodes)
      throw LeftOut("the reference would need about " +
                    std::to_string(static_cast<int>(coarse.nodes * kRatio * kRatio * kRatio)) +
                    " nodes");
    fine = solve(gmsh, part, 1 / kRatio, size);
  });
  std::string name = std::filesystem::path(file).stem();
  std::replace(name.begin(), name.end(), ',', '.');  // a field of a table
  const Vector3d difference = part.force - fine.grab.force;
  std::printf("%s,%d,%s,%d,%.1f,\"%s\",%.4g,%.4g,%.4g,%.6g,%.3g,%d,%d,%.6g,%.6g,%.3g,%.0f,%.2g\n",
              name.c_str(), part.faces, part.engine.c_str(), part.nodes, part.seconds,
              part.support.c_str(), part.radius, part.wishedRadius, part.displacement.norm(), palpa,
              part.error * palpa, coarse.nodes, fine.nodes, coarse.grab.force.norm(),
              fine.grab.force.norm(), difference.norm(), seconds, part.volume / fine.volume - 1);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"A part touched by Palpa and by CalculiX"};
  std::string file;
  bool printsHeader = false;
  double size = 0.8;
  int maxNodes = 3000, maxReferenceNodes = 120000;
  options.add_option("file", file, "CAD file with one solid");
  options.add_flag("--header", printsHeader, "Print the names of the columns");
  options.add_option("--size", size,
                     "Size of the elements of the coarser mesh, in 3 volume / area of the part");
  options.add_option("--max-nodes", maxNodes, "Largest mesh of Palpa");
  options.add_option("--max-reference-nodes", maxReferenceNodes, "Largest mesh for CalculiX");
  CLI11_PARSE(options, argc, argv);
  try {
    if (printsHeader) std::printf("%s\n", kHeader);
    if (!file.empty())
      compare(std::filesystem::absolute(file).string(), size, maxNodes, maxReferenceNodes);
  } catch (const LeftOut& reason) {
    std::fprintf(stderr, "left out: %s\n", reason.what());
    return kLeftOut;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "left out: %s\n", error.what());
    return kLeftOut;
  }
  return 0;
}

#include "bench/parts/calculix_grab.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>

#include "bench/parts/part_touch.h"
#include "bench/peers/external_program.h"

namespace palpa::bench {
namespace {

using Eigen::Vector3d;
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

constexpr const char* kSeconds = "550";

/// Σ w u - u(reference) = 0 for an axis, the largest weight first: its unknown is eliminated.
void writeConstraint(std::FILE* file, const SurfaceMask& mask, const std::vector<char>& isFixed,
                     int axis, int reference) {
  std::vector<std::pair<double, int>> terms;
  for (std::size_t k = 0; k < mask.nodes.size(); ++k)
    if (!isFixed[mask.nodes[k]] && mask.weights[k] != 0)
      terms.emplace_back(mask.weights[k], mask.nodes[k] + 1);
  std::sort(terms.rbegin(), terms.rend());
  terms.emplace_back(-1.0, reference);
  std::fprintf(file, "*EQUATION\n%zu", terms.size());
  for (std::size_t k = 0; k < terms.size(); ++k)
    std::fprintf(file, "%s%d, %d, %.11g", k % 4 == 0 ? "\n" : ", ", terms[k].second, axis + 1,
                 terms[k].first);
  std::fprintf(file, "\n");
}

void writeInput(const TetrahedralMesh& mesh, const bem::Material& material, const SurfaceMask& mask,
                const Vector3d& displacement, const std::filesystem::path& path) {
  const File file(std::fopen(path.c_str(), "w"), &std::fclose);
  if (!file) throw std::runtime_error("cannot write " + path.string());
  const auto print = [&](const char* format, auto... values) {
    std::fprintf(file.get(), format, values...);
  };
  std::vector<char> isFixed(mesh.nodes.size(), 0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (int k = 0; mesh.tags[f] != 0 && k < mesh.faceNodes(); ++k) isFixed[mesh.faces[f][k]] = 1;
  const int reference = mesh.nodeCount() + 1;
  print("*NODE\n");
  for (int k = 0; k < mesh.nodeCount(); ++k)
    print("%d, %.11g, %.11g, %.11g\n", k + 1, mesh.nodes[k].x(), mesh.nodes[k].y(),
          mesh.nodes[k].z());
  print("%d, 0, 0, 0\n*NSET, NSET=SUPPORT\n", reference);
  for (int k = 0; k < mesh.nodeCount(); ++k)
    if (isFixed[k]) print("%d\n", k + 1);
  print("*ELEMENT, TYPE=C3D10, ELSET=BODY\n");
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    print("%zu", t + 1);
    for (const int node : mesh.tetrahedra[t]) print(", %d", node + 1);
    print("\n");
  }
  print("*MATERIAL, NAME=M\n*ELASTIC\n%.11g, %.11g\n", material.youngsModulus,
        material.poissonRatio);
  print("*SOLID SECTION, ELSET=BODY, MATERIAL=M\n");
  for (int axis = 0; axis < 3; ++axis) writeConstraint(file.get(), mask, isFixed, axis, reference);
  print("*BOUNDARY\nSUPPORT, 1, 3\n*STEP\n*STATIC\n*BOUNDARY\n");
  for (int axis = 0; axis < 3; ++axis)
    print("%d, %d, %d, %.11g\n", reference, axis + 1, axis + 1, displacement[axis]);
  // CalculiX prints no reaction of a node without elements, so the support's reactions are summed.
  print("*NODE PRINT, NSET=SUPPORT, TOTALS=ONLY\nRF\n*END STEP\n");
}

/// The total of a set from the text results: three numbers on the second line after its name.
Vector3d totalOf(const std::string& set, const std::filesystem::path& path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.find("total force") == std::string::npos || line.find(" " + set) == std::string::npos)
      continue;
    Vector3d total;
    if (file >> total[0] >> total[1] >> total[2]) return total;
  }
  throw LeftOut("CalculiX gave no force of the set " + set);
}

}  // namespace

CalculixGrab grabWithCalculix(const TetrahedralMesh& mesh, const bem::Material& material,
                              const SurfaceMask& mask, const Vector3d& displacement) {
  const std::string ccx = findProgram("ccx");
  if (ccx.empty()) throw std::runtime_error("ccx (CalculiX) is not installed");
  const ExchangeFolder folder;
  writeInput(mesh, material, mask, displacement, folder.path() / "grab.inp");
  for (const char* name : {"OMP_NUM_THREADS", "CCX_NPROC_EQUATION_SOLVER"}) setenv(name, "2", 1);
  CalculixGrab result;
  try {
    result.seconds =
        runProgram({findProgram("timeout"), kSeconds, ccx, "grab"}, folder.path(), "ccx.log")
            .seconds;
  } catch (const std::runtime_error& error) {
    throw LeftOut(std::string("CalculiX fails: ") + error.what());
  }
  result.force = -totalOf("SUPPORT", folder.path() / "grab.dat");
  return result;
}

}  // namespace palpa::bench

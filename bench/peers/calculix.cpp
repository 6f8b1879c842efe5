#include "bench/peers/calculix.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <thread>

#include "bench/peers/external_program.h"
#include "bench/peers/surface_mask.h"
#include "bench/timing.h"

namespace palpa::bench {
namespace {

using Eigen::Vector3d;
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

void writeInput(const TetrahedralMesh& mesh, const bem::Material& material,
                const std::vector<char>& isHeld, const SurfaceMask& mask, const Vector3d& direction,
                const std::filesystem::path& path) {
  const File file(std::fopen(path.c_str(), "w"), &std::fclose);
  if (!file) throw std::runtime_error("cannot write " + path.string());
  // CalculiX reads 20 characters of a number, sign and exponent included.
  const auto print = [&](const char* format, auto... values) {
    std::fprintf(file.get(), format, values...);
  };
  print("*NODE, NSET=ALL\n");
  for (int k = 0; k < mesh.nodeCount(); ++k)
    print("%d, %.11g, %.11g, %.11g\n", k + 1, mesh.nodes[k].x(), mesh.nodes[k].y(),
          mesh.nodes[k].z());
  print("*ELEMENT, TYPE=C3D10, ELSET=BODY\n");
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    print("%zu", t + 1);
    for (const int node : mesh.tetrahedra[t]) print(", %d", node + 1);
    print("\n");
  }
  print("*MATERIAL, NAME=M\n*ELASTIC\n%.11g, %.11g\n", material.youngsModulus,
        material.poissonRatio);
  print("*SOLID SECTION, ELSET=BODY, MATERIAL=M\n*BOUNDARY\n");
  for (int k = 0; k < mesh.nodeCount(); ++k)
    if (isHeld[k]) print("%d, 1, 3\n", k + 1);
  print("*STEP\n*STATIC\n*CLOAD\n");
  for (std::size_t k = 0; k < mask.nodes.size(); ++k)
    for (int c = 0; c < 3; ++c)
      if (const double force = mask.weights[k] * direction[c]; force != 0 && !isHeld[mask.nodes[k]])
        print("%d, %d, %.11g\n", mask.nodes[k] + 1, c + 1, force);
  print("*NODE FILE\nU\n*END STEP\n");
}

/// Displacements of all nodes from the result file (.frd), whose numbers stand in fixed columns.
std::vector<Vector3d> readDisplacements(const std::filesystem::path& path, int nodeCount) {
  std::ifstream file(path);
  std::vector<Vector3d> u(static_cast<std::size_t>(nodeCount), Vector3d::Zero());
  bool isInside = false;
  int found = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(" -4")) isInside = line.find("DISP") != std::string::npos;
    if (!isInside || !line.starts_with(" -1") || line.size() < 49) continue;
    const int node = std::atoi(line.substr(3, 10).c_str());
    if (node < 1 || node > nodeCount) throw std::runtime_error("CalculiX names a node unknown");
    for (int c = 0; c < 3; ++c)
      u[node - 1][c] = std::atof(line.substr(static_cast<std::size_t>(13 + 12 * c), 12).c_str());
    ++found;
  }
  if (found != nodeCount) throw std::runtime_error("CalculiX gave no displacements");
  return u;
}

}  // namespace

CalculixResult pushWithCalculix(const TetrahedralMesh& mesh, const bem::Material& material,
                                const Vector3d& at, double radius, const Vector3d& direction) {
  const std::string program = findProgram("ccx");
  if (program.empty()) throw std::runtime_error("ccx (CalculiX) is not installed");
  std::vector<char> isHeld(mesh.nodes.size(), 0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (int k = 0; mesh.tags[f] != 0 && k < mesh.faceNodes(); ++k) isHeld[mesh.faces[f][k]] = 1;
  CalculixResult result;
  for (const char held : isHeld) result.unknowns += held ? 0 : 3;
  const std::string threads = std::to_string(std::max(1U, std::thread::hardware_concurrency()));
  for (const char* name : {"OMP_NUM_THREADS", "CCX_NPROC_EQUATION_SOLVER"})
    setenv(name, threads.c_str(), 1);
  result.seconds = secondsFor([&] {
    const ExchangeFolder folder;
    const SurfaceMask mask = makeSurfaceMask(mesh, at, radius);
    writeInput(mesh, material, isHeld, mask, direction, folder.path() / "push.inp");
    result.peakBytes = runProgram({program, "push"}, folder.path(), "ccx.log").peakBytes;
    const std::vector<Vector3d> u = readDisplacements(folder.path() / "push.frd", mesh.nodeCount());
    for (std::size_t k = 0; k < mask.nodes.size(); ++k)
      result.compliance += mask.weights[k] * direction.dot(u[mask.nodes[k]]);
  });
  return result;
}

}  // namespace palpa::bench

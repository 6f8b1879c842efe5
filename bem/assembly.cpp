#include "bem/assembly.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bem/assembly_kernel.h"
#include "bem/flat_triangle_integrals.h"
#include "bem/lending_pool.h"
#include "bem/parallel.h"

namespace palpa::bem {
namespace {

/// Distances (over the element's radius) from which the two rules keep a tolerance. A rule of
/// degree k integrates N K with N linear, so its relative error falls like ratio^-k: measured in
/// tests/bem/integration_test.cpp over random triangles up to 30:1, nu in (-1, 0.5] and all
/// directions, at most 0.23 ratio^-5 (7 points) and 0.04 ratio^-8 (16 points); the worst are
/// blocks of T at nu = 0.5 in nearly coplanar positions.
QuadratureRange quadratureRange(double tolerance) {
  return {0.68 * std::pow(tolerance, -1.0 / 8.0), 0.75 * std::pow(tolerance, -1.0 / 5.0)};
}

/// Element data in the form the assembly loop reads.
struct ElementTable {
  std::vector<FlatTriangle> triangles;
  struct Corners {
    double position[3][3];
  };
  std::vector<Corners> corners;

  explicit ElementTable(const BoundaryMesh& mesh) : corners(mesh.triangles.size()) {
    triangles.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) corners[t].position[k][i] = mesh.nodes[mesh.triangles[t][k]][i];
      triangles.push_back(makeFlatTriangle(corners[t].position));
    }
  }
};

}  // namespace

template <class Scalar>
BoundaryOperators<Scalar> assemble(const BoundaryMesh& mesh, const TractionSlots& slots,
                                   const std::vector<CollocationPoint>& points,
                                   const Material& material, const AssemblyOptions& options,
                                   const Job& job) {
  material.validate();
  const auto m = static_cast<std::ptrdiff_t>(points.size());
  const ElementTable table(mesh);
  std::array<std::vector<double>, 3> position;
  for (int i = 0; i < 3; ++i) {
    position[i].resize(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) position[i][p] = points[p].position[i];
  }

  BoundaryOperators<Scalar> result{LargeMatrix<Scalar>(3 * m, 3 * mesh.nodeCount()),
                                   LargeMatrix<Scalar>(3 * m, 3 * slots.count())};
  AssemblyTask<Scalar> task{};
  for (int i = 0; i < 3; ++i) task.position[i] = position[i].data();
  task.pointCount = m;
  std::vector<std::array<int, 3>> hostNodes;
  std::vector<std::array<double, 3>> hostWeights;
  for (const CollocationPoint& p : points) {
    hostNodes.push_back(mesh.triangles[p.triangle]);
    hostWeights.push_back({p.weights[0], p.weights[1], p.weights[2]});
  }
  task.hostNodes = hostNodes.front().data();
  task.hostWeights = hostWeights.front().data();
  task.displacementCount = mesh.nodeCount();
  task.tractionCount = slots.count();
  task.triangles = table.triangles.data();
  task.corners = &table.corners.front().position[0][0];
  task.displacementOfCorner = mesh.triangles.front().data();
  task.tractionOfCorner = slots.ofCorner.front().data();
  task.triangleCount = mesh.triangleCount();
  task.range = quadratureRange(std::clamp(options.tolerance, 1e-9, 1e-3));
  task.rule7 = triangleRule7().data();
  task.rule16 = triangleRule16().data();
  const RuleProducts<7> products7(task.rule7);
  const RuleProducts<16> products16(task.rule16);
  task.products7 = products7.weight;
  task.products16 = products16.weight;
  task.shear = material.shear();
  task.poissonRatio = material.poissonRatio;
  task.H = result.H.data();
  task.G = result.G.data();
  task.cancelled = [](const void* token) {
    return static_cast<const std::stop_token*>(token)->stop_requested();
  };
  task.cancelledContext = &job.stop;
  const AssembleRows<Scalar> assembleRows = assembleRowsForThisProcessor<Scalar>();

  // Tiles are lent from a stack, one per working thread.
  constexpr std::size_t kBlock = 9 * kTilePoints;
  const std::size_t tileSize = kBlock * (task.displacementCount + task.tractionCount);
  LendingPool<LargeMatrix<double>> pool(
      [tileSize] { return LargeMatrix<double>(static_cast<Eigen::Index>(tileSize), 1); });
  parallelFor((m + kTilePoints - 1) / kTilePoints, job, "assemble", [&](std::ptrdiff_t index) {
    AssemblyTask<Scalar> part = task;
    part.pointBegin = index * kTilePoints;
    part.pointEnd = std::min(m, part.pointBegin + kTilePoints);
    auto tile = pool.take();
    part.tileH = tile.data();
    part.tileG = tile.data() + kBlock * task.displacementCount;
    assembleRows(part);
    pool.giveBack(std::move(tile));
  });
  return result;
}

template BoundaryOperators<double> assemble(const BoundaryMesh&, const TractionSlots&,
                                            const std::vector<CollocationPoint>&, const Material&,
                                            const AssemblyOptions&, const Job&);
template BoundaryOperators<float> assemble(const BoundaryMesh&, const TractionSlots&,
                                           const std::vector<CollocationPoint>&, const Material&,
                                           const AssemblyOptions&, const Job&);

}  // namespace palpa::bem

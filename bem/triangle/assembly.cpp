#include "bem/triangle/assembly.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/triangle/assembly_kernel.h"
#include "bem/triangle/flat_triangle_integrals.h"

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
  struct Corners {
    double position[3][3];
  };
  std::vector<FlatTriangle> triangles;
  std::vector<Corners> corners;
  std::vector<std::array<int, 3>> coefficients, slots;  ///< of the corners
  int coefficientCount = 0, slotCount = 0;

  ElementTable(const BoundaryMesh& mesh, const TractionSlots& tractions)
      : coefficients(mesh.triangles),
        slots(tractions.ofCorner),
        coefficientCount(mesh.nodeCount()),
        slotCount(tractions.count()) {
    for (int t = 0; t < mesh.triangleCount(); ++t) add(mesh, t);
  }
  /// The triangles of a part; coefficients and slots are numbered within it.
  ElementTable(const BoundaryMesh& mesh, const TractionSlots& tractions, const ElementPart& part)
      : coefficientCount(static_cast<int>(part.coefficients.size())),
        slotCount(static_cast<int>(part.slots.size())) {
    const std::vector<int> coefficientIn = placesIn(part.coefficients, mesh.nodeCount()),
                           slotIn = placesIn(part.slots, tractions.count());
    const auto translated = [](const std::array<int, 3>& of, const std::vector<int>& into) {
      return std::array<int, 3>{into[of[0]], into[of[1]], into[of[2]]};
    };
    for (const int t : part.elements) {
      add(mesh, t);
      coefficients.push_back(translated(mesh.triangles[t], coefficientIn));
      slots.push_back(translated(tractions.ofCorner[t], slotIn));
    }
  }

 private:
  void add(const BoundaryMesh& mesh, int triangle) {
    Corners& place = corners.emplace_back();
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) place.position[k][i] = mesh.nodes[mesh.triangles[triangle][k]][i];
    triangles.push_back(makeFlatTriangle(place.position));
  }
};

/// Collocation points in the form the assembly loop reads.
struct PointTable {
  std::array<std::vector<double>, 3> position;
  std::vector<std::array<int, 3>> hostNodes;
  std::vector<std::array<double, 3>> hostWeights;

  PointTable(const BoundaryMesh& mesh, const std::vector<CollocationPoint>& points) {
    for (const CollocationPoint& p : points) {
      for (int i = 0; i < 3; ++i) position[i].push_back(p.position[i]);
      hostNodes.push_back(mesh.triangles[p.triangle]);
      hostWeights.push_back({p.weights[0], p.weights[1], p.weights[2]});
    }
  }

  /// Numbers hosts within a part; points with a host outside of it have no free term.
  void translate(const std::vector<int>& coefficientIn) {
    for (std::size_t p = 0; p < hostNodes.size(); ++p) {
      bool isInside = true;
      for (int k = 0; k < 3; ++k) {
        int& host = hostNodes[p][k];
        host = coefficientIn[host];
        isInside = isInside && (host >= 0 || hostWeights[p][k] == 0);
        host = std::max(host, 0);
      }
      if (!isInside) hostWeights[p] = {0, 0, 0};
    }
  }
};

template <class Scalar>
BoundaryOperators<Scalar> assembleTables(const ElementTable& elements, const PointTable& points,
                                         const Material& material, const AssemblyOptions& options,
                                         std::optional<Phase> phase, const Job& job) {
  material.validate();
  const auto m = static_cast<std::ptrdiff_t>(points.hostNodes.size());
  BoundaryOperators<Scalar> result{
      LargeMatrix<Scalar>(3 * m, static_cast<Eigen::Index>(3) * elements.coefficientCount),
      LargeMatrix<Scalar>(3 * m, static_cast<Eigen::Index>(3) * elements.slotCount)};
  if (m == 0 || elements.triangles.empty()) return result;
  AssemblyTask<Scalar> task{};
  for (int i = 0; i < 3; ++i) task.position[i] = points.position[i].data();
  task.pointCount = m;
  task.hostNodes = points.hostNodes.front().data();
  task.hostWeights = points.hostWeights.front().data();
  task.displacementCount = elements.coefficientCount;
  task.tractionCount = elements.slotCount;
  task.triangles = elements.triangles.data();
  task.corners = &elements.corners.front().position[0][0];
  task.displacementOfCorner = elements.coefficients.front().data();
  task.tractionOfCorner = elements.slots.front().data();
  task.triangleCount = static_cast<std::ptrdiff_t>(elements.triangles.size());
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

  // One tile per working thread.
  constexpr std::size_t kBlock = 9 * kTilePoints;
  const std::size_t tileSize = kBlock * (task.displacementCount + task.tractionCount);
  ScratchPool<LargeMatrix<double>> pool(
      [tileSize] { return LargeMatrix<double>(static_cast<Eigen::Index>(tileSize), 1); });
  parallelFor((m + kTilePoints - 1) / kTilePoints, job, phase, [&](std::ptrdiff_t index) {
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

}  // namespace

template <class Scalar>
BoundaryOperators<Scalar> assemble(const BoundaryMesh& mesh, const TractionSlots& slots,
                                   const std::vector<CollocationPoint>& points,
                                   const Material& material, const AssemblyOptions& options,
                                   const Job& job) {
  return assembleTables<Scalar>(ElementTable(mesh, slots), PointTable(mesh, points), material,
                                options, Phase::kAssemble, job);
}

template <class Scalar>
BoundaryOperators<Scalar> assemblePart(const BoundaryMesh& mesh, const TractionSlots& slots,
                                       const ElementPart& part,
                                       const std::vector<CollocationPoint>& points,
                                       const Material& material, const AssemblyOptions& options,
                                       const Job& job) {
  PointTable table(mesh, points);
  table.translate(placesIn(part.coefficients, mesh.nodeCount()));
  return assembleTables<Scalar>(ElementTable(mesh, slots, part), table, material, options,
                                std::nullopt, job);
}

template BoundaryOperators<double> assemble(const BoundaryMesh&, const TractionSlots&,
                                            const std::vector<CollocationPoint>&, const Material&,
                                            const AssemblyOptions&, const Job&);
template BoundaryOperators<float> assemble(const BoundaryMesh&, const TractionSlots&,
                                           const std::vector<CollocationPoint>&, const Material&,
                                           const AssemblyOptions&, const Job&);
template BoundaryOperators<double> assemblePart(const BoundaryMesh&, const TractionSlots&,
                                                const ElementPart&,
                                                const std::vector<CollocationPoint>&,
                                                const Material&, const AssemblyOptions&,
                                                const Job&);
template BoundaryOperators<float> assemblePart(const BoundaryMesh&, const TractionSlots&,
                                               const ElementPart&,
                                               const std::vector<CollocationPoint>&,
                                               const Material&, const AssemblyOptions&, const Job&);

}  // namespace palpa::bem

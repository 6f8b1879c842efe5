#include "bem/assembly.h"

#include <algorithm>
#include <array>

#include "bem/assembly_kernel.h"
#include "bem/parallel.h"

namespace palpa::bem {
namespace {

/// Points per task: small enough to cancel and balance, large enough to reuse an element's data.
constexpr std::ptrdiff_t kPointsPerTask = 128;

/// Distances (over the element's radius) from which the two rules keep a tolerance; measured
/// against the closed form in extended range by tests/bem/integration_test.cpp, which fails if they
/// are too optimistic. The error of a rule of degree k falls like ratio^-(k+1).
QuadratureRange quadratureRange(double tolerance) {
  return {0.75 * std::pow(tolerance, -1.0 / 9.0), 1.0 * std::pow(tolerance, -1.0 / 6.0)};
}

/// Completes rows [begin, end) of H: a translation of the whole body needs no traction, so each row
/// of 3 x 3 blocks sums to zero. What is missing is the free term (and, at a node, its own singular
/// block), which belongs to the coefficients that make up u(x).
template <class Scalar>
void addFreeTerm(const BoundaryMesh& mesh, const std::vector<CollocationPoint>& points,
                 std::ptrdiff_t begin, std::ptrdiff_t end, typename LargeMatrix<Scalar>::Map H) {
  const auto m = static_cast<std::ptrdiff_t>(points.size());
  const auto length = end - begin;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(length, 9);
  for (Eigen::Index column = 0; column < H.cols(); ++column)
    for (int i = 0; i < 3; ++i)
      sum.col(3 * i + column % 3) +=
          H.col(column).segment(i * m + begin, length).template cast<double>();
  for (std::ptrdiff_t p = begin; p < end; ++p)
    for (int corner = 0; corner < 3; ++corner) {
      const double weight = points[p].weights[corner];
      if (weight == 0) continue;
      const int node = mesh.triangles[points[p].triangle][corner];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          H(i * m + p, 3 * node + j) -= static_cast<Scalar>(weight * sum(p - begin, 3 * i + j));
    }
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
  task.triangles = table.triangles.data();
  task.corners = &table.corners.front().position[0][0];
  task.displacementOfCorner = mesh.triangles.front().data();
  task.tractionOfCorner = slots.ofCorner.front().data();
  task.triangleCount = mesh.triangleCount();
  task.range = quadratureRange(std::clamp(options.tolerance, 1e-12, 1e-3));
  task.rule7 = triangleRule7().data();
  task.rule16 = triangleRule16().data();
  task.shear = material.shear();
  task.poissonRatio = material.poissonRatio;
  task.H = result.H.data();
  task.G = result.G.data();
  task.cancelled = [](const void* token) {
    return static_cast<const std::stop_token*>(token)->stop_requested();
  };
  task.cancelledContext = &job.stop;
  const AssembleRows<Scalar> assembleRows = assembleRowsForThisProcessor<Scalar>();

  parallelFor((m + kPointsPerTask - 1) / kPointsPerTask, job, "assemble",
              [&](std::ptrdiff_t index) {
                AssemblyTask<Scalar> part = task;
                part.pointBegin = index * kPointsPerTask;
                part.pointEnd = std::min(m, part.pointBegin + kPointsPerTask);
                assembleRows(part);
                addFreeTerm<Scalar>(mesh, points, part.pointBegin, part.pointEnd, result.H.view());
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

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/verification/exact/simple_meshes.h"
#include "bem/base/instruction_set.h"
#include "bem/base/large_matrix.h"
#include "bem/model/boundary_mesh.h"
#include "bem/triangle/assembly_kernel.h"
#include "bem/triangle/flat_triangle_integrals.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

/// All blocks of a small sphere for points just below its nodes, by one instruction set. (At a node
/// its diagonal block of H is arbitrary until `assemble` replaces it.)
struct Assembled {
  LargeMatrix<double> H, G;

  Assembled(AssembleRows<double> assembleRows, const QuadratureRange& range) {
    const BoundaryMesh mesh = verification::sphereMesh(10, 5);
    const TractionSlots slots(mesh);
    const std::ptrdiff_t n = mesh.nodeCount();
    H = LargeMatrix<double>(3 * n, 3 * n);
    G = LargeMatrix<double>(3 * n, 3 * n);
    std::vector<double> position[3], corners;
    std::vector<FlatTriangle> triangles;
    for (const Vector3d& node : mesh.nodes)
      for (int i = 0; i < 3; ++i) position[i].push_back(0.97 * node[i]);
    // Zero weights omit the free term.
    const std::vector<int> hostNodes(3 * n, 0);
    const std::vector<double> hostWeights(3 * n, 0.0);
    for (const auto& t : mesh.triangles) {
      double c[3][3];
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) corners.push_back(c[k][i] = mesh.nodes[t[k]][i]);
      triangles.push_back(makeFlatTriangle(c));
    }
    AssemblyTask<double> task{};
    for (int i = 0; i < 3; ++i) task.position[i] = position[i].data();
    task.pointCount = n;
    task.hostNodes = hostNodes.data();
    task.hostWeights = hostWeights.data();
    task.displacementCount = task.tractionCount = n;
    task.triangles = triangles.data();
    task.corners = corners.data();
    task.displacementOfCorner = mesh.triangles.front().data();
    task.tractionOfCorner = slots.ofCorner.front().data();
    task.triangleCount = mesh.triangleCount();
    task.range = range;
    task.rule7 = triangleRule7().data();
    task.rule16 = triangleRule16().data();
    const RuleProducts<7> products7(task.rule7);
    const RuleProducts<16> products16(task.rule16);
    task.products7 = products7.weight;
    task.products16 = products16.weight;
    task.shear = 0.4;
    task.poissonRatio = 0.3;
    task.H = H.data();
    task.G = G.data();
    task.cancelled = [](const void*) { return false; };
    LargeMatrix<double> tileH(9 * kTilePoints, n), tileG(9 * kTilePoints, n);
    task.tileH = tileH.data();
    task.tileG = tileG.data();
    for (task.pointBegin = 0; task.pointBegin < n; task.pointBegin = task.pointEnd) {
      task.pointEnd = std::min<std::ptrdiff_t>(n, task.pointBegin + kTilePoints);
      assembleRows(task);
    }
  }
};

double difference(const LargeMatrix<double>& a, const LargeMatrix<double>& b) {
  return (a.view() - b.view()).lpNorm<Eigen::Infinity>() / b.view().lpNorm<Eigen::Infinity>();
}

/// A batch uses one kind of integration for all its points, and batches are 2, 4 or 8 wide. With
/// the real ranges the instruction sets would differ by the quadrature error where a batch
/// straddles a limit. Here each kind is used for all elements in turn, so only rounding remains.
void expectAgreement(AssembleRows<double> rows) {
  constexpr double kNever = 1e9;
  for (const QuadratureRange range :
       {QuadratureRange{kNever, kNever}, QuadratureRange{0, kNever}, QuadratureRange{0, 0}}) {
    const Assembled expected(assembleRowsBaseline, range), found(rows, range);
    EXPECT_LE(difference(found.H, expected.H), 1e-13);
    EXPECT_LE(difference(found.G, expected.G), 1e-13);
  }
}

TEST(InstructionSets, TheSelectedOneIsKnown) {
  const std::string name = instructionSetName();
  EXPECT_TRUE(name == "avx512" || name == "avx2" || name == "baseline") << name;
  expectAgreement(assembleRowsForThisProcessor<double>());
}

#ifdef __x86_64__
TEST(InstructionSets, Avx2AgreesWithTheBaseline) {
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    GTEST_SKIP() << "this processor has no AVX2";
  expectAgreement(assembleRowsAvx2);
}

TEST(InstructionSets, Avx512AgreesWithTheBaseline) {
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512dq") ||
      !__builtin_cpu_supports("avx512bw") || !__builtin_cpu_supports("avx512cd"))
    GTEST_SKIP() << "this processor has no AVX-512";
  expectAgreement(assembleRowsAvx512);
}
#endif

}  // namespace
}  // namespace palpa::bem

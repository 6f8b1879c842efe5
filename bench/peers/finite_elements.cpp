#include "bench/peers/finite_elements.h"

#include <Eigen/Dense>
#include <algorithm>
#include <span>

#include "base/parallel.h"
#include "bench/peers/tetrahedron_functions.h"

namespace palpa::bench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Sparse = Eigen::SparseMatrix<double>;

/// Gradients of the functions at the points of the rule, and the stiffness made of them:
///   K_ab = ∫ λ g_a g_b^T + μ (g_b g_a^T + g_a.g_b I) dV.
template <int Nodes>
class ElementStiffness {
 public:
  using Matrix = Eigen::Matrix<double, 3 * Nodes, 3 * Nodes>;

  ElementStiffness(const TetrahedralMesh& mesh, const std::array<int, 10>& element, double lambda,
                   double mu) {
    Eigen::Matrix<double, 3, Nodes> nodes;
    for (int k = 0; k < Nodes; ++k) nodes.col(k) = mesh.nodes[element[k]];
    // Of each pair, the sum of g_a g_b^T first: nine multiplications and additions per point.
    Eigen::Matrix<double, 3 * Nodes, 3 * Nodes> products = Matrix::Zero();
    for (const TetrahedronPoint& point : tetrahedronRule(Nodes == 10)) {
      Eigen::Matrix<double, Nodes, 3> slopes;
      if constexpr (Nodes == 10)
        slopes = quadraticSlopes(point.barycentric);
      else
        slopes = barycentricSlopes();
      const Matrix3d jacobian = nodes * slopes;
      const Eigen::Matrix<double, Nodes, 3> rows = slopes * jacobian.inverse();
      const Eigen::Matrix<double, 3, Nodes> gradients = rows.transpose();
      const Eigen::Map<const Eigen::Matrix<double, 3 * Nodes, 1>> all(gradients.data());
      products.noalias() += (jacobian.determinant() / 6 * point.weight * all) * all.transpose();
    }
    for (int b = 0; b < Nodes; ++b)
      for (int a = 0; a < Nodes; ++a) {
        const Matrix3d product = products.template block<3, 3>(3 * a, 3 * b);
        Matrix3d block = lambda * product + mu * product.transpose();
        block.diagonal().array() += mu * product.trace();
        stiffness.template block<3, 3>(3 * a, 3 * b) = block;
      }
  }

  Matrix stiffness;
};

/// For each node, in ascending order, the nodes that share an element with it.
std::vector<std::vector<int>> neighbours(const TetrahedralMesh& mesh, const Job& job) {
  std::vector<std::vector<int>> found(mesh.nodes.size());
  const int size = mesh.tetrahedronNodes();
  for (const auto& t : mesh.tetrahedra)
    for (int a = 0; a < size; ++a)
      found[t[a]].insert(found[t[a]].end(), t.begin(), t.begin() + size);
  constexpr std::ptrdiff_t kNodesPerTask = 1000;
  const auto count = static_cast<std::ptrdiff_t>(found.size());
  parallelFor((count + kNodesPerTask - 1) / kNodesPerTask, job, [&](std::ptrdiff_t task) {
    for (auto k = task * kNodesPerTask; k < std::min(count, (task + 1) * kNodesPerTask); ++k) {
      std::sort(found[k].begin(), found[k].end());
      found[k].erase(std::unique(found[k].begin(), found[k].end()), found[k].end());
    }
  });
  return found;
}

/// A matrix of 3 x 3 blocks with zeros at given places: of block columns `columns`, the rows
/// rowOf(neighbour) that are not negative; of diagonal blocks only the lower triangle.
Sparse blockPattern(int blockRows, const std::vector<int>& columns, bool isLower,
                    const std::vector<std::vector<int>>& neighboursOf,
                    const std::vector<int>& rowOf) {
  Sparse matrix(3 * blockRows, 3 * static_cast<Eigen::Index>(columns.size()));
  std::vector<int> begins{0}, rows;
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      for (const int other : neighboursOf[columns[k]]) {
        const int row = rowOf[other];
        if (row < 0 || (isLower && row < static_cast<int>(k))) continue;
        for (int i = isLower && row == static_cast<int>(k) ? c : 0; i < 3; ++i)
          rows.push_back(3 * row + i);
      }
      begins.push_back(static_cast<int>(rows.size()));
    }
  matrix.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
  std::copy(begins.begin(), begins.end(), matrix.outerIndexPtr());
  std::copy(rows.begin(), rows.end(), matrix.innerIndexPtr());
  std::fill_n(matrix.valuePtr(), rows.size(), 0.0);
  return matrix;
}

/// Adds a block below the diagonal, or the lower triangle of one on it.
void addBlock(Sparse& matrix, int row, int column, bool isDiagonal, const Matrix3d& block) {
  for (int c = 0; c < 3; ++c) {
    const int begin = matrix.outerIndexPtr()[3 * column + c],
              end = matrix.outerIndexPtr()[3 * column + c + 1];
    const int first = isDiagonal ? c : 0;
    const int* place = std::lower_bound(matrix.innerIndexPtr() + begin,
                                        matrix.innerIndexPtr() + end, 3 * row + first);
    double* value = matrix.valuePtr() + (place - matrix.innerIndexPtr());
    for (int i = first; i < 3; ++i) *value++ += block(i, c);
  }
}

template <int Nodes>
void assemble(const TetrahedralMesh& mesh, const bem::Material& material, const Job& job,
              FiniteElements& fem) {
  const double nu = material.poissonRatio, mu = material.shear();
  const double lambda = 2 * mu * nu / (1 - 2 * nu);
  // Element by element on all threads, then added on all threads, each to its columns.
  constexpr std::size_t kElements = 2048;
  constexpr std::ptrdiff_t kElementsPerTask = 128, kParts = 16;
  std::vector<Eigen::Matrix<double, 3 * Nodes, 3 * Nodes>> matrices(kElements);
  for (std::size_t first = 0; first < mesh.tetrahedra.size(); first += kElements) {
    const auto count =
        static_cast<std::ptrdiff_t>(std::min(kElements, mesh.tetrahedra.size() - first));
    parallelFor((count + kElementsPerTask - 1) / kElementsPerTask, job, [&](std::ptrdiff_t task) {
      for (auto k = task * kElementsPerTask; k < std::min(count, (task + 1) * kElementsPerTask);
           ++k)
        matrices[k] =
            ElementStiffness<Nodes>(mesh, mesh.tetrahedra[first + k], lambda, mu).stiffness;
    });
    parallelFor(kParts, job, [&](std::ptrdiff_t part) {
      for (std::ptrdiff_t k = 0; k < count; ++k) {
        const auto& nodes = mesh.tetrahedra[first + k];
        for (int b = 0; b < Nodes; ++b) {
          if (nodes[b] % kParts != part) continue;
          const int free = fem.freeOfNode[nodes[b]], held = fem.fixedOfNode[nodes[b]];
          for (int a = 0; a < Nodes; ++a) {
            const int row = fem.freeOfNode[nodes[a]];
            if (row < 0 || (free >= 0 && row < free)) continue;
            const Matrix3d block = matrices[k].template block<3, 3>(3 * a, 3 * b);
            if (free >= 0)
              addBlock(fem.stiffness, row, free, row == free, block);
            else
              addBlock(fem.coupling, row, held, false, block);
          }
        }
      }
    });
  }
}

}  // namespace

FiniteElements::FiniteElements(const TetrahedralMesh& mesh, const bem::Material& material,
                               const Job& job)
    : freeOfNode(mesh.nodes.size(), -1), fixedOfNode(mesh.nodes.size(), -1) {
  std::vector<char> isHeld(mesh.nodes.size(), 0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (int k = 0; mesh.tags[f] != 0 && k < mesh.faceNodes(); ++k) isHeld[mesh.faces[f][k]] = 1;
  std::vector<int> freeNodes, heldNodes;
  for (int k = 0; k < mesh.nodeCount(); ++k) {
    std::vector<int>& list = isHeld[k] ? heldNodes : freeNodes;
    (isHeld[k] ? fixedOfNode : freeOfNode)[k] = static_cast<int>(list.size());
    list.push_back(k);
  }
  freeCount = static_cast<int>(freeNodes.size());
  fixedCount = static_cast<int>(heldNodes.size());
  const auto near = neighbours(mesh, job);
  stiffness = blockPattern(freeCount, freeNodes, true, near, freeOfNode);
  coupling = blockPattern(freeCount, heldNodes, false, near, freeOfNode);
  if (mesh.isQuadratic)
    assemble<10>(mesh, material, job, *this);
  else
    assemble<4>(mesh, material, job, *this);
}

}  // namespace palpa::bench

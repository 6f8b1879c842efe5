#include "tetrahedra_test_meshes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <map>

namespace palpa::bench::test {
namespace {

using Eigen::Vector3d;

/// The unit cube by Kuhn's division: the six ways from one corner of a cell to the opposite one.
TetrahedralMesh unitCube(int cells) {
  TetrahedralMesh mesh;
  const int size = cells + 1;
  for (int k = 0; k < size; ++k)
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) mesh.nodes.push_back(Vector3d(i, j, k) / cells);
  const int step[3] = {1, size, size * size};
  for (int k = 0; k < cells; ++k)
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        int order[3] = {0, 1, 2};
        do {
          int node = i + size * (j + size * k);
          std::array<int, 10> t{node};
          for (int c = 0; c < 3; ++c) t[c + 1] = node += step[order[c]];
          const auto at = [&](int n) { return mesh.nodes[t[n]]; };
          if ((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) < 0) std::swap(t[1], t[2]);
          mesh.tetrahedra.push_back(t);
        } while (std::next_permutation(order, order + 3));
      }
  // The surface: sides of a tetrahedron that no other one has, seen from outside.
  std::map<std::array<int, 3>, std::array<int, 6>> open;
  for (const auto& t : mesh.tetrahedra)
    for (const auto& side : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
      std::array<int, 3> key{t[side[0]], t[side[1]], t[side[2]]};
      const std::array<int, 6> face{key[0], key[1], key[2]};
      std::sort(key.begin(), key.end());
      if (!open.erase(key)) open[key] = face;
    }
  for (const auto& [key, face] : open) {
    mesh.faces.push_back(face);
    mesh.tags.push_back(
        std::all_of(key.begin(), key.end(), [&](int node) { return mesh.nodes[node].z() == 0; })
            ? 1
            : 0);
  }
  return mesh;
}

}  // namespace

TetrahedralMesh boxOfTetrahedra(const Vector3d& size, int cells) {
  TetrahedralMesh mesh = unitCube(cells);
  for (Vector3d& node : mesh.nodes) node = node.cwiseProduct(size).eval();
  return mesh;
}

TetrahedralMesh ballOfTetrahedra(double radius, int cells) {
  TetrahedralMesh mesh = unitCube(cells);
  for (Vector3d& node : mesh.nodes) {
    const Vector3d centred = 2 * node - Vector3d::Ones();
    const double length = centred.norm();
    node = length > 0 ? Vector3d(radius * centred.cwiseAbs().maxCoeff() / length * centred)
                      : Vector3d::Zero();
  }
  return mesh;
}

}  // namespace palpa::bench::test

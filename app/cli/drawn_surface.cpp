#include "app/cli/drawn_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "bem/results.h"
#include "modeling/mesh/display_mesh.h"

namespace palpa::cli {
namespace {

using Eigen::Vector3d;
using modeling::DisplayMesh;
using view::ScalarField;

/// The sides of the nodes: one for every smoothing group that meets at a node. What jumps at sharp
/// edges has one value per side.
struct NodeSides {
  std::vector<std::array<int, 3>> ofCorner;   ///< per triangle
  std::map<std::pair<int, int>, int> ofNode;  ///< (node, smoothing group) -> side

  explicit NodeSides(const bem::BoundaryMesh& mesh) : ofCorner(mesh.triangles.size()) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::pair key(mesh.triangles[t][k], mesh.smoothingGroups[t]);
        ofCorner[t][k] = ofNode.emplace(key, static_cast<int>(ofNode.size())).first->second;
      }
    }
  }

  /// Value at a point of the drawn surface from one value per side.
  template <class Value>
  Value at(const DisplayMesh::Link& link, const std::vector<Value>& values) const {
    const auto& sides = ofCorner[static_cast<std::size_t>(link.triangle)];
    return link.weights[0] * values[static_cast<std::size_t>(sides[0])] +
           link.weights[1] * values[static_cast<std::size_t>(sides[1])] +
           link.weights[2] * values[static_cast<std::size_t>(sides[2])];
  }
};

Vector3d displacementAt(const DisplayMesh::Link& link, const bem::BoundaryMesh& mesh,
                        const app::TouchState& state) {
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const int node =
        mesh.triangles[static_cast<std::size_t>(link.triangle)][static_cast<std::size_t>(k)];
    sum += link.weights[k] * state.field.u.col(0).segment<3>(3 * node);
  }
  return sum;
}

/// Normals of the flat triangles at the sides of the nodes, weighted by area.
std::vector<Vector3d> sideNormals(const bem::BoundaryMesh& mesh, const NodeSides& sides,
                                  const app::TouchState& state, double scale) {
  std::vector<Vector3d> normals(sides.ofNode.size(), Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const auto at = [&](std::size_t k) -> Vector3d {
      return mesh.nodes[static_cast<std::size_t>(corners[k])] +
             scale * state.field.u.col(0).segment<3>(3 * corners[k]);
    };
    const Vector3d area = (at(1) - at(0)).cross(at(2) - at(0));
    for (const int side : sides.ofCorner[t]) normals[static_cast<std::size_t>(side)] += area;
  }
  for (Vector3d& normal : normals) normal.normalize();
  return normals;
}

/// The displacement is linear on the boundary triangles; normals of the deformed surface would show
/// that as facets. So the spline surface's normals are turned as the mean normals at the nodes
/// turn.
std::vector<Vector3d> deformedNormals(const DisplayMesh& drawn, const bem::BoundaryMesh& mesh,
                                      const NodeSides& sides, const app::TouchState& state,
                                      double scale) {
  const std::vector<Vector3d> before = sideNormals(mesh, sides, state, 0.0);
  const std::vector<Vector3d> after = sideNormals(mesh, sides, state, scale);
  std::vector<Vector3d> normals;
  normals.reserve(drawn.normals.size());
  for (std::size_t i = 0; i < drawn.normals.size(); ++i) {
    const Vector3d from = sides.at(drawn.links[i], before);
    const Vector3d to = sides.at(drawn.links[i], after);
    normals.push_back(
        (Eigen::Quaterniond::FromTwoVectors(from, to) * drawn.normals[i]).normalized());
  }
  return normals;
}

/// Mean over the slots on each side of the nodes.
std::vector<double> sideMeans(const bem::TractionSlots& slots, const NodeSides& sides,
                              const std::vector<double>& slotValues) {
  std::vector<double> sums(sides.ofNode.size(), 0);
  std::vector<int> counts(sums.size(), 0);
  for (std::size_t i = 0; i < slotValues.size(); ++i) {
    const std::pair key(slots.slots[i].node, slots.slots[i].smoothingGroup);
    const auto side = static_cast<std::size_t>(sides.ofNode.at(key));
    sums[side] += slotValues[i];
    ++counts[side];
  }
  for (std::size_t side = 0; side < sums.size(); ++side) sums[side] /= std::max(counts[side], 1);
  return sums;
}

ScalarField displacementField(const std::vector<Vector3d>& displacements) {
  ScalarField field;
  field.name = "Displacement |u|";
  field.unit = "mm";
  for (const Vector3d& u : displacements) field.values.push_back(u.norm());
  // Zero is where the body is held: colours start there.
  const double largest = *std::max_element(field.values.begin(), field.values.end());
  if (largest > 0) field.range = {0.0, largest};
  return field;
}

ScalarField stressField(SceneField kind, const app::BoundarySetup& setup, const NodeSides& sides,
                        const app::TouchState& state, const DisplayMesh& drawn) {
  ScalarField field;
  field.unit = "MPa";
  std::vector<double> slotValues;
  if (kind == SceneField::kNormalTraction) {
    field.name = "Normal traction";
    field.colours = ScalarField::Colours::kDiverging;
    for (int slot = 0; slot < setup.slots.count(); ++slot) {
      slotValues.push_back(setup.slots.slots[static_cast<std::size_t>(slot)].normal.dot(
          state.field.p.col(0).segment<3>(3 * slot)));
    }
  } else {
    field.name = "von Mises stress";
    for (const Eigen::Matrix3d& stress : bem::surfaceStress(
             setup.mesh, setup.slots, state.field.u.col(0), state.field.p.col(0), setup.material)) {
      slotValues.push_back(bem::vonMises(stress));
    }
  }
  const std::vector<double> means = sideMeans(setup.slots, sides, slotValues);
  for (const DisplayMesh::Link& link : drawn.links) field.values.push_back(sides.at(link, means));
  return field;
}

}  // namespace

void addSurface(const modeling::Project& project, const app::TouchModel& model,
                const app::TouchState& state, const SceneOptions& options,
                view::SurfaceScene& scene) {
  const app::BoundarySetup& setup = model.setup();
  const DisplayMesh drawn = modeling::displayMesh(model.surface(), project.body);
  const NodeSides sides(setup.mesh);
  scene.positions = drawn.positions;
  scene.triangles = drawn.triangles;
  scene.meshLines = drawn.edgeLines;
  for (const DisplayMesh::Link& link : drawn.links) {
    scene.displacements.push_back(displacementAt(link, setup.mesh, state));
  }
  scene.displacementScale = options.displacementScale;
  scene.normals = deformedNormals(drawn, setup.mesh, sides, state, options.displacementScale);
  if (options.field == SceneField::kDisplacement) {
    scene.field = displacementField(scene.displacements);
  } else if (options.field != SceneField::kNone) {
    scene.field = stressField(options.field, setup, sides, state, drawn);
  }
  std::vector<bool> isHeld(setup.mesh.triangles.size(), false);
  for (const auto& support : setup.supports) {
    for (const int triangle : support.triangles) isHeld[static_cast<std::size_t>(triangle)] = true;
  }
  for (std::size_t t = 0; t < drawn.triangles.size(); ++t) {
    if (isHeld[static_cast<std::size_t>(drawn.boundaryTriangle[t])]) {
      scene.supports.push_back(static_cast<int>(t));
    }
  }
}

}  // namespace palpa::cli

#include "app/core/results/drawn_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <type_traits>
#include <utility>

#include "base/job.h"
#include "bem/base/error.h"
#include "bem/triangle/results.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

modeling::DisplayMesh makeMesh(const TouchModel& model, const modeling::DisplaySettings& settings,
                               const Job& job) {
  return modeling::displayMesh(model.surface(), model.body(), settings, job);
}

std::vector<bem::SurfacePoint> placesOf(const modeling::DisplayMesh& mesh) {
  std::vector<bem::SurfacePoint> places;
  places.reserve(mesh.links.size());
  for (std::size_t k = 0; k < mesh.links.size(); ++k)
    places.push_back({mesh.links[k].triangle, mesh.links[k].weights, mesh.positions[k], 0.0});
  return places;
}

std::vector<bem::SurfacePoint> nodePlaces(const bem::BoundaryMesh& mesh) {
  std::vector<bem::SurfacePoint> places(mesh.nodes.size());
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const int node =
          mesh.triangles[static_cast<std::size_t>(t)][static_cast<std::size_t>(corner)];
      places[static_cast<std::size_t>(node)] = {t, Vector3d::Unit(corner),
                                                mesh.nodes[static_cast<std::size_t>(node)], 0.0};
    }
  return places;
}

template <class Value>
Value zero() {
  if constexpr (std::is_arithmetic_v<Value>)
    return 0;
  else
    return Value::Zero();
}

}  // namespace

DrawnBody::Weights::Weights(const bem::Discretisation::Weights& weights) {
  first_.reserve(static_cast<std::size_t>(weights.rows()) + 1);
  for (Eigen::Index row = 0; row < weights.rows(); ++row) {
    for (bem::Discretisation::Weights::InnerIterator it(weights, row); it; ++it) {
      if (it.value() == 0) continue;
      column_.push_back(static_cast<int>(it.col()));
      value_.push_back(static_cast<float>(it.value()));
    }
    first_.push_back(static_cast<int>(column_.size()));
  }
}

const DrawnBody::Weights::Coefficients& DrawnBody::coefficients(
    const Eigen::Ref<const VectorXd>& u) {
  thread_local Weights::Coefficients padded;
  padded.resize(4, u.size() / 3);
  for (Eigen::Index k = 0; k < padded.cols(); ++k)
    padded.col(k) << u.segment<3>(3 * k).cast<float>(), 0.0F;
  return padded;
}

DrawnBody::DrawnBody(std::shared_ptr<const TouchModel> model,
                     const modeling::DisplaySettings& settings, const Job& job)
    : model_(std::move(model)), mesh_(makeMesh(*model_, settings, job)) {
  const BoundarySetup& setup = model_->setup();
  std::map<std::pair<int, int>, int> sides;  // (node, smoothing group)
  const auto side = [&](int node, int group) {
    return sides.emplace(std::pair(node, group), static_cast<int>(sides.size())).first->second;
  };
  sideOfCorner_.resize(setup.mesh().triangles.size());
  for (std::size_t t = 0; t < sideOfCorner_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      sideOfCorner_[t][k] = side(setup.mesh().triangles[t][k], setup.mesh().smoothingGroups[t]);
  for (const auto& slot : setup.meshSlots().slots)
    sideOfSlot_.push_back(side(slot.node, slot.smoothingGroup));
  sideCount_ = static_cast<int>(sides.size());
  atPoints_ = Weights(setup.discretisation->displacementWeights(placesOf(mesh_)));
  atNodes_ = Weights(setup.discretisation->displacementWeights(nodePlaces(setup.mesh())));
  sideNormals(coefficients(VectorXd::Zero(
                  3 * static_cast<Eigen::Index>(setup.discretisation->displacementCount()))),
              0, normalsAtRest_);

  std::vector<bool> supported(setup.mesh().triangles.size(), false);
  for (const auto& support : setup.supports)
    for (const int triangle : support.triangles)
      supported[static_cast<std::size_t>(triangle)] = true;
  for (const int triangle : mesh_.boundaryTriangle)
    isSupported_.push_back(supported[static_cast<std::size_t>(triangle)]);
  findBorders();
}

void DrawnBody::findBorders() {
  std::map<std::array<int, 2>, int> patchBeside;  // of the triangle with this directed edge
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      patchBeside[{mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]}] =
          mesh_.patchOfTriangle[t];
  for (const auto& [edge, patch] : patchBeside) {
    const auto other = patchBeside.find({edge[1], edge[0]});
    // At a sharp edge the points are split: both sides have the edge as their border.
    if (other == patchBeside.end() || (other->second != patch && edge[0] < edge[1]))
      borders_.push_back(edge);
  }
}

template <class Value>
Value DrawnBody::atSides(std::size_t point, const std::vector<Value>& values) const {
  const modeling::DisplayMesh::Link& link = mesh_.links[point];
  const auto& sides = sideOfCorner_[static_cast<std::size_t>(link.triangle)];
  return link.weights[0] * values[static_cast<std::size_t>(sides[0])] +
         link.weights[1] * values[static_cast<std::size_t>(sides[1])] +
         link.weights[2] * values[static_cast<std::size_t>(sides[2])];
}

void DrawnBody::sideNormals(const Weights::Coefficients& u, double scale,
                            std::vector<Vector3d>& normals) const {
  const bem::BoundaryMesh& mesh = model_->setup().mesh();
  thread_local std::vector<Vector3d> nodes;
  nodes.resize(mesh.nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k)
    nodes[k] = mesh.nodes[k] + scale * atNodes_.at(k, u);
  normals.assign(static_cast<std::size_t>(sideCount_), Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const auto at = [&](std::size_t k) { return nodes[static_cast<std::size_t>(corners[k])]; };
    const Vector3d area = (at(1) - at(0)).cross(at(2) - at(0));
    for (const int side : sideOfCorner_[t]) normals[static_cast<std::size_t>(side)] += area;
  }
  for (Vector3d& normal : normals) normal.normalize();
}

void DrawnBody::deform(const Eigen::Ref<const VectorXd>& u, double scale, Shape& shape) const {
  // Normals of linear displacements on the boundary triangles would show facets. So the normals of
  // the exact surface are rotated by the rotation of the mean normals at the nodes.
  thread_local std::vector<Vector3d> normals;
  const Weights::Coefficients& padded = coefficients(u);
  sideNormals(padded, scale, normals);
  shape.positions.resize(mesh_.positions.size());
  shape.normals.resize(mesh_.positions.size());
  shape.sizes.resize(mesh_.positions.size());
  for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
    const Vector3d moved = atPoints_.at(i, padded);
    shape.sizes[i] = moved.norm();
    shape.positions[i] = mesh_.positions[i] + scale * moved;
    const auto turn =
        Eigen::Quaterniond::FromTwoVectors(atSides(i, normalsAtRest_), atSides(i, normals));
    shape.normals[i] = (turn * mesh_.normals[i]).normalized();
  }
}

std::vector<Vector3d> DrawnBody::displacements(const Eigen::Ref<const VectorXd>& u) const {
  const Weights::Coefficients& padded = coefficients(u);
  std::vector<Vector3d> result;
  result.reserve(mesh_.positions.size());
  for (std::size_t i = 0; i < mesh_.positions.size(); ++i)
    result.push_back(atPoints_.at(i, padded));
  return result;
}

std::vector<double> DrawnBody::displacementSizes(const Eigen::Ref<const VectorXd>& u) const {
  std::vector<double> result;
  result.reserve(mesh_.positions.size());
  for (const Vector3d& moved : displacements(u)) result.push_back(moved.norm());
  return result;
}

std::vector<double> DrawnBody::values(SurfaceQuantity quantity,
                                      const bem::BoundaryField& field) const {
  if (!isOfField(quantity)) return {};
  if (quantity == SurfaceQuantity::kDisplacement) return displacementSizes(field.u.col(0));
  const BoundarySetup& setup = model_->setup();
  const bem::Discretisation& on = *setup.discretisation;
  std::vector<double> ofSlot;
  if (quantity == SurfaceQuantity::kNormalTraction) {
    const bem::BoundaryField onMesh = on.valuesOnMesh(field);
    for (int slot = 0; slot < setup.meshSlots().count(); ++slot)
      ofSlot.push_back(setup.meshSlots().slots[static_cast<std::size_t>(slot)].normal.dot(
          onMesh.p.col(0).segment<3>(3 * slot)));
  } else {
    for (const Eigen::Matrix3d& stress :
         on.surfaceStress(field.u.col(0), field.p.col(0), setup.material))
      ofSlot.push_back(bem::vonMises(stress));
  }
  return fromSlots(ofSlot);
}

std::vector<Eigen::Matrix3d> DrawnBody::stresses(const bem::BoundaryField& field) const {
  const BoundarySetup& setup = model_->setup();
  return fromSlots(
      setup.discretisation->surfaceStress(field.u.col(0), field.p.col(0), setup.material));
}

std::vector<double> DrawnBody::stiffnesses(const std::vector<double>& compliances) const {
  std::vector<double> result = fromSlots(compliances);
  for (double& value : result) value = 1 / value;
  return result;
}

template <class Value>
std::vector<Value> DrawnBody::fromSlots(const std::vector<Value>& ofSlot) const {
  std::vector<Value> means(static_cast<std::size_t>(sideCount_), zero<Value>());
  std::vector<int> counts(means.size(), 0);
  for (std::size_t slot = 0; slot < ofSlot.size(); ++slot) {
    const auto side = static_cast<std::size_t>(sideOfSlot_[slot]);
    means[side] += ofSlot[slot];
    ++counts[side];
  }
  for (std::size_t side = 0; side < means.size(); ++side) means[side] /= std::max(counts[side], 1);
  std::vector<Value> result;
  result.reserve(mesh_.positions.size());
  for (std::size_t i = 0; i < mesh_.positions.size(); ++i)
    result.push_back(Value(atSides(i, means)));
  return result;
}

}  // namespace palpa::app

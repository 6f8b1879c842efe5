#include "bem/nodal_switching.h"

#include <algorithm>
#include <cassert>

namespace palpa::bem {

NodalSwitching::NodalSwitching(std::shared_ptr<GreensFunction> greens, Eigen::VectorXd known,
                               Eigen::VectorXd unknown, BoundaryField field)
    : greens_(std::move(greens)),
      known_(std::move(known)),
      unknown_(std::move(unknown)),
      field_(std::move(field)),
      columns_(unknown_.size(), 0) {}

void NodalSwitching::add(int node) {
  assert(std::find(nodes_.begin(), nodes_.end(), node) == nodes_.end());
  const std::vector<int> joining = dofsOf(node);
  greens_->ensure(joining);
  Eigen::MatrixXd fresh(unknown_.size(), 3);
  for (int k = 0; k < 3; ++k) fresh.col(k) = greens_->column(joining[k]);

  const auto old = static_cast<Eigen::Index>(3 * nodes_.size());
  Eigen::MatrixXd column(old, 3);
  for (std::size_t s = 0; s < nodes_.size(); ++s)
    column.middleRows<3>(3 * static_cast<Eigen::Index>(s)) = -fresh.middleRows<3>(3 * nodes_[s]);
  capacitance_.append(column, -columns_.middleRows<3>(3 * node), -fresh.middleRows<3>(3 * node));
  columns_.conservativeResize(Eigen::NoChange, old + 3);
  columns_.rightCols<3>() = fresh;
  nodes_.push_back(node);
}

void NodalSwitching::remove(int node) {
  const auto place = std::find(nodes_.begin(), nodes_.end(), node);
  assert(place != nodes_.end());
  const Eigen::Index first = 3 * (place - nodes_.begin());
  capacitance_.remove(first, 3);
  const Eigen::Index after = columns_.cols() - first - 3;
  Eigen::MatrixXd kept(columns_.rows(), first + after);
  kept << columns_.leftCols(first), columns_.rightCols(after);
  columns_ = std::move(kept);
  nodes_.erase(place);
}

NodalSwitching::Solution NodalSwitching::solve(const Eigen::VectorXd& values) const {
  const auto count = static_cast<Eigen::Index>(nodes_.size());
  assert(values.size() == 3 * count);
  const auto gather = [&](const Eigen::VectorXd& from) {
    Eigen::VectorXd picked(3 * count);
    for (Eigen::Index s = 0; s < count; ++s)
      picked.segment<3>(3 * s) = from.segment<3>(3 * nodes_[s]);
    return picked;
  };
  // v0 = Xi v̄ without the switched columns, minus the new values in the switched rows.
  const Eigen::VectorXd replaced = gather(known_);
  Eigen::VectorXd v = unknown_ - columns_ * replaced;
  const Eigen::VectorXd switched = capacitance_.solve(gather(v) - values);
  v += columns_ * switched;

  // In the field, a switched displacement is what was prescribed and the switched traction what was
  // solved for.
  const DegreesOfFreedom& dofs = greens_->problem().dofs();
  Eigen::VectorXd change = v - unknown_;
  Eigen::VectorXd knownChange = Eigen::VectorXd::Zero(known_.size());
  for (Eigen::Index s = 0; s < count; ++s) {
    const Eigen::Index row = 3 * nodes_[s];
    change.segment<3>(row) = values.segment<3>(3 * s) - unknown_.segment<3>(row);
    knownChange.segment<3>(row) = switched.segment<3>(3 * s) - known_.segment<3>(row);
    v.segment<3>(row) = switched.segment<3>(3 * s);
  }
  BoundaryField field = dofs.expand(change, knownChange);
  field.u += field_.u;
  field.p += field_.p;
  return {std::move(v), switched, std::move(field)};
}

double nodalArea(const BoundaryMesh& mesh, int node) {
  double sum = 0;
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (const int corner : mesh.triangles[t])
      if (corner == node) sum += mesh.area(t) / 3.0;
  return sum;
}

}  // namespace palpa::bem

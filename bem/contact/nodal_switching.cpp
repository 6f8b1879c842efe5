#include "bem/contact/nodal_switching.h"

#include <algorithm>
#include <cassert>

namespace palpa::bem {

NodalSwitching::NodalSwitching(std::shared_ptr<const ReferenceProblem> problem,
                               Eigen::VectorXd known, Eigen::VectorXd unknown, BoundaryField field,
                               Weights weights)
    : problem_(std::move(problem)),
      known_(std::move(known)),
      unknown_(std::move(unknown)),
      field_(std::move(field)),
      weights_(std::move(weights)),
      columns_(unknown_.size(), 0) {}

NodalSwitching::Row NodalSwitching::rowOf(int dof) const {
  const DegreesOfFreedom& dofs = problem_->dofs();
  const int node = dof / 3;
  Row row;
  if (weights_.size() > 0 && !dofs.isConstrained(dof)) {
    const Eigen::Vector3d direction = dofs.frame(node).col(dof % 3);
    for (Weights::InnerIterator it(weights_, node); it; ++it) {
      const auto other = static_cast<int>(it.col());
      if (other != node || it.value() != 1) row.isOwnUnknown = false;
      row.rest += it.value() * direction.dot(field_.u.col(0).segment<3>(3 * other));
      for (const int each : dofsOf(other)) {
        const double weight = it.value() * direction.dot(dofs.frame(other).col(each % 3));
        if (weight == 0) continue;
        (dofs.isConstrained(each) ? row.known : row.unknown).push_back({each, weight});
      }
    }
    for (const Term& term : row.unknown) row.rest -= term.weight * unknown_[term.dof];
  }
  if (row.isOwnUnknown) return {{Term{dof, 1}}, {}};
  return row;
}

Eigen::MatrixXd NodalSwitching::measure(std::size_t first, const Eigen::MatrixXd& states,
                                        const std::vector<int>& nodes) const {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(rows_.size() - first), states.cols());
  for (Eigen::Index r = 0; r < result.rows(); ++r) {
    const Row& row = rows_[first + static_cast<std::size_t>(r)];
    result.row(r).setZero();
    for (const Term& term : row.unknown) result.row(r) += term.weight * states.row(term.dof);
    for (const Term& term : row.known)
      for (std::size_t s = 0; s < nodes.size(); ++s)
        if (nodes[s] == term.dof / 3)
          result(r, 3 * static_cast<Eigen::Index>(s) + term.dof % 3) += term.weight;
  }
  return result;
}

void NodalSwitching::add(int node) {
  assert(std::find(nodes_.begin(), nodes_.end(), node) == nodes_.end());
  const std::vector<int> joining = dofsOf(node);
  const Eigen::MatrixXd fresh = problem_->greensColumns(joining);

  const std::size_t old = rows_.size();
  for (const int dof : joining) rows_.push_back(rowOf(dof));
  const Eigen::MatrixXd ofNew = -measure(0, fresh, {node}), ofOld = -measure(old, columns_, nodes_);
  try {
    capacitance_.append(ofNew.topRows(static_cast<Eigen::Index>(old)), ofOld, ofNew.bottomRows(3));
  } catch (...) {
    rows_.resize(old);
    throw;
  }
  columns_.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(rows_.size()));
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
  rows_.erase(rows_.begin() + first, rows_.begin() + first + 3);
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
  Eigen::VectorXd measured = measure(0, v, {});
  for (Eigen::Index r = 0; r < measured.size(); ++r) {
    measured[r] += rows_[r].rest;
    for (const Term& term : rows_[r].known)
      if (const auto at = std::find(nodes_.begin(), nodes_.end(), term.dof / 3); at != nodes_.end())
        measured[r] -= term.weight * replaced[3 * (at - nodes_.begin()) + term.dof % 3];
  }
  const Eigen::VectorXd switched = capacitance_.solve(measured - values);
  v += columns_ * switched;

  // In the field, the displacement of a switched node is prescribed (or v has its coefficient) and
  // its traction is solved for.
  const DegreesOfFreedom& dofs = problem_->dofs();
  Eigen::VectorXd change = v - unknown_;
  Eigen::VectorXd knownChange = Eigen::VectorXd::Zero(known_.size());
  for (Eigen::Index s = 0; s < count; ++s) {
    const Eigen::Index row = 3 * nodes_[s];
    for (int k = 0; k < 3; ++k)
      if (rows_[3 * s + k].isOwnUnknown) change[row + k] = values[3 * s + k] - unknown_[row + k];
    knownChange.segment<3>(row) = switched.segment<3>(3 * s) - known_.segment<3>(row);
    v.segment<3>(row) = switched.segment<3>(3 * s);
  }
  BoundaryField field = dofs.expand(change, knownChange);
  field.u += field_.u;
  field.p += field_.p;
  return {std::move(v), switched, std::move(field)};
}

}  // namespace palpa::bem

#include "bem/contact/bilateral_contact_solver.h"

#include <algorithm>
#include <cassert>

namespace palpa::bem {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

}  // namespace

BilateralContactSolver::BilateralContactSolver(std::shared_ptr<const ReferenceProblem> problem,
                                               const TractionSlots& slots, BoundaryField base)
    : problem_(std::move(problem)), firstSlotOfNode_(slots.firstOfNode), base_(std::move(base)) {}

BilateralContactSolver::Id BilateralContactSolver::addGrab(
    const ContactMask& mask, const std::optional<Vector3d>& displacement) {
  Entry entry{0, mask, true, Vector3d::Zero(), {}};
  entry.given = displacement ? *displacement : Vector3d(mask.displacement(base_.u));
  return add(std::move(entry));
}

BilateralContactSolver::Id BilateralContactSolver::addForce(const ContactMask& mask,
                                                            const Vector3d& force) {
  return add({0, mask, false, force, {}});
}

BilateralContactSolver::Id BilateralContactSolver::add(Entry entry) {
  BoundaryField unit{MatrixXd::Zero(base_.u.rows(), 3), MatrixXd::Zero(base_.p.rows(), 3)};
  for (std::size_t k = 0; k < entry.mask.nodes.size(); ++k) {
    const int node = entry.mask.nodes[k];
    for (int s = firstSlotOfNode_[node]; s < firstSlotOfNode_[node + 1]; ++s)
      unit.p.middleRows<3>(3 * s) = entry.mask.traction[k] * Matrix3d::Identity();
  }
  entry.response = problem_->solveField(unit);
  entry.id = nextId_;

  const auto old = compliance_.rows();
  MatrixXd column(old, 3);
  const Matrix3d own = entry.mask.displacement(entry.response.u);
  double defect = (own - own.transpose()).norm();
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const Matrix3d there = entries_[k].mask.displacement(entry.response.u);
    const Matrix3d here = entry.mask.displacement(entries_[k].response.u);
    column.middleRows<3>(3 * static_cast<Eigen::Index>(k)) = (there + here.transpose()) / 2;
    defect = std::max(defect, (there - here.transpose()).norm());
  }
  const Matrix3d corner = (own + own.transpose()) / 2;
  if (entry.grabbed) {
    const auto rows = rowsOf(true);
    const MatrixXd border = column(rows, Eigen::all);
    capacitance_.append(border, border.transpose(), corner);
  }
  reciprocityDefect_ = std::max(reciprocityDefect_, defect / own.norm());

  compliance_.conservativeResize(old + 3, old + 3);
  compliance_.topRightCorner(old, 3) = column;
  compliance_.bottomLeftCorner(3, old) = column.transpose();
  compliance_.bottomRightCorner<3, 3>() = corner;
  baseDisplacements_.conservativeResize(old + 3);
  baseDisplacements_.tail<3>() = entry.mask.displacement(base_.u);
  entries_.push_back(std::move(entry));
  return nextId_++;
}

void BilateralContactSolver::remove(Id id) {
  const Eigen::Index index = indexOf(id);
  if (entries_[index].grabbed) {
    const auto grabbedBefore = std::count_if(entries_.begin(), entries_.begin() + index,
                                             [](const Entry& entry) { return entry.grabbed; });
    capacitance_.remove(3 * grabbedBefore, 3);
  }
  std::vector<Eigen::Index> kept;
  for (Eigen::Index row = 0; row < compliance_.rows(); ++row)
    if (row / 3 != index) kept.push_back(row);
  compliance_ = MatrixXd(compliance_(kept, kept));
  baseDisplacements_ = Eigen::VectorXd(baseDisplacements_(kept));
  entries_.erase(entries_.begin() + index);
}

void BilateralContactSolver::setDisplacement(Id id, const Vector3d& displacement) {
  Entry& entry = entries_[indexOf(id)];
  assert(entry.grabbed);
  entry.given = displacement;
}

void BilateralContactSolver::setForce(Id id, const Vector3d& force) {
  Entry& entry = entries_[indexOf(id)];
  assert(!entry.grabbed);
  entry.given = force;
}

Eigen::Index BilateralContactSolver::indexOf(Id id) const {
  const auto place = std::find_if(entries_.begin(), entries_.end(),
                                  [id](const Entry& entry) { return entry.id == id; });
  assert(place != entries_.end());
  return place - entries_.begin();
}

std::vector<Eigen::Index> BilateralContactSolver::rowsOf(bool grabbed) const {
  std::vector<Eigen::Index> rows;
  for (std::size_t k = 0; k < entries_.size(); ++k)
    if (entries_[k].grabbed == grabbed)
      for (Eigen::Index i = 0; i < 3; ++i) rows.push_back(3 * static_cast<Eigen::Index>(k) + i);
  return rows;
}

Eigen::VectorXd BilateralContactSolver::forces() const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(compliance_.rows());
  Eigen::VectorXd missing(compliance_.rows());
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const auto row = 3 * static_cast<Eigen::Index>(k);
    if (!entries_[k].grabbed) forces.segment<3>(row) = entries_[k].given;
    missing.segment<3>(row) = entries_[k].given;
  }
  // Difference between the prescribed displacements and the displacements without the grabbed
  // contacts.
  missing -= baseDisplacements_ + compliance_ * forces;
  const auto rows = rowsOf(true);
  forces(rows) = capacitance_.solve(missing(rows));
  return forces;
}

BoundaryField BilateralContactSolver::field(const Eigen::VectorXd& forces) const {
  BoundaryField field = base_;
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const Vector3d force = forces.segment<3>(3 * static_cast<Eigen::Index>(k));
    field.u += entries_[k].response.u * force;
    field.p += entries_[k].response.p * force;
  }
  return field;
}

std::vector<BilateralContactSolver::Contact> BilateralContactSolver::contacts(
    const Eigen::VectorXd& forces) const {
  const Eigen::VectorXd displacements = baseDisplacements_ + compliance_ * forces;
  std::vector<Contact> result;
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const auto row = 3 * static_cast<Eigen::Index>(k);
    const Vector3d force = forces.segment<3>(row);
    const Eigen::Matrix3d compliance = compliance_.block<3, 3>(row, row);
    const Vector3d deflection = compliance * force;
    const double size = deflection.norm();
    result.push_back({entries_[k].id, entries_[k].mask.point, entries_[k].mask.radius, force,
                      displacements.segment<3>(row), deflection,
                      size > 0 ? force.norm() / size : 0.0, compliance});
  }
  return result;
}

}  // namespace palpa::bem

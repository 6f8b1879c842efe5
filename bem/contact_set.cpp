#include "bem/contact_set.h"

#include <algorithm>

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

}  // namespace

ContactSet::ContactSet(const ContactSurface& surface, const GreensColumns& columns,
                       const BoundaryField& base)
    : surface_(surface),
      columns_(columns),
      base_(base),
      workspace_(surface),
      rowStamp_(surface.mesh().nodes.size(), 0),
      rowOfNode_(surface.mesh().nodes.size(), 0) {}

void ContactSet::resize(int count) {
  const auto kept = 3 * std::min<Index>(count, size());
  masks_.resize(count);
  Eigen::MatrixXd raw = Eigen::MatrixXd::Zero(3 * count, 3 * count);
  raw.topLeftCorner(kept, kept) = raw_.topLeftCorner(kept, kept);
  raw_ = std::move(raw);
  free_.conservativeResizeLike(Eigen::VectorXd::Zero(3 * count));
}

void ContactSet::remove(int first, int count) {
  const Index after = 3 * (size() - first - count);
  masks_.erase(masks_.begin() + first, masks_.begin() + first + count);
  std::vector<Index> kept;
  for (Index k = 0; k < 3 * first; ++k) kept.push_back(k);
  for (Index k = 0; k < after; ++k) kept.push_back(3 * (first + count) + k);
  raw_ = Eigen::MatrixXd(raw_(kept, kept));
  free_ = Eigen::VectorXd(free_(kept));
}

bool ContactSet::place(int index, const SurfacePoint& point, double radius) {
  Entry& entry = masks_[index];
  if (entry.isPlaced && entry.mask.point.triangle == point.triangle &&
      entry.mask.point.position == point.position &&
      entry.mask.radius == std::max(radius, surface_.narrowestMask(point)))
    return true;
  entry.isCurrent = false;
  entry.isPlaced = surface_.makeMask(point, radius, workspace_, entry.mask);
  return entry.isPlaced;
}

void ContactSet::clear(int index) {
  masks_[index].isPlaced = false;
  masks_[index].isCurrent = false;
}

bool ContactSet::isReady(int index) const {
  return masks_[index].isPlaced && columns_.hasAll(masks_[index].mask.nodes);
}

void ContactSet::collectRows(bool onlyChanged) {
  ++stamp_;
  rows_.clear();
  for (int k = 0; k < size(); ++k) {
    if (!masks_[k].isPlaced || (onlyChanged && masks_[k].isCurrent)) continue;
    for (const int node : masks_[k].mask.measureNodes) {
      if (rowStamp_[node] == stamp_) continue;
      rowStamp_[node] = stamp_;
      rowOfNode_[node] = static_cast<int>(rows_.size());
      rows_.push_back(node);
    }
  }
}

void ContactSet::respond(int index) {
  const ContactMask& mask = masks_[index].mask;
  const DegreesOfFreedom& dofs = surface_.dofs();
  const auto rowCount = static_cast<Index>(rows_.size());
  response_.setZero(3 * rowCount, 3);
  for (std::size_t k = 0; k < mask.nodes.size(); ++k) {
    const auto weight =
        static_cast<float>(mask.traction[static_cast<Index>(k)] / dofs.tractionScale());
    for (int axis = 0; axis < 3; ++axis) {
      const float* column = columns_.column(mask.nodes[k], axis);
      float* sum = response_.data() + 3 * rowCount * axis;
      for (Index i = 0; i < rowCount; ++i) {
        const float* from = column + 3 * rows_[i];
        sum[3 * i] += weight * from[0];
        sum[3 * i + 1] += weight * from[1];
        sum[3 * i + 2] += weight * from[2];
      }
    }
  }
  // At held nodes the unknowns are tractions in the held directions: they do not move there.
  for (Index i = 0; i < rowCount; ++i) {
    if (dofs.isFree(rows_[i])) continue;
    Eigen::Matrix3f along = Eigen::Matrix3f::Zero();
    const Eigen::Matrix3f frame = dofs.frame(rows_[i]).cast<float>();
    for (int k = dofs.constrained(rows_[i]); k < 3; ++k)
      along += frame.col(k) * response_.row(3 * i + k);
    response_.middleRows<3>(3 * i) = along;
  }
}

Matrix3d ContactSet::measure(int index) const {
  const ContactMask& mask = masks_[index].mask;
  Matrix3d sum = Matrix3d::Zero();
  for (std::size_t k = 0; k < mask.measureNodes.size(); ++k)
    sum += mask.measure[static_cast<Index>(k)] *
           response_.middleRows<3>(3 * rowOfNode_[mask.measureNodes[k]]).cast<double>();
  return sum;
}

void ContactSet::update() {
  // Those that changed, or whose columns have come, against all; then the others against those.
  const auto wants = [&](int k) { return masks_[k].isPlaced && isReady(k); };
  bool anyChanged = false;
  for (int k = 0; k < size(); ++k) anyChanged = anyChanged || (wants(k) && !masks_[k].isCurrent);
  for (int k = 0; k < size(); ++k) {
    if (wants(k)) continue;
    raw_.middleRows<3>(3 * k).setZero();
    raw_.middleCols<3>(3 * k).setZero();
    free_.segment<3>(3 * k).setZero();
    masks_[k].isCurrent = false;
  }
  if (anyChanged) {
    collectRows(false);
    for (int b = 0; b < size(); ++b) {
      if (!wants(b) || masks_[b].isCurrent) continue;
      respond(b);
      for (int a = 0; a < size(); ++a)
        if (wants(a)) raw_.block<3, 3>(3 * a, 3 * b) = measure(a);
      const ContactMask& mask = masks_[b].mask;
      free_.segment<3>(3 * b).setZero();
      for (std::size_t k = 0; k < mask.measureNodes.size(); ++k)
        free_.segment<3>(3 * b) += mask.measure[static_cast<Index>(k)] *
                                   base_.u.col(0).segment<3>(3 * mask.measureNodes[k]);
    }
    collectRows(true);
    for (int b = 0; b < size(); ++b) {
      if (!wants(b) || !masks_[b].isCurrent) continue;
      respond(b);
      for (int a = 0; a < size(); ++a)
        if (wants(a) && !masks_[a].isCurrent) raw_.block<3, 3>(3 * a, 3 * b) = measure(a);
    }
    for (int k = 0; k < size(); ++k)
      if (wants(k)) masks_[k].isCurrent = true;
  }
  compliance_.resize(raw_.rows(), raw_.cols());
  compliance_ = 0.5 * (raw_ + raw_.transpose());
  defect_ = 0;
  for (int k = 0; k < size(); ++k) {
    if (!wants(k)) continue;
    const double own = compliance_.block<3, 3>(3 * k, 3 * k).norm();
    for (int a = 0; a < size(); ++a)
      defect_ = std::max(
          defect_,
          (raw_.block<3, 3>(3 * a, 3 * k) - raw_.block<3, 3>(3 * k, 3 * a).transpose()).norm() /
              own);
  }
}

}  // namespace palpa::bem

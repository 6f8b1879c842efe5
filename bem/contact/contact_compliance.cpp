#include "bem/contact/contact_compliance.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

}  // namespace

ContactCompliance::ContactCompliance(const ContactSurface& surface, const GreensColumns& columns,
                                     const BoundaryField& base)
    : surface_(surface),
      columns_(columns),
      base_(base),
      workspace_(surface.makeWorkspace()),
      rowStamp_(surface.dofs().nodeCount(), 0),
      rowOfNode_(surface.dofs().nodeCount(), 0) {}

void ContactCompliance::resize(int count) {
  const auto kept = 3 * std::min<Index>(count, size());
  masks_.resize(count);
  Eigen::MatrixXd raw = Eigen::MatrixXd::Zero(3 * count, 3 * count);
  raw.topLeftCorner(kept, kept) = raw_.topLeftCorner(kept, kept);
  raw_ = std::move(raw);
  free_.conservativeResizeLike(Eigen::VectorXd::Zero(3 * count));
  isStale_ = true;
}

void ContactCompliance::remove(int first, int count) {
  const Index after = 3 * (size() - first - count);
  masks_.erase(masks_.begin() + first, masks_.begin() + first + count);
  std::vector<Index> kept;
  for (Index k = 0; k < 3 * first; ++k) kept.push_back(k);
  for (Index k = 0; k < after; ++k) kept.push_back(3 * (first + count) + k);
  raw_ = Eigen::MatrixXd(raw_(kept, kept));
  free_ = Eigen::VectorXd(free_(kept));
  isStale_ = true;
}

bool ContactCompliance::misses(const ContactMask& mask) {
  if (isAvailable(mask)) return false;
  for (const int node : mask.nodes)
    if (!columns_.hasRough(node)) missing_.push_back(node);
  return true;
}

bool ContactCompliance::place(int index, const SurfacePoint& point, double radius) {
  Entry& entry = masks_[index];
  if (entry.isPlaced && entry.mask.point.triangle == point.triangle &&
      entry.mask.point.position == point.position &&
      entry.mask.radius == surface_.maskRadius(point, radius)) {
    misses(entry.mask);
    return true;
  }
  const bool isPlaced = surface_.makeMask(point, radius, *workspace_, spare_);
  if (isPlaced && misses(spare_) && entry.isPlaced && isAvailable(entry.mask))
    return true;  // stays at its previous point
  std::swap(entry.mask, spare_);
  entry.isPlaced = isPlaced;
  entry.isCurrent = false;
  return isPlaced;
}

void ContactCompliance::clear(int index) {
  masks_[index].isPlaced = false;
  masks_[index].isCurrent = false;
}

void ContactCompliance::collectRows(bool onlyChanged) {
  ++stamp_;
  rows_.clear();
  for (int k = 0; k < size(); ++k) {
    if (!masks_[k].isReady || (onlyChanged && masks_[k].isCurrent)) continue;
    for (const int node : masks_[k].mask.measureNodes) {
      if (rowStamp_[node] == stamp_) continue;
      rowStamp_[node] = stamp_;
      rows_.push_back(node);
    }
  }
  // Neighbours in memory follow each other, so that respond() reads each line of the cache once.
  std::sort(rows_.begin(), rows_.end());
  for (std::size_t i = 0; i < rows_.size(); ++i) rowOfNode_[rows_[i]] = static_cast<int>(i);
}

bool ContactCompliance::respond(int index) {
  const ContactMask& mask = masks_[index].mask;
  const DegreesOfFreedom& dofs = surface_.dofs();
  const auto rowCount = static_cast<Index>(rows_.size());
  if (response_.rows() < 3 * rowCount) response_.resize(6 * rowCount, 3);
  const bool hasColumns = columns_.hasAll(mask.nodes);
  const MaskResponses::Response* response = hasColumns ? nullptr : responseTo(mask);
  if (!response) {
    sumColumns(mask);
  } else {
    const auto& unknowns = response->unknowns;
    for (Index i = 0; i < rowCount; ++i)
      response_.middleRows<3>(3 * i) = unknowns.middleRows<3>(3 * static_cast<Index>(rows_[i]));
  }
  // At fixed nodes the unknowns in the fixed directions are tractions; the displacements are zero.
  for (Index i = 0; i < rowCount; ++i) {
    if (dofs.isFree(rows_[i])) continue;
    Eigen::Matrix3f along = Eigen::Matrix3f::Zero();
    const Eigen::Matrix3f frame = dofs.frame(rows_[i]).cast<float>();
    for (int k = dofs.constrained(rows_[i]); k < 3; ++k)
      along += frame.col(k) * response_.row(3 * i + k);
    response_.middleRows<3>(3 * i) = along;
  }
  return !hasColumns && (!response || response->isRough);
}

void ContactCompliance::sumColumns(const ContactMask& mask) {
  const DegreesOfFreedom& dofs = surface_.dofs();
  const auto rowCount = static_cast<Index>(rows_.size());
  response_.topRows(3 * rowCount).setZero();
  // The sums of a row stay in registers while the columns of some nodes are added. Four numbers are
  // read at a time; the fourth belongs to the next row and is dropped, but the last row has none.
  constexpr std::size_t kNodes = 16;
  std::array<std::array<const float*, 3>, kNodes> columns;
  std::array<float, kNodes> weights;
  const int lastRow = static_cast<int>(columns_.rows() / 3) - 1;
  for (std::size_t first = 0; first < mask.nodes.size(); first += kNodes) {
    const std::size_t count = std::min(kNodes, mask.nodes.size() - first);
    for (std::size_t k = 0; k < count; ++k) {
      weights[k] = static_cast<float>(mask.traction[first + k] / dofs.tractionScale());
      for (int axis = 0; axis < 3; ++axis)
        columns[k][axis] = columns_.column(mask.nodes[first + k], axis);
    }
    for (Index i = 0; i < rowCount; ++i) {
      const Index row = 3 * static_cast<Index>(rows_[i]);
      std::array<Eigen::Vector4f, 3> sums;
      for (int axis = 0; axis < 3; ++axis) sums[axis] << response_.col(axis).segment<3>(3 * i), 0;
      if (rows_[i] == lastRow) {
        for (std::size_t k = 0; k < count; ++k)
          for (int axis = 0; axis < 3; ++axis)
            sums[axis].head<3>() +=
                weights[k] * Eigen::Map<const Eigen::Vector3f>(columns[k][axis] + row);
      } else {
        for (std::size_t k = 0; k < count; ++k)
          for (int axis = 0; axis < 3; ++axis)
            sums[axis] += weights[k] * Eigen::Map<const Eigen::Vector4f>(columns[k][axis] + row);
      }
      for (int axis = 0; axis < 3; ++axis)
        response_.col(axis).segment<3>(3 * i) = sums[axis].head<3>();
    }
  }
}

Matrix3d ContactCompliance::measure(int index) const {
  const ContactMask& mask = masks_[index].mask;
  Matrix3d sum = Matrix3d::Zero();
  for (std::size_t k = 0; k < mask.measureNodes.size(); ++k)
    sum += mask.measure[k] *
           response_.middleRows<3>(3 * rowOfNode_[mask.measureNodes[k]]).cast<double>();
  return sum;
}

void ContactCompliance::measureBase(int index) {
  const ContactMask& mask = masks_[index].mask;
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < mask.measureNodes.size(); ++k)
    sum += mask.measure[k] * base_.u.col(0).segment<3>(3 * mask.measureNodes[k]);
  free_.segment<3>(3 * index) = sum;
}

void ContactCompliance::update() {
  bool anyChanged = false;
  for (int k = 0; k < size(); ++k) {
    Entry& entry = masks_[k];
    entry.isReady = entry.isPlaced && isAvailable(entry.mask);
    if (entry.isRough && isExact(entry.mask)) entry.isCurrent = false;
    anyChanged = anyChanged || (entry.isReady && !entry.isCurrent);
    if (entry.isReady || entry.isZero) continue;
    raw_.middleRows<3>(3 * k).setZero();
    raw_.middleCols<3>(3 * k).setZero();
    free_.segment<3>(3 * k).setZero();
    entry.isCurrent = false;
    entry.isZero = true;
    isStale_ = true;
  }
  if (anyChanged) {
    isStale_ = true;
    // Changed or newly ready masks against all masks; then the other masks against these.
    collectRows(false);
    for (int b = 0; b < size(); ++b) {
      if (!masks_[b].isReady || masks_[b].isCurrent) continue;
      masks_[b].isRough = respond(b);
      for (int a = 0; a < size(); ++a)
        if (masks_[a].isReady) raw_.block<3, 3>(3 * a, 3 * b) = measure(a);
      measureBase(b);
    }
    collectRows(true);
    for (int b = 0; b < size(); ++b) {
      if (!masks_[b].isReady || !masks_[b].isCurrent) continue;
      respond(b);
      for (int a = 0; a < size(); ++a)
        if (masks_[a].isReady && !masks_[a].isCurrent) raw_.block<3, 3>(3 * a, 3 * b) = measure(a);
    }
    for (Entry& entry : masks_) {
      entry.isCurrent = entry.isReady;
      entry.isZero = entry.isZero && !entry.isReady;
    }
  }
  if (isStale_) symmetrise();
}

void ContactCompliance::symmetrise() {
  isStale_ = false;
  compliance_.resize(raw_.rows(), raw_.cols());
  compliance_ = 0.5 * (raw_ + raw_.transpose());
  defect_ = 0;
  for (int k = 0; k < size(); ++k) {
    if (!masks_[k].isReady) continue;
    const double own = compliance_.block<3, 3>(3 * k, 3 * k).squaredNorm();
    double worst = 0;
    for (int a = 0; a < size(); ++a)
      if (masks_[a].isReady)
        worst = std::max(
            worst, (raw_.block<3, 3>(3 * a, 3 * k) - raw_.block<3, 3>(3 * k, 3 * a).transpose())
                       .squaredNorm());
    defect_ = std::max(defect_, std::sqrt(worst / own));
  }
}

}  // namespace palpa::bem

#pragma once

#include <vector>

#include "bem/contact/contact_surface.h"
#include "bem/problem/greens_columns.h"

namespace palpa::bem {

/// How stiff the surface is under a fingertip: at each node of the mesh, the force along the normal
/// (N) that a contact with a mask of one radius needs per mm that it moves along the normal, while
/// it is free to move sideways. With C = Ψ^T Xi Φ the compliance of the mask at the node (mm/N, 3 x
/// 3, the same mask and columns as a grab) and n the outward normal:
///   stiffness = 1 / (n · C n).
/// A property of the body and its supports alone: loads and other touches do not change it, as the
/// body is linear. At sharp edges each side has a value, of its own normal.
///
/// Filled in while the columns come. One thread at a time may call update(); nobody may read
/// meanwhile.
class StiffnessMap {
 public:
  /// `radius` of the masks, mm; raised where the mesh cannot carry it, as for every contact.
  StiffnessMap(const ContactSurface& surface, double radius);

  double radius() const { return radius_; }

  /// Computes those free nodes that are missing and whose masks' columns are there; returns how
  /// many. Costs some tenths of a millisecond per node on one core. Throws Cancelled and keeps
  /// nothing of this call.
  int update(const GreensColumns& columns, const Job& job);

  int readyCount() const { return readyCount_; }
  /// Free nodes.
  int nodeCount() const { return static_cast<int>(nodes_.size()); }
  bool isComplete() const { return readyCount_ == nodeCount(); }

  /// n · C n by slot of the mesh, mm/N: the inverse of the stiffness, so that it can be
  /// interpolated up to supports. 0 where a support holds the node, NaN where it is not known yet.
  const std::vector<double>& compliances() const { return compliances_; }

 private:
  const ContactSurface& surface_;
  double radius_;
  struct Node {
    SurfacePoint point;
    int node;         // of the mesh
    int coefficient;  // ContactSurface::coefficientAt() it
  };
  std::vector<Node> nodes_;  // the free ones
  std::vector<char> isReady_;
  int readyCount_ = 0;
  std::vector<double> compliances_;
};

}  // namespace palpa::bem

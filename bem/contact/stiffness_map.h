#pragma once

#include <vector>

#include "bem/contact/contact_surface.h"
#include "bem/problem/greens_columns.h"

namespace palpa::bem {

/// Map of the surface stiffness under a fingertip: at each node of the mesh, the force along the
/// normal (N) per mm of normal displacement for a contact with a mask of one radius that moves
/// freely sideways. With C = Ψ^T Xi Φ the compliance of the mask at the node (mm/N, 3 x 3, the same
/// mask and columns as a grab) and n the outward normal:
///   stiffness = 1 / (n · C n).
/// It depends on the body and its supports only: the body is linear, so loads and other touches do
/// not change it. At sharp edges each side has a value for its own normal.
///
/// The map fills while the columns arrive. One thread at a time may call update(); no other thread
/// may read during the call.
class StiffnessMap {
 public:
  /// `radius` of the masks, mm; raised where the mesh cannot represent it, as for every contact.
  StiffnessMap(const ContactSurface& surface, double radius);

  double radius() const { return radius_; }

  /// Computes the missing free nodes whose masks have all their columns, and returns their number.
  /// Takes some tenths of a millisecond per node on one core. Throws Cancelled if the job was
  /// stopped, and then discards the results of this call.
  int update(const GreensColumns& columns, const Job& job);

  int readyCount() const { return readyCount_; }
  /// Number of free nodes.
  int nodeCount() const { return static_cast<int>(nodes_.size()); }
  bool isComplete() const { return readyCount_ == nodeCount(); }

  /// n · C n by slot of the mesh, mm/N: the inverse of the stiffness, because it can be
  /// interpolated up to supports. 0 if a support fixes the node, NaN if not computed yet.
  const std::vector<double>& compliances() const { return compliances_; }

 private:
  const ContactSurface& surface_;
  double radius_;
  struct Node {
    SurfacePoint point;
    int node;         // of the mesh
    int coefficient;  // ContactSurface::coefficientAt() the node
  };
  std::vector<Node> nodes_;  // the free ones
  std::vector<char> isReady_;
  int readyCount_ = 0;
  std::vector<double> compliances_;
};

}  // namespace palpa::bem

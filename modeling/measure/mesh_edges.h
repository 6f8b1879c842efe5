#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "modeling/body/mesh_body.h"

// Edges of a mesh body: borders between its faces. Internal to modeling/measure.
namespace palpa::modeling {

/// Nearest point of the segment from a to b.
Eigen::Vector3d nearestOnSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Eigen::Vector3d& x);

/// An edge up to its corners (sharp turns, and ends of the border).
struct MeshEdge {
  std::vector<Eigen::Vector3d> points;  ///< mm; the first one again at the end if it is closed
  std::size_t segment = 0;              ///< from points[segment] on, contains `position`
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< mm, nearest to the point asked for
};

/// Largest distance of the points of a line from the chord to its farthest point, mm.
double heightOf(const std::vector<Eigen::Vector3d>& line);

/// Search for edges of a mesh body by its faces. Immutable; several threads may use it.
class MeshEdges {
 public:
  /// `neighbours` as triangleNeighbours(); the body must outlive the object.
  MeshEdges(const MeshBody& body, std::span<const std::array<int, 3>> neighbours);

  /// The edge between two faces that is nearest to a point, if it is within `reach` (mm).
  std::optional<MeshEdge> at(int face, int other, const Eigen::Vector3d& point, double reach) const;

  /// Nearest point of all edges of a face, and the face on the other side; nothing if the face has
  /// no edges.
  struct Near {
    Eigen::Vector3d position;  ///< mm
    int other;                 ///< index of the face
  };
  std::optional<Near> nearest(int face, const Eigen::Vector3d& point) const;

 private:
  using Segment = std::array<int, 2>;

  const MeshBody& body_;
  std::map<std::pair<int, int>, std::vector<Segment>> borders_;
};

}  // namespace palpa::modeling

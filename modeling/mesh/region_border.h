#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "modeling/body/region.h"

namespace palpa::modeling {

/// Something that divides the surface and whose border the mesh is fitted to: a half space, or all
/// strokes of one region together. Borders of strokes inside other strokes do not count: only their
/// union does.
class RegionBorder {
 public:
  explicit RegionBorder(const HalfSpace& half);
  explicit RegionBorder(std::vector<Stroke> strokes);

  bool operator==(const RegionBorder& other) const;

  /// Negative inside. The half space's own value; the least of the strokes, in mm.
  double value(const Eigen::Vector3d& x) const;
  /// Of value(); its norm is slope(), except on the polyline of a stroke, where it is zero.
  Eigen::Vector3d gradient(const Eigen::Vector3d& x) const;
  double slope() const { return half_ ? half_->normal.norm() : 1.0; }

  bool isPainted() const { return !half_; }
  const std::vector<Stroke>& strokes() const { return strokes_; }
  /// strokeEdge() for the stroke that decides at x; infinite for a half space.
  double edgeAt(const Eigen::Vector3d& x, double longest) const;

  /// Could a mesh made for one follow to the other? The same half space, or as many strokes with
  /// as many points.
  bool isLike(const RegionBorder& other) const;

 private:
  struct Segment {
    Eigen::Vector3d start;
    Eigen::Vector3d along;
    double radius;
    bool isFirst;  ///< of its stroke
    bool isLast;
    Eigen::Vector3d nearest(const Eigen::Vector3d& x) const;
  };
  /// Segments from the end of the group before to `end`, in a box; most questions skip most groups.
  struct Group {
    std::size_t end;
    Eigen::Vector3d low;
    Eigen::Vector3d high;
    double radius;  ///< the largest
  };
  struct Nearest {
    double value;
    const Segment* segment;
  };
  Nearest nearest(const Eigen::Vector3d& x) const;

  std::optional<HalfSpace> half_;
  std::vector<Stroke> strokes_;
  std::vector<Segment> segments_;
  std::vector<Group> groups_;
};

/// Longest edges (mm) that meshes shall have along the border of a stroke with this radius (mm),
/// where the longest elsewhere is `longest`: short enough for a disc of eight corners or more, but
/// not below a twelfth of `longest` near the ends of the stroke, a quarter along its sides.
double strokeEdge(double radius, double longest, bool nearEnd);

}  // namespace palpa::modeling

#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "modeling/body/region.h"

namespace palpa::modeling {

/// Border of a part of space that divides the surface: of a half space, or of the union of all
/// strokes of one region. Meshes are fitted to it. Borders of strokes inside other strokes do not
/// count.
class RegionBorder {
 public:
  explicit RegionBorder(const HalfSpace& half);
  explicit RegionBorder(std::vector<Stroke> strokes);

  bool operator==(const RegionBorder& other) const;

  /// Signed value, negative inside: the value of the half space, or the smallest value of the
  /// strokes, in mm.
  double value(const Eigen::Vector3d& x) const;
  /// Gradient of value(). Its norm is slope(), except on the polyline of a stroke, where it is
  /// zero.
  Eigen::Vector3d gradient(const Eigen::Vector3d& x) const;
  double slope() const { return half_ ? half_->normal.norm() : 1.0; }

  bool isPainted() const { return !half_; }
  const std::vector<Stroke>& strokes() const { return strokes_; }
  /// strokeEdge() of the stroke with the smallest value at x; infinite for a half space.
  double edgeAt(const Eigen::Vector3d& x, double longest) const;

  /// True if a mesh fitted to one border can be updated to the other: the same half space, or
  /// equally many strokes with equally many points.
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
  /// Segments from the end of the previous group to `end`, with their bounding box. Most searches
  /// skip most groups.
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

/// Largest edge length (mm) along the border of a stroke with this radius (mm) in a mesh with the
/// largest edge length `longest` (mm). It is short enough to give a disc at least eight corners,
/// but at least a twelfth of `longest` near the ends of the stroke and a quarter along its sides.
double strokeEdge(double radius, double longest, bool nearEnd);

}  // namespace palpa::modeling

#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "app/core/page/place_weights.h"
#include "bem/model/material.h"

namespace palpa::app {

/// Whole numbers of 16 bits with one scale per column: value = scale * number. The rounding error
/// is at most half a scale, 1.5e-5 of the largest value of the column.
struct QuantisedColumns {
  int rows = 0;
  std::vector<std::int16_t> numbers;  ///< column after column
  std::vector<float> scales;

  void add(const Eigen::VectorXd& column);
  double at(Eigen::Index row, Eigen::Index column) const {
    return scales[static_cast<std::size_t>(column)] *
           numbers[static_cast<std::size_t>(column * rows + row)];
  }
};

/// The data of a page that can be touched (docs/touchable-page.md): a drawn surface, and a block of
/// Green's functions for touches with masks of one radius at any place of it. Members are what the
/// file contains; the functions compute what the script of the page computes.
struct TouchPage {
  /// A place on the drawn surface.
  struct Point {
    int triangle = 0;
    Eigen::Vector3d weights = Eigen::Vector3d::Constant(1.0 / 3);  ///< barycentric
  };
  /// Errors, relative. Measured with full solutions at random places, except for the model's own.
  struct Errors {
    /// Of the force of one touch by the discretisation of the solid: the largest of modelErrors,
    /// and their median.
    double model = 0, typicalModel = 0;
    double force = 0;  ///< of the force of one touch, by this page: the largest of forceErrors
    double typicalForce = 0;  ///< their median
    /// Of the displacement that one touch causes at another, over the geometric mean of ownSize()
    /// at both: of touches nearer than two radii, four radii, and beyond.
    std::array<double, 3> coupling{};
    /// Of the drawn displacements at their worst vertex, over the displacement of the touch: the
    /// largest, and the median of the samples.
    double field = 0, typicalField = 0;
    int samples = 0;  ///< places at which the forces were measured
  };
  /// Distances at which the classes of Errors::coupling end, in radii of touches.
  static constexpr std::array<double, 2> kCouplingDistances{2, 4};

  std::string name, materialName, version;
  bem::Material material;
  double radius = 0;  ///< mm, of every touch
  int modelNodes = 0, modelTriangles = 0;
  Errors errors;
  std::string notice;  ///< for the user: what had to be made coarser; mostly empty

  std::vector<Eigen::Vector3f> positions, normals;  ///< of vertices, at rest without loads; mm
  std::vector<std::array<std::uint16_t, 3>> triangles;
  std::vector<std::uint8_t> isTouchable;  ///< per triangle; false on supports
  /// Per triangle: its edges, each opposite to the corner of the same index.
  std::vector<std::array<std::uint16_t, 3>> edges;
  std::vector<Eigen::Vector3f> loaded;  ///< per vertex: displacement without touches, mm
  /// The same, mean over the mask: at the vertices, and the middles of the edges and triangles.
  std::vector<Eigen::Vector3f> meanLoaded, meanLoadedAtEdges, meanLoadedAtMiddles;
  /// Compliance of a touch (xx, yy, zz, xy, xz, yz), mm/N; 0 if it has none: at the vertices, the
  /// middles of the edges, and the middles of the triangles.
  std::vector<std::array<float, 6>> own, ownAtEdges, ownAtMiddles;
  /// Per triangle: relative error of the force of a touch in it, by interpolation and rounding; the
  /// displacement without touches counts for a touch that is a tenth of its radius deep.
  std::vector<float> forceErrors;
  /// Per triangle: the same by the discretisation of the solid, from estimatePressErrors() at the
  /// samples nearby.
  std::vector<float> modelErrors;
  std::vector<std::uint16_t> places;  ///< vertices of the touch places
  std::vector<PlaceWeights> weights;  ///< per vertex
  QuantisedColumns coupling;          ///< 3 N x 3 N, mm/N: of masks to masks
  /// Nodes of the model's mesh (split at sharp edges) between which a vertex lies.
  int nodeCount = 0;
  std::vector<std::array<std::uint16_t, 3>> nodes;
  std::vector<std::array<float, 3>> nodeWeights;
  QuantisedColumns fields;  ///< 3 nodes x 3 N, mm/N: displacements of the nodes

  static Eigen::Matrix3d symmetric(const std::array<float, 6>& numbers);
  Eigen::Vector3d positionOf(const Point& point) const;
  Eigen::Vector3d normalOf(const Point& point) const;
  /// Compliance of a touch, mm/N: quadratic between vertices and edges, with a cubic bubble that
  /// has the right value at the middle.
  Eigen::Matrix3d ownCompliance(const Point& point) const;
  /// Its size: Frobenius norm.
  static double sizeOf(const Eigen::Matrix3d& compliance) { return compliance.norm(); }
  /// The forces at the places that replace a unit force at a point: linear between the vertices.
  std::map<int, Eigen::Matrix3d> placesAt(const Point& point) const;
  /// Displacement of the mask at `a` per force on another mask at `b`, mm/N.
  Eigen::Matrix3d couplingOf(const Point& a, const Point& b) const;
  /// Displacements of all vertices per force on the mask at `point`, mm/N: 3 rows per vertex.
  Eigen::MatrixX3d fieldOf(const Point& point) const;
  /// Displacement of the mask at a point without touches, mm: interpolated like ownCompliance().
  Eigen::Vector3d loadedAt(const Point& point) const;
  /// Forces, N, of touches that grab the points and displace them to `displacements` (mm, relative
  /// to the unloaded shape).
  std::vector<Eigen::Vector3d> forces(std::span<const Point> points,
                                      std::span<const Eigen::Vector3d> displacements) const;
  /// The class of Errors::coupling of two places.
  std::size_t couplingClass(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
};

}  // namespace palpa::app

#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/core/model/touch_model.h"
#include "app/core/page/touch_places.h"
#include "base/job.h"
#include "modeling/project/project.h"

namespace palpa::app {

/// What the user chooses for a page that can be touched.
struct TouchPageSettings {
  static constexpr int kMinPlaces = 8, kMaxPlaces = 1000;
  static constexpr double kMinSize = 1, kMaxSize = 100;
  int places = 250;       ///< touch places whose displacements are stored
  double megabytes = 12;  ///< most size of the file, in 10^6 bytes
  double radius = 0;      ///< of every touch, mm; 0: see pageProject()

  /// Throws SolverError (kBadCondition) that names the number out of range.
  void validate() const;
};

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
  /// Errors, relative. Measured with full solutions at places between the vertices, except for the
  /// model's own.
  struct Errors {
    double model = 0;  ///< estimateTouchError(): discretisation of the solid
    double force = 0;  ///< of the force of one touch, by this page: the largest of forceErrors
    double typicalForce = 0;  ///< their median
    /// Of the displacement that one touch causes at another, over its own displacement, if the
    /// two are at least two radii apart; and nearer.
    double coupling = 0, couplingNear = 0;
    /// Of the drawn displacements at their worst vertex, over the displacement of the touch: the
    /// largest (near supports), and the median of the samples.
    double field = 0, typicalField = 0;
    int samples = 0;  ///< places at which they were measured
  };

  std::string name, materialName, version;
  bem::Material material;
  double radius = 0;      ///< mm, of every touch
  double widestMask = 0;  ///< mm, where the mesh cannot carry the radius
  int modelNodes = 0, modelTriangles = 0;
  Errors errors;
  std::string notice;  ///< for the user: what had to be made coarser; mostly empty

  std::vector<Eigen::Vector3f> positions, normals;  ///< of vertices, at rest without loads; mm
  std::vector<std::array<std::uint16_t, 3>> triangles;
  std::vector<std::uint8_t> isTouchable;    ///< per triangle; false on supports
  std::vector<Eigen::Vector3f> loaded;      ///< per vertex: displacement without touches, mm
  std::vector<Eigen::Vector3f> meanLoaded;  ///< the same, mean over the mask at the vertex
  /// Per vertex: compliance of a touch there (xx, yy, zz, xy, xz, yz), mm/N; 0 if it has none.
  std::vector<std::array<float, 6>> own;
  std::vector<std::array<float, 6>> ownAtMiddles;  ///< the same at the middles of triangles
  /// Per triangle: relative error of the force of a touch in it, by interpolation and rounding.
  std::vector<float> forceErrors;
  std::vector<std::uint16_t> places;  ///< vertices of the touch places
  std::vector<PlaceWeights> weights;  ///< per vertex
  QuantisedColumns coupling;          ///< 3 N x 3 N, mm/N, less kernel(): of masks to masks
  /// Nodes of the model's mesh (split at sharp edges) between which a vertex lies.
  int nodeCount = 0;
  std::vector<std::array<std::uint16_t, 3>> nodes;
  std::vector<std::array<float, 3>> nodeWeights;
  std::vector<std::uint8_t> isHeld;  ///< per vertex: 1 if a support holds it fast
  QuantisedColumns fields;  ///< 3 nodes x 3 N, mm/N: displacements of the nodes, less kernel()

  static Eigen::Matrix3d symmetric(const std::array<float, 6>& numbers);
  Eigen::Vector3d positionOf(const Point& point) const;
  Eigen::Vector3d normalOf(const Point& point) const;
  /// Compliance of a touch, mm/N: interpolated between the vertices, with a cubic bubble that has
  /// the right value at the middle.
  Eigen::Matrix3d ownCompliance(const Point& point) const;
  /// Displacement of the mask at `a` per force on another mask at `b`, mm/N: interpolated between
  /// the touch places, less the kernel, which follows the two points exactly.
  Eigen::Matrix3d couplingOf(const Point& a, const Point& b) const;
  /// Displacement of a vertex per force on the mask at `point`, mm/N.
  Eigen::Matrix3d fieldAt(std::size_t vertex, const Point& point) const;
  /// Displacement of the mask at a point without touches, mm.
  Eigen::Vector3d loadedAt(const Point& point) const;
  /// Forces, N, of touches that grab the points and displace them to `displacements` (mm, relative
  /// to the unloaded shape).
  std::vector<Eigen::Vector3d> forces(std::span<const Point> points,
                                      std::span<const Eigen::Vector3d> displacements) const;

  /// Displacements near a mask on a half-space have the size
  /// (1 - ν/2 along, 1 - ν across the surface) / (2 π G) times the potential of the mask, here
  /// 1/sqrt(ρ² + ε²). What remains of a Green's function without it is smooth and can be
  /// interpolated between places. `normal`: at the mask; `distance` ρ and `core` ε in mm.
  Eigen::Matrix3d kernel(const Eigen::Vector3d& normal, double distance, double core) const;
  /// ε of the mean over a second mask: the value at ρ = 0 is ∫∫ Φ Φ / ρ = 2.408 / radius.
  double coreOfMeans() const { return radius / 2.408; }
  /// ε at a point: ∫ Φ / ρ = 3.2 / radius.
  double coreAtPoints() const { return radius / 3.2; }
  /// The kernel between two masks: the mean of both directions, so that it is symmetric.
  Eigen::Matrix3d meanKernel(const Eigen::Vector3d& a, const Eigen::Vector3d& normalA,
                             const Eigen::Vector3d& b, const Eigen::Vector3d& normalB) const;

 private:
  /// Weights of places at a point: up to three times as many as at a vertex.
  std::vector<std::pair<int, double>> placesAt(const Point& point) const;
};

/// Bytes of the file for a model of so many nodes, and so many drawn vertices and triangles.
double pageBytes(double nodes, double vertices, double triangles, double places);

/// Builds the model of pageProject() and computes the data: three columns per vertex, triangle and
/// sample, and the error estimate of the model. Takes about a third of the size of the file in
/// memory beyond the model. If the mesh of the model is too fine for the size, there are fewer
/// places, which `notice` says.
///
/// Phases of progress: the phases of buildTouchModel(), "Green's function", "estimate errors".
/// Throws as buildTouchModel(), SolverError (kBadCondition: settings out of range, or supports
/// cover the whole surface; kTooLarge: the model has too many nodes for the size), Cancelled.
TouchPage makeTouchPage(const modeling::Project& project, const std::string& version,
                        const TouchPageSettings& settings = {}, const Job& job = {});

/// The same for a model that is built, with touches of `settings.radius`, which must not be 0.
TouchPage makeTouchPage(const std::shared_ptr<const TouchModel>& model,
                        const TouchPageSettings& settings, const Job& job = {});

}  // namespace palpa::app

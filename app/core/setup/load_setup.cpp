#include "app/core/setup/load_setup.h"

#include <limits>
#include <numeric>
#include <string>

#include "bem/base/error.h"

namespace palpa::app {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Smallest principal second moment of a region over the largest: strips a thousand times longer
/// than wide.
constexpr double kNarrowest = 1e-6;

/// Projected fields on the region of a load.
class LoadedRegion {
 public:
  LoadedRegion(const std::string& name, const bem::Discretisation& on,
               const TractionProjection& onRegion)
      : name_(name), on_(on), onRegion_(onRegion), all_(on.elementCount()) {
    std::iota(all_.begin(), all_.end(), 0);
  }

  VectorXd uniform(const Vector3d& traction) const {
    return onRegion_({[traction](const Vector3d&, const Vector3d&) { return traction; }, kSmooth});
  }

  VectorXd totalForce(const Vector3d& force) const {
    return uniform(force / area(resultant(uniform(Vector3d::UnitX()))));
  }

  VectorXd moment(const Vector3d& moment) const {
    // The moments of uniform tractions along x and y contain the first moments of the region.
    const bem::Resultant alongX = resultant(uniform(Vector3d::UnitX())),
                         alongY = resultant(uniform(Vector3d::UnitY()));
    const Vector3d centroid =
        Vector3d(alongY.moment.z(), -alongX.moment.z(), alongX.moment.y()) / area(alongX);
    VectorXd turning[3];
    Matrix3d second;
    for (int axis = 0; axis < 3; ++axis) {
      turning[axis] = onRegion_({[axis, centroid](const Vector3d& x, const Vector3d&) {
                                   return Vector3d(Vector3d::Unit(axis).cross(x - centroid));
                                 },
                                 kSmooth});
      const bem::Resultant turned = resultant(turning[axis]);
      second.col(axis) = turned.moment - centroid.cross(turned.force);
    }
    const Vector3d principal =
        Eigen::SelfAdjointEigenSolver<Matrix3d>((second + second.transpose()) / 2).eigenvalues();
    if (!(principal[0] > kNarrowest * principal[2]))
      throw bem::SolverError(
          bem::SolverError::Kind::kBadCondition,
          "load \"" + name_ + "\": its region is too narrow for a moment; choose a wider one");
    const Vector3d w = second.partialPivLu().solve(moment);
    return w[0] * turning[0] + w[1] * turning[1] + w[2] * turning[2];
  }

 private:
  static constexpr double kSmooth = std::numeric_limits<double>::infinity();

  bem::Resultant resultant(const VectorXd& traction) const { return on_.resultant(traction, all_); }

  /// From the resultant of the uniform traction 1 MPa along x.
  double area(const bem::Resultant& alongX) const {
    if (!(alongX.force.x() > 0))
      throw bem::SolverError(bem::SolverError::Kind::kBadCondition,
                             "load \"" + name_ + "\": its region has no area; choose a wider one");
    return alongX.force.x();
  }

  const std::string& name_;
  const bem::Discretisation& on_;
  const TractionProjection& onRegion_;
  std::vector<int> all_;
};

}  // namespace

void addLoad(const modeling::Project& project, std::size_t index, BoundarySetup& setup,
             const TractionProjection& onRegion) {
  const modeling::Load& load = project.loads[index];
  const LoadedRegion region(load.name, *setup.discretisation, onRegion);
  if (std::holds_alternative<modeling::Gravity>(load.what))
    setup.addBodyForce(load.name, modeling::weightPerVolume(project, index));
  else if (const auto* total = std::get_if<modeling::TotalForce>(&load.what))
    setup.addLoad(load.name, region.totalForce(total->force));
  else if (const auto* moment = std::get_if<modeling::Moment>(&load.what))
    setup.addLoad(load.name, region.moment(moment->moment)).couple =
        moment->moment.norm() / setup.mesh().boundingSize();
  else
    setup.addLoad(load.name, onRegion(loadTraction(load)));
}

}  // namespace palpa::app

#include "bem/triangle/results.h"

#include <cmath>
#include <numbers>

#include "bem/model/displacement_recovery.h"
#include "bem/triangle/flat_triangle_integrals.h"
#include "bem/triangle/kelvin.h"
#include "bem/triangle/triangle_body_force.h"
#include "bem/triangle/triangle_contact_surface.h"

namespace palpa::bem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Corner values of one triangle as columns.
Matrix3d cornerDisplacements(const BoundaryMesh& mesh, const Eigen::VectorXd& u, int t) {
  Matrix3d values;
  for (int a = 0; a < 3; ++a) values.col(a) = u.segment<3>(3 * mesh.triangles[t][a]);
  return values;
}

Matrix3d cornerTractions(const TractionSlots& slots, const Eigen::VectorXd& p, int t) {
  Matrix3d values;
  for (int a = 0; a < 3; ++a) values.col(a) = p.segment<3>(3 * slots.ofCorner[t][a]);
  return values;
}

FlatTriangle flatTriangle(const BoundaryMesh& mesh, int t) {
  double corners[3][3];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) corners[k][i] = mesh.nodes[mesh.triangles[t][k]][i];
  return makeFlatTriangle(corners);
}

/// The displacement of a body force; `kept` may be null.
Vector3d bodyForceDisplacement(const BoundaryMesh& mesh, const Bulk& bulk,
                               const TriangleBodyForce* kept, const Vector3d& x) {
  return kept ? kept->at(x, bulk) : TriangleBodyForce(mesh).at(x, bulk);
}

Matrix3d unpack(const double (&packed)[6]) {
  Matrix3d full;
  full << packed[0], packed[1], packed[3], packed[1], packed[2], packed[4], packed[3], packed[4],
      packed[5];
  return full;
}

/// Integrals of Kelvin's kernels against the three basis functions of one triangle.
struct TriangleBlocks {
  Matrix3d U[3], T[3];
  double solidAngle = 0;  ///< of the triangle, seen from the collocation point

  TriangleBlocks(const BoundaryMesh& mesh, int t, const Material& material, const Vector3d& point) {
    constexpr double kPi = std::numbers::pi;
    const double nu = material.poissonRatio;
    const FlatTriangle flat = flatTriangle(mesh, t);
    const Vector3d normal(flat.normal);
    const double x[3] = {point[0], point[1], point[2]};
    TriangleIntegrals<double> integrals;
    integrateClosedForm<double>(flat, x, integrals);
    for (int a = 0; a < 3; ++a) {
      const Matrix3d rr3 = unpack(integrals[a].rr3), rr5 = unpack(integrals[a].rr5);
      const Vector3d r3(integrals[a].r3);
      U[a] = ((3 - 4 * nu) * rr3.trace() * Matrix3d::Identity() + rr3) /
             (16 * kPi * material.shear() * (1 - nu));
      T[a] = -((1 - 2 * nu) * rr5.trace() * Matrix3d::Identity() + 3 * rr5 -
               (1 - 2 * nu) * (r3 * normal.transpose() - normal * r3.transpose())) /
             (8 * kPi * (1 - nu));
      solidAngle += rr5.trace();
    }
  }
};

/// A triangle cut out of a mesh triangle, by the barycentric weights of its corners (columns).
using Cell = Matrix3d;

/// Contribution of one mesh triangle to the interior stress, by subdivision towards the point.
class StressIntegral {
 public:
  StressIntegral(const BoundaryMesh& mesh, int t, const Matrix3d& u, const Matrix3d& p,
                 const Bulk& bulk, const Vector3d& x)
      : u_(u), p_(p), bulk_(bulk), x_(x), normal_(mesh.normal(t)), area_(mesh.area(t)) {
    for (int a = 0; a < 3; ++a) corners_.col(a) = mesh.nodes[mesh.triangles[t][a]];
  }

  Matrix3d value() const { return add(Cell::Identity(), 1.0, 0); }

 private:
  static constexpr int kDeepest = 12;
  /// Distance over cell radius from which the 16-point rule has errors of about 1e-7.
  static constexpr double kFar = 4.0;

  Matrix3d add(const Cell& cell, double part, int depth) const {
    const Matrix3d corners = corners_ * cell;
    const Vector3d centroid = corners.rowwise().mean();
    const double radius = (corners.colwise() - centroid).colwise().norm().maxCoeff();
    if ((centroid - x_).norm() < kFar * radius && depth < kDeepest) {
      const Vector3d m0 = (cell.col(0) + cell.col(1)) / 2, m1 = (cell.col(1) + cell.col(2)) / 2,
                     m2 = (cell.col(2) + cell.col(0)) / 2;
      Cell sub[4];
      sub[0] << cell.col(0), m0, m2;
      sub[1] << m0, cell.col(1), m1;
      sub[2] << m2, m1, cell.col(2);
      sub[3] << m0, m1, m2;
      Matrix3d sum = Matrix3d::Zero();
      for (const Cell& s : sub) sum += add(s, part / 4, depth + 1);
      return sum;
    }
    Matrix3d sum = Matrix3d::Zero();
    for (const TrianglePoint& q : triangleRule16()) {
      const Vector3d weights =
          cell * Vector3d(q.barycentric[0], q.barycentric[1], q.barycentric[2]);
      const Vector3d y = corners_ * weights;
      sum += q.weight * part * area_ *
             (kelvinStressFromTraction(x_, y, p_ * weights, bulk_.material) +
              kelvinStressFromDisplacement(x_, y, normal_, u_ * weights, bulk_.material));
      if (bulk_.hasBodyForce())
        sum += bodyForceStress(y - x_, q.weight * part * area_ * normal_, bulk_);
    }
    return sum;
  }

  Matrix3d corners_, u_, p_;
  Bulk bulk_;
  Vector3d x_, normal_;
  double area_;
};

/// 1/2 ∫ p.u dΓ; `workOfBulge` gives b_ab . traction of an edge.
template <class Work>
double energyOf(const BoundaryMesh& mesh, const TractionSlots& slots, const Eigen::VectorXd& u,
                const Eigen::VectorXd& p, const Work& workOfBulge) {
  double sum = 0;
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    const Matrix3d tractions = cornerTractions(slots, p, t);
    if (tractions.isZero(0)) continue;
    const Matrix3d work = cornerDisplacements(mesh, u, t).transpose() * tractions;
    const double area = mesh.area(t);
    sum += area / 12.0 * (work.sum() + work.trace());
    // ∫ λ_a λ_b λ_c = area / 60, twice that for c = a or b.
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      sum += area / 60.0 *
             workOfBulge(t, a, 2 * tractions.col(a) + 2 * tractions.col(b) + tractions.col(c));
    }
  }
  return 0.5 * sum;
}

}  // namespace

Resultant tractionResultant(const BoundaryMesh& mesh, const TractionSlots& slots,
                            const Eigen::VectorXd& p, std::span<const int> triangles) {
  Resultant sum;
  for (const int t : triangles) {
    const Matrix3d tractions = cornerTractions(slots, p, t);
    const double unit = mesh.area(t) / 12.0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const Vector3d force = (a == b ? 2 : 1) * unit * tractions.col(b);
        sum.force += force;
        sum.moment += mesh.nodes[mesh.triangles[t][a]].cross(force);
      }
  }
  return sum;
}

double strainEnergy(const BoundaryMesh& mesh, const TractionSlots& slots, const Eigen::VectorXd& u,
                    const Eigen::VectorXd& p) {
  const DisplacementRecovery recovery(mesh, slots);
  return energyOf(mesh, slots, u, p, [&](int t, int a, const Vector3d& traction) {
    double sum = 0;
    for (const auto& [node, weight] : recovery.bulge(t, a))
      sum += weight * u.segment<3>(3 * node).dot(traction);
    return sum;
  });
}

double TriangleContactSurface::strainEnergy(const Eigen::VectorXd& u,
                                            const Eigen::VectorXd& p) const {
  return energyOf(mesh(), slots(), u, p, [&](int t, int a, const Vector3d& traction) {
    double sum = 0;
    for (const auto& [node, weight] : bulge(t, a))
      sum += weight * u.segment<3>(3 * node).dot(traction);
    return sum;
  });
}

std::vector<Matrix3d> surfaceStress(const BoundaryMesh& mesh, const TractionSlots& slots,
                                    const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                    const Material& material) {
  std::vector<Matrix3d> stress(slots.slots.size(), Matrix3d::Zero());
  std::vector<double> weight(slots.slots.size(), 0.0);
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    const FlatTriangle flat = flatTriangle(mesh, t);
    const Matrix3d displacements = cornerDisplacements(mesh, u, t);
    Matrix3d frame;
    frame << Vector3d(flat.axis[0]), Vector3d(flat.axis[1]), Vector3d(flat.normal);
    Eigen::Matrix<double, 3, 2> gradient = Eigen::Matrix<double, 3, 2>::Zero();
    for (int a = 0; a < 3; ++a)
      gradient +=
          displacements.col(a) * Eigen::RowVector2d(flat.gradient[a][0], flat.gradient[a][1]);
    for (int a = 0; a < 3; ++a) {
      const int slot = slots.ofCorner[t][a];
      stress[slot] += flat.area * surfaceStress(frame, gradient, p.segment<3>(3 * slot), material);
      weight[slot] += flat.area;
    }
  }
  for (std::size_t s = 0; s < stress.size(); ++s) stress[s] /= weight[s];
  return stress;
}

Matrix3d surfaceStress(const Matrix3d& frame, const Eigen::Matrix<double, 3, 2>& slopes,
                       const Vector3d& traction, const Material& material) {
  const double nu = material.poissonRatio, coupling = nu / (1 - nu);
  const Eigen::Matrix2d tangential = frame.leftCols<2>().transpose() * slopes;
  const Eigen::Matrix2d strain = (tangential + tangential.transpose()) / 2;
  const Vector3d inFrame = frame.transpose() * traction;
  Matrix3d local;
  local.topLeftCorner<2, 2>() =
      2 * material.shear() * (strain + coupling * strain.trace() * Eigen::Matrix2d::Identity()) +
      coupling * inFrame[2] * Eigen::Matrix2d::Identity();
  local.col(2) = inFrame;
  local.row(2) = inFrame.transpose();
  return frame * local * frame.transpose();
}

double vonMises(const Matrix3d& stress) {
  const Matrix3d deviator = stress - stress.trace() / 3 * Matrix3d::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

Vector3d surfaceDisplacement(const BoundaryMesh& mesh, const TractionSlots& slots,
                             const Eigen::VectorXd& u, const Eigen::VectorXd& p, const Bulk& bulk,
                             const SurfacePoint& place, const TriangleBodyForce* bodyForce) {
  // With ũ the interpolated value at x: C (u(x) - ũ) = ∫ U p - ∫ T (u - ũ) + B, and C = -∫ T by
  // rigid-body translation. Subtracting ũ keeps every integral convergent, also where x lies on an
  // edge.
  const Vector3d interpolated = cornerDisplacements(mesh, u, place.triangle) * place.weights;
  Vector3d right = Vector3d::Zero();
  Matrix3d freeTerm = Matrix3d::Zero();
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    const Matrix3d displacements = cornerDisplacements(mesh, u, t);
    const Matrix3d tractions = cornerTractions(slots, p, t);
    const TriangleBlocks blocks(mesh, t, bulk.material, place.position);
    for (int a = 0; a < 3; ++a) {
      right += blocks.U[a] * tractions.col(a) - blocks.T[a] * (displacements.col(a) - interpolated);
      freeTerm -= blocks.T[a];
    }
  }
  if (bulk.hasBodyForce()) right += bodyForceDisplacement(mesh, bulk, bodyForce, place.position);
  return interpolated + freeTerm.partialPivLu().solve(right);
}

std::optional<InteriorState> interiorState(const BoundaryMesh& mesh, const TractionSlots& slots,
                                           const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                           const Bulk& bulk, const Vector3d& point,
                                           const TriangleBodyForce* bodyForce) {
  InteriorState state{Vector3d::Zero(), Matrix3d::Zero()};
  if (bulk.hasBodyForce()) state.displacement = bodyForceDisplacement(mesh, bulk, bodyForce, point);
  double solidAngle = 0;
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    const Matrix3d displacements = cornerDisplacements(mesh, u, t);
    const Matrix3d tractions = cornerTractions(slots, p, t);
    const TriangleBlocks blocks(mesh, t, bulk.material, point);
    for (int a = 0; a < 3; ++a)
      state.displacement += blocks.U[a] * tractions.col(a) - blocks.T[a] * displacements.col(a);
    solidAngle += blocks.solidAngle;
    state.stress += StressIntegral(mesh, t, displacements, tractions, bulk, point).value();
  }
  if (solidAngle < 2 * std::numbers::pi) return std::nullopt;
  return state;
}

}  // namespace palpa::bem

// The seed as it is written down: H and G by plain scalar loops, one dense LU factorisation, two
// triangular solves per touched degree of freedom.
#include <numeric>
#include <optional>

#include "bem/contact/contact_mask.h"
#include "bem/model/traction_projection.h"
#include "bem/triangle/triangle_contact_surface.h"
#include "bench/peers/case_mesh.h"
#include "bench/peers/lapack_lu.h"
#include "bench/peers/peer_row.h"
#include "bench/plain_assembly.h"
#include "bench/timing.h"

namespace palpa::bench {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

class PlainBody {
 public:
  PlainBody(const app::BoundarySetup& setup, PeerRow& row)
      : setup_(setup),
        dofs_(setup.mesh(), setup.meshSlots(), setup.conditions.ofSlot, setup.material) {
    row.values["assemble"] = secondsFor([&] {
      assemblePlain(setup.mesh(), setup.meshSlots(), setup.mesh().nodes, setup.material,
                    looseAccuracy(), H_, G_, {});
      addFreeTerm();
    });
    row.values["factorise"] = secondsFor([&] { factors_.emplace(systemMatrix()); });
  }

  const bem::DegreesOfFreedom& dofs() const { return dofs_; }

  bem::BoundaryField solve(const bem::BoundaryField& known) const {
    // Most of what is known is zero: only the other columns are multiplied.
    MatrixXd right = MatrixXd::Zero(H_.rows(), known.u.cols());
    for (Eigen::Index k = 0; k < known.p.rows(); ++k)
      if (!known.p.row(k).isZero(0)) right.noalias() += G_.col(k) * known.p.row(k);
    for (Eigen::Index k = 0; k < known.u.rows(); ++k)
      if (!known.u.row(k).isZero(0)) right.noalias() -= H_.col(k) * known.u.row(k);
    factors_->solve(right);
    bem::BoundaryField field = dofs_.expand(right, MatrixXd());
    field.u += known.u;
    field.p += known.p;
    return field;
  }

  /// The field of unit forces on a mask.
  bem::BoundaryField touch(const bem::ContactMask& mask) const {
    bem::BoundaryField unit{MatrixXd::Zero(H_.cols(), 3), MatrixXd::Zero(G_.cols(), 3)};
    const auto& first = setup_.meshSlots().firstOfNode;
    for (std::size_t k = 0; k < mask.nodes.size(); ++k)
      for (int s = first[mask.nodes[k]]; s < first[mask.nodes[k] + 1]; ++s)
        unit.p.middleRows<3>(3 * s) = mask.traction[k] * Eigen::Matrix3d::Identity();
    return solve(unit);
  }

 private:
  void addFreeTerm() {
    for (Eigen::Index row = 0; row < H_.rows(); row += 3) {
      Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
      for (Eigen::Index column = 0; column < H_.cols(); column += 3)
        sum += H_.block<3, 3>(row, column);
      H_.block<3, 3>(row, row) -= sum;
    }
  }

  MatrixXd systemMatrix() const {
    MatrixXd A(H_.rows(), dofs_.count());
    for (int dof = 0; dof < dofs_.count(); ++dof)
      if (!dofs_.isConstrained(dof)) {
        A.col(dof) = H_.middleCols<3>(dof / 3 * 3) * dofs_.frame(dof / 3).col(dof % 3);
      } else {
        A.col(dof).setZero();
        for (const auto& weight : dofs_.tractionOf(dof))
          A.col(dof) -= G_.middleCols<3>(3 * weight.slot) * weight.traction;
      }
    return A;
  }

  const app::BoundarySetup& setup_;
  bem::DegreesOfFreedom dofs_;
  MatrixXd H_, G_;
  std::optional<LapackLu> factors_;
};

}  // namespace

PeerRow measurePlain(const PeerCase& body, double size) {
  PeerRow row;
  app::BoundarySetup setup = triangleSetup(body, size);
  std::optional<PlainBody> plain;
  row.values["setup"] = secondsFor([&] {
    row.values["mesh"] = secondsFor([&] { setup = triangleSetup(body, size); });
    plain.emplace(setup, row);
  });
  const bem::BoundaryMesh& mesh = setup.mesh();
  row.values["n"] = mesh.nodeCount();
  row.values["unknowns"] = plain->dofs().count();

  const bem::TriangleContactSurface surface(mesh, setup.meshSlots(), plain->dofs());
  const auto complianceAt = [&](const Vector3d& at) -> Eigen::Matrix3d {
    const bem::ContactMask mask = makeContactMask(surface, at, body.reference.radius);
    return mask.displacement(plain->touch(mask).u);
  };
  std::vector<double> begins;
  for (const Vector3d& at : body.places) begins.push_back(secondsFor([&] { complianceAt(at); }));
  // The solve gives the field, too, and nothing is kept from place to place.
  row.values["touch"] = row.values["move"] = quantilesOf(begins).p50;
  row.values["stiffness"] = stiffnessError(body, complianceAt(body.reference.at));

  bem::BoundaryConditions given = setup.conditions;
  for (int k = 0; k < mesh.nodeCount(); ++k)
    given.displacement.segment<3>(3 * k) = body.exactDisplacement(mesh.nodes[k]);
  std::vector<int> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  const double everywhere = std::numeric_limits<double>::infinity();
  given.traction = projectTraction(
      mesh, setup.meshSlots(),
      {all, [&](const Vector3d& x, const Vector3d& n) { return body.exactTraction(x, n); },
       everywhere});
  const bem::BoundaryField field = plain->solve(plain->dofs().knownField(given));
  SurfaceError error(body);
  bem::visitQuadraturePoints(mesh, all, everywhere,
                             [&](int t, const Vector3d& weights, double weight) {
                               Vector3d u = Vector3d::Zero();
                               for (int k = 0; k < 3; ++k)
                                 u += weights[k] * field.u.block<3, 1>(3 * mesh.triangles[t][k], 0);
                               error.add(mesh.point(t, weights), u, weight);
                             });
  row.values["kelvin"] = error.relative();
  return row;
}

}  // namespace palpa::bench

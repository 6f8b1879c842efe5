#include "bem/contact/bilateral_contact_solver.h"
#include "bem/contact/nodal_switching.h"
#include "bem/dense/make_reference_problem.h"

#include <gtest/gtest.h>

#include <numeric>

#include "app/verification/exact/simple_meshes.h"
#include "bem/base/error.h"
#include "bem/triangle/results.h"
#include "bem/triangle/triangle_contact_surface.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Silicone-like sphere of radius 25 mm, fixed below z = -20 mm.
struct Sphere {
  BoundaryMesh mesh;
  TractionSlots slots;
  std::vector<SlotCondition> conditions;
  std::shared_ptr<const ReferenceProblem> problem;

  explicit Sphere(int n) : mesh(tagged(n)), slots(mesh) {
    for (const auto& slot : slots.slots)
      conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
    problem =
        makeDenseReferenceProblem(mesh, slots, {conditions, {0.1, 0.45}, {}, Precision::kDouble});
  }
  static BoundaryMesh tagged(int n) {
    BoundaryMesh mesh = verification::sphereMesh(25, n);
    for (int t = 0; t < mesh.triangleCount(); ++t)
      mesh.tags[t] = mesh.point(t, Vector3d::Constant(1.0 / 3))[2] < -20 ? 1 : 0;
    return mesh;
  }
  BoundaryField zero() const {
    return {VectorXd::Zero(3 * mesh.nodeCount()), VectorXd::Zero(3 * slots.count())};
  }
  BilateralContactSolver solver() const { return {problem, slots, zero()}; }
  ContactMask mask(const Vector3d& at, double radius) const {
    return makeContactMask(TriangleContactSurface(mesh, slots, problem->dofs()), at, radius);
  }
  std::vector<int> triangles(int tag) const {
    std::vector<int> list;
    for (int t = 0; t < mesh.triangleCount(); ++t)
      if (mesh.tags[t] == tag) list.push_back(t);
    return list;
  }
};

const Sphere& sphere() {
  static const Sphere shared(10);  // 602 nodes, edges of 3.9 mm
  return shared;
}

const Vector3d kTop(0, 0, 25), kSide(25, 0, 0);

TEST(ContactMask, IsNormalisedAndMeasuresRigidTranslationsExactly) {
  const ContactMask mask = sphere().mask({10, 12, 19}, 9);
  EXPECT_NEAR(std::accumulate(mask.measure.begin(), mask.measure.end(), 0.0), 1.0, 1e-12);
  VectorXd translated(3 * sphere().mesh.nodeCount());
  for (int k = 0; k < sphere().mesh.nodeCount(); ++k)
    translated.segment<3>(3 * k) = Vector3d(0.1, -0.2, 0.3);
  EXPECT_LE((mask.displacement(translated) - Vector3d(0.1, -0.2, 0.3)).norm(), 1e-14);
  // ∫ Φ dΓ = 1: a force of 1 N applied as tractions has the resultant 1 N.
  VectorXd p = VectorXd::Zero(3 * sphere().slots.count());
  for (std::size_t k = 0; k < mask.nodes.size(); ++k)
    p[3 * sphere().slots.firstOfNode[mask.nodes[k]]] = mask.traction[k];
  EXPECT_NEAR(tractionResultant(sphere().mesh, sphere().slots, p, sphere().triangles(0)).force[0],
              1.0, 1e-12);
}

TEST(ContactMask, IsNoNarrowerThanTheMeshCanRepresent) {
  const ContactMask mask = sphere().mask(kTop, 0.01);
  EXPECT_GT(mask.radius, 2 * 3.0);
  EXPECT_LT(mask.radius, 3 * 5.0);
}

TEST(ContactMask, DoesNotTouchTheFarSideOfAThinBody) {
  BoundaryMesh plate = verification::boxMesh({-20, -20, 0}, {20, 20, 2}, 20, 20, 1);
  const TractionSlots slots(plate);
  std::vector<SlotCondition> conditions;
  for (const auto& slot : slots.slots)
    conditions.push_back(slot.tag == 0 ? SlotCondition::kFixed : SlotCondition::kTraction);
  const DegreesOfFreedom dofs(plate, slots, conditions, {0.1, 0.3});
  const ContactMask mask =
      makeContactMask(TriangleContactSurface(plate, slots, dofs), {0, 0, 2}, 6);
  for (const int node : mask.nodes) EXPECT_EQ(plate.nodes[node][2], 2.0);
}

TEST(ContactMask, RefusesATouchOnASupport) {
  EXPECT_THROW(sphere().mask({0, 0, -25}, 3), SolverError);
}

TEST(BilateralContactSolver, GrabbedPlacesMoveAsPrescribed) {
  BilateralContactSolver solver = sphere().solver();
  const ContactMask top = sphere().mask(kTop, 8), side = sphere().mask(kSide, 8);
  solver.addGrab(top, Vector3d(0, 0.5, -2));
  solver.addGrab(side, Vector3d(1, 0, 0));
  const BoundaryField field = solver.field(solver.forces());
  // D is symmetrised, so the means have the reciprocity defect, below 1 % on this mesh.
  EXPECT_LE((top.displacement(field.u) - Vector3d(0, 0.5, -2)).norm(), 0.01 * 2);
  EXPECT_LE((side.displacement(field.u) - Vector3d(1, 0, 0)).norm(), 0.01 * 2);
  EXPECT_LE(sphere().problem->relativeResidual(field), 1e-10);
}

TEST(BilateralContactSolver, ForceAndSupportBalance) {
  BilateralContactSolver solver = sphere().solver();
  solver.addGrab(sphere().mask(kTop, 8), Vector3d(0, 0, -2));
  const VectorXd forces = solver.forces();
  const BoundaryField field = solver.field(forces);
  const auto reaction =
      tractionResultant(sphere().mesh, sphere().slots, field.p.col(0), sphere().triangles(1));
  EXPECT_LT(forces[2], 0);
  EXPECT_NEAR(reaction.force[2], -forces[2], 0.01 * std::abs(forces[2]));
  EXPECT_NEAR(reaction.force[0], 0, 1e-3 * std::abs(forces[2]));
  // The work of the contact is the strain energy.
  EXPECT_NEAR(strainEnergy(sphere().mesh, sphere().slots, field.u.col(0), field.p.col(0)),
              0.5 * 2 * -forces[2], 0.005 * std::abs(forces[2]));
}

TEST(BilateralContactSolver, EqualsTheSolutionForTheSameTractions) {
  BilateralContactSolver solver = sphere().solver();
  const ContactMask mask = sphere().mask({15, 0, 20}, 8);
  const Vector3d force(0.02, -0.01, -0.05);
  solver.addForce(mask, force);
  BoundaryConditions given(sphere().mesh, sphere().slots);
  for (std::size_t k = 0; k < mask.nodes.size(); ++k)
    given.traction.segment<3>(3 * sphere().slots.firstOfNode[mask.nodes[k]]) =
        mask.traction[k] * force;
  const BoundaryField expected =
      sphere().problem->solveField(sphere().problem->dofs().knownField(given));
  const BoundaryField field = solver.field(solver.forces());
  EXPECT_LE((field.u - expected.u).norm(), 1e-10 * expected.u.norm());
  EXPECT_LE((field.p - expected.p).norm(), 1e-10 * expected.p.norm());
}

TEST(BilateralContactSolver, DisplacementAndForceAreInverse) {
  BilateralContactSolver grabbed = sphere().solver();
  grabbed.addGrab(sphere().mask(kTop, 8), Vector3d(0.3, 0, -2));
  const VectorXd force = grabbed.forces();
  BilateralContactSolver pushed = sphere().solver();
  pushed.addForce(sphere().mask(kTop, 8), force);
  const auto contact = pushed.contacts(pushed.forces()).front();
  EXPECT_LE((contact.displacement - Vector3d(0.3, 0, -2)).norm(), 1e-10);
  EXPECT_GT(contact.stiffness, 0);
}

/// Force, deflection and stiffness of a contact fit together, and deflections are what the forces
/// do one at a time: the displacements of two contacts through the compliance matrix.
TEST(BilateralContactSolver, DeflectionsAreTheShareOfTheContactsOwnForce) {
  BilateralContactSolver solver = sphere().solver();
  const ContactMask top = sphere().mask(kTop, 8), side = sphere().mask({18, 0, 17}, 8);
  solver.addGrab(top, Vector3d(0.2, 0, -2));
  solver.addGrab(side, Vector3d(-1, 0, -0.5));
  const VectorXd forces = solver.forces();
  const auto contacts = solver.contacts(forces);
  for (int k = 0; k < 2; ++k) {
    BilateralContactSolver alone = sphere().solver();
    alone.addForce(k == 0 ? top : side, forces.segment<3>(3 * k));
    const Vector3d expected = alone.contacts(alone.forces()).front().displacement;
    EXPECT_LE((contacts[k].deflection - expected).norm(), 1e-12);
    EXPECT_NEAR(contacts[k].stiffness * contacts[k].deflection.norm(), contacts[k].force.norm(),
                1e-12);
    const Vector3d fromOther =
        solver.compliance().block<3, 3>(3 * k, 3 * (1 - k)) * forces.segment<3>(3 * (1 - k));
    EXPECT_GT(fromOther.norm(), 0.1);
    EXPECT_LE((contacts[k].displacement - contacts[k].deflection - fromOther).norm(), 1e-12);
  }
}

TEST(BilateralContactSolver, AddingAndRemovingInAnyOrderGivesTheSameForces) {
  const Vector3d places[] = {kTop, kSide, {-25, 0, 0}, {0, 25, 0}, {0, -20, 15}};
  BilateralContactSolver straight = sphere().solver();
  straight.addGrab(sphere().mask(places[1], 7), Vector3d(1, 0, 0));
  straight.addForce(sphere().mask(places[3], 7), Vector3d(0, -0.1, 0));
  straight.addGrab(sphere().mask(places[4], 7), Vector3d(0, 0.5, 0));

  BilateralContactSolver winding = sphere().solver();
  const auto a = winding.addGrab(sphere().mask(places[0], 7), Vector3d(0, 0, -1));
  winding.addGrab(sphere().mask(places[1], 7), Vector3d(1, 0, 0));
  const auto b = winding.addForce(sphere().mask(places[2], 7), Vector3d(0.1, 0, 0));
  winding.addForce(sphere().mask(places[3], 7), Vector3d(0, -0.1, 0));
  winding.remove(a);
  const auto c = winding.addGrab(sphere().mask(places[4], 7), Vector3d(0, 0, 0));
  winding.remove(b);
  winding.setDisplacement(c, Vector3d(0, 0.5, 0));

  const VectorXd expected = straight.forces(), found = winding.forces();
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_LE((found - expected).norm(), 1e-10 * expected.norm());
}

TEST(BilateralContactSolver, RefusesTwoContactsAtOnePlace) {
  BilateralContactSolver solver = sphere().solver();
  solver.addGrab(sphere().mask(kTop, 8), Vector3d(0, 0, -1));
  const VectorXd before = solver.forces();
  EXPECT_THROW(solver.addGrab(sphere().mask(kTop, 8), Vector3d(0, 0, -1)), SolverError);
  EXPECT_EQ(solver.forces(), before);
}

TEST(BilateralContactSolver, AMaskOfOneNodeIsNodalSwitching) {
  const int node = nearestNode(sphere().mesh, kTop);
  const Vector3d displacement(0, 0, -1);
  ContactMask mask;
  mask.point = nearestSurfacePoint(sphere().mesh, sphere().mesh.nodes[node]);
  mask.radius = 0;
  mask.nodes = mask.measureNodes = {node};
  const double area = nodalArea(sphere().mesh, node);
  mask.traction = {1 / area};
  mask.measure = {1};
  BilateralContactSolver solver = sphere().solver();
  solver.addGrab(mask, displacement);

  const auto& dofs = sphere().problem->dofs();
  NodalSwitching switching(sphere().problem, VectorXd::Zero(dofs.nodalCount()),
                           VectorXd::Zero(dofs.count()), sphere().zero());
  switching.add(node);
  const Vector3d force =
      dofs.tractionScale() * area * switching.solve(displacement).switched.head<3>();
  // The only difference is the symmetrisation of the 3 x 3 compliance.
  EXPECT_LE((solver.forces() - force).norm(), 0.01 * force.norm());
}

TEST(BilateralContactSolver, ReciprocityDefectIsSmallAndFalls) {
  double defect[2];
  for (int k = 0; k < 2; ++k) {
    const Sphere body(k == 0 ? 10 : 14);  // 602 and 1,178 nodes
    BilateralContactSolver solver = body.solver();
    solver.addGrab(body.mask(kTop, 9), Vector3d::Zero());
    solver.addGrab(body.mask(kSide, 9), Vector3d::Zero());
    solver.addGrab(body.mask({0, -18, 17}, 9), Vector3d::Zero());
    defect[k] = solver.reciprocityDefect();
  }
  EXPECT_LE(defect[0], 0.01);
  EXPECT_LT(defect[1], defect[0]);
}

TEST(BilateralContactSolver, ForceIsContinuousWhenTheContactSlides) {
  // Slides over three elements in 24 steps: the forces of consecutive steps differ by no more than
  // the change of place explains.
  double previous = 0;
  for (int step = 0; step <= 24; ++step) {
    const double angle = 0.02 * step;
    BilateralContactSolver solver = sphere().solver();
    const Vector3d normal(std::sin(angle), 0, std::cos(angle));
    solver.addGrab(sphere().mask(25 * normal, 10), Vector3d(-normal));
    const double force = solver.forces().norm();
    if (step > 0) {
      EXPECT_NEAR(force, previous, 0.02 * previous) << "at step " << step;
    }
    previous = force;
  }
}

TEST(BilateralContactSolver, ForceHardlyDependsOnTheMesh) {
  const Sphere fine(14);
  BilateralContactSolver coarse = sphere().solver(), finer = fine.solver();
  coarse.addGrab(sphere().mask(kTop, 12), Vector3d(0, 0, -1));
  finer.addGrab(fine.mask(kTop, 12), Vector3d(0, 0, -1));
  // Same mask radius, edges of 3.9 and 2.8 mm: second-order errors of a 12 mm bump.
  EXPECT_NEAR(coarse.forces()[2], finer.forces()[2], 0.02 * std::abs(finer.forces()[2]));
}

}  // namespace
}  // namespace palpa::bem

#include "bem/dense/make_reference_problem.h"

#include <gtest/gtest.h>

#include <numeric>
#include <utility>

#include "app/verification/exact/simple_meshes.h"
#include "bem/contact/contact_simulation.h"
#include "bem/triangle/triangle_contact_surface.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Kind = ContactTool::Kind;

constexpr Material kSoft{0.1, 0.45};

/// A surface that counts the searches of nearest points.
class CountingSurface final : public ContactSurface {
 public:
  CountingSurface(const BoundaryMesh& mesh, const TractionSlots& slots,
                  const DegreesOfFreedom& dofs)
      : ContactSurface(mesh, slots, slots, dofs), inner_(mesh, slots, dofs) {}

  int takeCount() { return std::exchange(count_, 0); }

  SurfacePoint nearest(const Vector3d& x) const override {
    ++count_;
    return inner_.nearest(x);
  }
  const std::vector<Vector3d>& places() const override { return inner_.places(); }
  int coefficientAt(int node) const override { return inner_.coefficientAt(node); }
  SurfacePoint at(int triangle, const Vector3d& weights) const override {
    return inner_.at(triangle, weights);
  }
  SurfacePoint foot(const Vector3d& tool, const SurfacePoint& start) const override {
    return inner_.foot(tool, start);
  }
  Vector3d normal(const SurfacePoint& point) const override { return inner_.normal(point); }
  Vector3d smoothPosition(const SurfacePoint& point) const override {
    return inner_.smoothPosition(point);
  }
  double narrowestMask(const SurfacePoint& point) const override {
    return inner_.narrowestMask(point);
  }
  double maskSpacing(const SurfacePoint& point) const override { return inner_.maskSpacing(point); }
  std::unique_ptr<Workspace> makeWorkspace() const override { return inner_.makeWorkspace(); }
  bool makeMask(const SurfacePoint& point, double radius, Workspace& workspace,
                ContactMask& mask) const override {
    return inner_.makeMask(point, radius, workspace, mask);
  }
  double strainEnergy(const VectorXd& u, const VectorXd& p) const override {
    return inner_.strainEnergy(u, p);
  }

 private:
  TriangleContactSurface inner_;
  mutable int count_ = 0;
};

/// Sphere of radius 25 mm, fixed below z = -20 mm, with all its columns.
struct Body {
  BoundaryMesh mesh = verification::sphereMesh(25, 8);
  std::unique_ptr<TractionSlots> slots;
  std::shared_ptr<const ReferenceProblem> problem;
  BoundaryField base;
  std::unique_ptr<CountingSurface> surface;
  std::unique_ptr<GreensColumns> columns;

  Body() {
    for (int t = 0; t < mesh.triangleCount(); ++t)
      mesh.tags[t] = mesh.point(t, Vector3d::Constant(1.0 / 3))[2] < -20 ? 1 : 0;
    slots = std::make_unique<TractionSlots>(mesh);
    std::vector<SlotCondition> conditions;
    for (const auto& slot : slots->slots)
      conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
    problem = makeDenseReferenceProblem(mesh, *slots, {conditions, kSoft, {}, Precision::kDouble});
    base = {VectorXd::Zero(3 * mesh.nodeCount()), VectorXd::Zero(3 * slots->count())};
    surface = std::make_unique<CountingSurface>(mesh, *slots, problem->dofs());
    columns = std::make_unique<GreensColumns>(problem);
    std::vector<int> all(mesh.nodeCount());
    std::iota(all.begin(), all.end(), 0);
    columns->compute(all, Job{});
  }
};

/// Forces of a ball that presses and slides, and of a push; before most steps the simulation is
/// asked for missing columns, as in a replay (`asksFirst`).
std::vector<Vector3d> slide(const Body& body, bool asksFirst) {
  ContactSimulation simulation(*body.surface, *body.columns, body.base, kSoft);
  const auto ball = simulation.begin({Kind::kBall, 12, 0.3}, {0, 0, 25}, {0, 0, 36});
  const auto push = simulation.begin({Kind::kPush, 8, 0.3}, {25, 0, 0}, {24, 0, 0});
  std::vector<Vector3d> forces;
  for (int k = 0; k < 25; ++k) {
    simulation.set(ball, {0.2 * k, 0.1 * k, 35.5});
    if (asksFirst && k % 4 > 0) {
      EXPECT_TRUE(simulation.missing().empty());
    }
    // Sometimes a value follows the question.
    if (k % 4 > 1) simulation.set(push, {24, 0.1 * k, 0});
    simulation.step();
    for (const auto& contact : simulation.contacts()) forces.push_back(contact.force);
  }
  EXPECT_GT(forces.back().norm(), 0);
  return forces;
}

TEST(ContactPlacement, AStepUsesThePlacesOfTheQuestionForMissingColumns) {
  const Body body;
  EXPECT_EQ(slide(body, false), slide(body, true));  // bit for bit
  body.surface->takeCount();
  ContactSimulation simulation(*body.surface, *body.columns, body.base, kSoft);
  simulation.begin({Kind::kBall, 12, 0.3}, {0, 0, 25}, {0, 0, 36});
  simulation.step();
  body.surface->takeCount();
  ASSERT_TRUE(simulation.missing().empty());
  EXPECT_GT(body.surface->takeCount(), 20);
  simulation.step();
  EXPECT_EQ(body.surface->takeCount(), 0);
  simulation.step();
  EXPECT_GT(body.surface->takeCount(), 20);
}

}  // namespace
}  // namespace palpa::bem

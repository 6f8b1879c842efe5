#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/problem/reference_problem.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using Kind = SolverError::Kind;

struct Refusal {
  Kind kind = Kind::kSingular;
  std::string message = "accepted";
};

Refusal refusal(const BoundaryMesh& mesh, const Material& material,
                const verification::ConditionOfTag& conditionOfTag) {
  const TractionSlots slots(mesh);
  std::vector<SlotCondition> conditions;
  for (const auto& slot : slots.slots) conditions.push_back(conditionOfTag(slot.tag));
  try {
    material.validate();
    const DegreesOfFreedom dofs(mesh, slots, conditions, material);
    checkSolvable(mesh, conditions, dofs, material);
  } catch (const SolverError& error) {
    return {error.kind(), error.what()};
  }
  return {};
}

void expectNotHeld(const Refusal& refusal, std::initializer_list<const char*> freeMotions) {
  EXPECT_EQ(refusal.kind, Kind::kNotFixed);
  for (const char* motion : freeMotions)
    EXPECT_NE(refusal.message.find(motion), std::string::npos)
        << "'" << motion << "' is missing in: " << refusal.message;
  const auto listed = std::count(refusal.message.begin(), refusal.message.end(), ';') + 1;
  EXPECT_EQ(listed, static_cast<long>(freeMotions.size())) << refusal.message;
}

const Material kRubber{0.1, 0.45};

BoundaryMesh box() {
  return verification::boxMesh({-2, -2, 0}, {2, 2, 3}, 4, 4, 3);
}

verification::ConditionOfTag rollersOn(std::initializer_list<int> tags) {
  const std::vector<int> list(tags);
  return [list](int tag) {
    return std::find(list.begin(), list.end(), tag) != list.end() ? SlotCondition::kRoller
                                                                  : SlotCondition::kTraction;
  };
}

TEST(Solvability, NamesAllMotionsOfABodyWithoutSupports) {
  expectNotHeld(refusal(box(), kRubber, rollersOn({})), {"all translations", "all rotations"});
}

TEST(Solvability, NamesTheMotionsThatOneRollerPlaneLeaves) {
  expectNotHeld(refusal(box(), kRubber, rollersOn({4})),
                {"translation along x", "translation along y", "rotation about the axis along z"});
}

TEST(Solvability, NamesTheMotionThatTwoRollerPlanesLeave) {
  expectNotHeld(refusal(box(), kRubber, rollersOn({0, 4})), {"translation along y"});
}

TEST(Solvability, ThreeRollerPlanesSuffice) {
  EXPECT_EQ(refusal(box(), kRubber, rollersOn({0, 2, 4})).message, "accepted");
}

TEST(Solvability, NamesTheMotionsOfACylinderInASleeve) {
  expectNotHeld(refusal(verification::cylinderMesh(5, 12, 24, 8), kRubber, rollersOn({0})),
                {"translation along z", "rotation about the axis along z through (0, 0, "});
}

TEST(Solvability, NamesARotationAboutAnAxisThatIsNotAtTheOrigin) {
  BoundaryMesh mesh = verification::cylinderMesh(5, 12, 24, 8);
  for (Vector3d& node : mesh.nodes) node += Vector3d(30, -7, 0);
  expectNotHeld(refusal(mesh, kRubber, rollersOn({0, 1})),
                {"rotation about the axis along z through (30, -7, "});
}

TEST(Solvability, NamesTheRotationsOfABallInASocket) {
  // The mesh normals are not quite radial, so the frictionless socket seems to resist slightly.
  for (const int n : {4, 8})
    expectNotHeld(refusal(verification::sphereMesh(5, n), kRubber, rollersOn({0})),
                  {"rotation about the axis along x", "rotation about the axis along y",
                   "rotation about the axis along z"});
}

TEST(Solvability, ASmallFixedPlaceSuffices) {
  BoundaryMesh mesh = verification::sphereMesh(5, 12);
  for (int t = 0; t < mesh.triangleCount(); ++t)
    mesh.tags[t] = mesh.point(t, Vector3d::Constant(1.0 / 3))[2] < -4.8 ? 1 : 0;
  EXPECT_EQ(
      refusal(mesh, kRubber,
              [](int tag) { return tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction; })
          .message,
      "accepted");
}

TEST(Solvability, ANearlyIncompressibleBodyWithACavityIsRefused) {
  BoundaryMesh mesh = verification::hollowSphereMesh(2, 5, 4, 8);
  for (int t = 0; t < mesh.triangleCount(); ++t)
    mesh.tags[t] = mesh.point(t, Vector3d::Constant(1.0 / 3))[2] < -4 ? 1 : 0;
  const auto fixedPart = [](int tag) {
    return tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction;
  };
  const Refusal refused = refusal(mesh, {0.1, 0.49}, fixedPart);
  EXPECT_EQ(refused.kind, Kind::kIncompressible);
  EXPECT_NE(refused.message.find("cavity"), std::string::npos);
  EXPECT_EQ(refusal(mesh, kRubber, fixedPart).message, "accepted");
}

TEST(Solvability, OneFixedFaceSuffices) {
  const auto fixedBase = [](int tag) {
    return tag == 4 ? SlotCondition::kFixed : SlotCondition::kTraction;
  };
  EXPECT_EQ(refusal(box(), kRubber, fixedBase).message, "accepted");
  EXPECT_EQ(refusal(box(), {0.1, 0.5}, fixedBase).message, "accepted");
}

TEST(Solvability, AnIncompressibleBodyNeedsAFreePlace) {
  const auto fixed = [](int) { return SlotCondition::kFixed; };
  const auto fixedOrRoller = [](int tag) {
    return tag == 5 ? SlotCondition::kRoller : SlotCondition::kFixed;
  };
  const Refusal refused = refusal(box(), {0.1, 0.5}, fixed);
  EXPECT_EQ(refused.kind, Kind::kIncompressible);
  EXPECT_NE(refused.message.find("pressure inside is undetermined"), std::string::npos);
  EXPECT_EQ(refusal(box(), {0.1, 0.5}, fixedOrRoller).kind, Kind::kIncompressible);
  EXPECT_EQ(refusal(box(), {0.1, 0.49}, fixed).message, "accepted");
}

TEST(Solvability, TheProblemRefusesToo) {
  const BoundaryMesh mesh = box();
  const TractionSlots slots(mesh);
  const std::vector<SlotCondition> free(slots.slots.size(), SlotCondition::kTraction);
  EXPECT_THROW(makeDenseReferenceProblem(mesh, slots, {free, kRubber, {}, Precision::kDouble}),
               SolverError);
}

TEST(MaterialRange, RefusesConstantsOutsideLinearElasticity) {
  const auto fixed = [](int) { return SlotCondition::kFixed; };
  for (const Material& bad :
       {Material{0, 0.3}, Material{-1, 0.3}, Material{NAN, 0.3}, Material{INFINITY, 0.3}}) {
    const Refusal refused = refusal(box(), bad, fixed);
    EXPECT_EQ(refused.kind, Kind::kBadMaterial);
    EXPECT_NE(refused.message.find("Young's modulus"), std::string::npos) << refused.message;
  }
  for (const Material& bad : {Material{1, -1}, Material{1, 0.51}, Material{1, NAN}}) {
    const Refusal refused = refusal(box(), bad, fixed);
    EXPECT_EQ(refused.kind, Kind::kBadMaterial);
    EXPECT_NE(refused.message.find("Poisson's ratio"), std::string::npos) << refused.message;
  }
}

}  // namespace
}  // namespace palpa::bem

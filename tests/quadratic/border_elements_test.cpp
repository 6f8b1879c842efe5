// Elements with square roots beside the borders of supports.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <random>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "base/support_border.h"
#include "bem/contact/contact_surface.h"
#include "bem/quadratic/border_coordinates.h"
#include "bem/quadratic/quadratic_assembly.h"
#include "quadratic_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using verification::retagged;
using verification::sphereMesh;

std::vector<BorderCoordinates> allKinds() {
  std::vector<BorderCoordinates> kinds;
  for (int k = 0; k < 3; ++k) {
    kinds.push_back(BorderCoordinates::edge(k));
    kinds.push_back(BorderCoordinates::vertex(k));
  }
  return kinds;
}

TEST(BorderCoordinates, HaveAnInverseAndTheRightDerivatives) {
  constexpr double kStep = 1e-6;
  for (const BorderCoordinates& on : allKinds())
    for (const Vector2d& at : {Vector2d(0.2, 0.3), Vector2d(0.6, 0.1), Vector2d(0.15, 0.7)}) {
      EXPECT_LE((on.local(on.geometric(at)) - at).norm(), 1e-14);
      const Eigen::Matrix2d slope = on.derivative(at);
      for (int k = 0; k < 2; ++k) {
        const Vector2d by = kStep * Vector2d::Unit(k);
        const Vector2d change = (on.geometric(at + by) - on.geometric(at - by)) / (2 * kStep);
        EXPECT_LE((change - slope.col(k)).norm(), 1e-9);
      }
    }
}

TEST(BorderCoordinates, AreTheSameForManyPointsAtOnce) {
  const Eigen::ArrayXd u = Eigen::Array3d(0.2, 0.6, 0.15), v = Eigen::Array3d(0.3, 0.1, 0.7);
  std::vector<BorderCoordinates> kinds = allKinds();
  kinds.emplace_back();
  for (const BorderCoordinates& on : kinds) {
    BorderCoordinates::Mapped mapped;
    on.map(u, v, mapped);
    for (int k = 0; k < u.size(); ++k) {
      const Vector2d at(u[k], v[k]);
      EXPECT_LE((on.geometric(at) - Vector2d(mapped.u[k], mapped.v[k])).norm(), 1e-15);
      EXPECT_NEAR(on.derivative(at).determinant(), mapped.determinant[k], 1e-15);
      EXPECT_NEAR(on.root(at), mapped.root[k], 1e-16);
    }
  }
}

TEST(BorderCoordinates, AgreeOnCommonEdges) {
  // On the edge from border vertex 0 to vertex 1: the square in every element.
  for (const double t : {0.1, 0.5, 0.9})
    for (const auto& on : {BorderCoordinates::edge(1), BorderCoordinates::vertex(0)})
      EXPECT_LE((on.geometric({t, 0}) - Vector2d(t * t, 0)).norm(), 1e-15);
  // On the border itself and opposite to a border vertex: equal.
  EXPECT_LE((BorderCoordinates::edge(2).geometric({0.3, 0}) - Vector2d(0.3, 0)).norm(), 1e-15);
  EXPECT_LE((BorderCoordinates::vertex(0).geometric({0.3, 0.7}) - Vector2d(0.3, 0.7)).norm(),
            1e-15);
}

TEST(BorderCoordinates, PointsAwayFromTheBorderHaveTheRoot) {
  for (const BorderCoordinates& on : allKinds())
    for (const Vector2d& at :
         {Vector2d(0, 0), Vector2d(1, 0), Vector2d(0, 1), Vector2d(0.5, 0.5)}) {
      const Vector2d away = on.awayFromBorder(at, 0.2);
      EXPECT_NEAR(on.root(away), std::max(0.2, on.root(at)), 1e-14);
      EXPECT_GE(away.minCoeff(), -1e-14);
      EXPECT_LE(away.sum(), 1 + 1e-14);
    }
}

/// Triangles of a grid of unit squares, two each.
std::vector<std::array<int, 3>> grid(int columns, int rows) {
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i, b = a + 1, c = b + columns + 1, d = c - 1;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  return triangles;
}

TEST(SupportBorder, NoTriangleHasTwoBorderVerticesWithoutABorderEdge) {
  std::mt19937 random(3);
  const auto triangles = grid(12, 10);
  int found = 0;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<bool> isSupported(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
      // Strips and single triangles.
      isSupported[t] = trial % 2 == 0 ? random() % 3 == 0 : (t / 6) % 4 == random() % 2;
    const auto isOn = supportBorderVertices(triangles, isSupported, 13 * 11, {});
    const auto isBorder = supportBorderEdges(triangles, isSupported);
    found += static_cast<int>(std::count(isOn.begin(), isOn.end(), true));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      std::vector<int> on;
      for (int k = 0; k < 3; ++k)
        if (isOn[triangles[t][k]]) on.push_back(k);
      ASSERT_LE(on.size(), 2U);
      if (on.size() == 2) {
        const int edge = on[1] - on[0] == 1 ? on[0] : 2;
        EXPECT_TRUE(isBorder[t][edge]);
      }
    }
  }
  EXPECT_GT(found, 0);
}

TEST(SupportBorder, AStraightBorderKeepsAllItsVertices) {
  const auto triangles = grid(8, 6);
  std::vector<bool> isSupported(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) isSupported[t] = t < 2 * 8 * 3;
  const auto isOn = supportBorderVertices(triangles, isSupported, 9 * 7, {});
  for (int v = 0; v < 9 * 7; ++v) EXPECT_EQ(isOn[v], v / 9 == 3) << v;
}

/// A prism with the section of an L: the edge at (1, 1) is the only notch. Two triangles per side,
/// each side a smoothing group; the sides at the notch come first.
struct Step {
  std::vector<Vector3d> positions;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> groups;
};

Step step() {
  Step body;
  const std::vector<Vector2d> section{{2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 0}, {2, 0}};
  for (const double z : {0.0, 1.0})
    for (const Vector2d& p : section) body.positions.emplace_back(p.x(), p.y(), z);
  const auto add = [&](int group, std::array<int, 3> corners) {
    body.triangles.push_back(corners);
    body.groups.push_back(group);
  };
  for (int k = 0; k < 6; ++k) {
    const int next = (k + 1) % 6;
    add(k, {k, next, next + 6});
    add(k, {k, next + 6, k + 6});
  }
  for (const auto& [a, b, c] : {std::array{1, 2, 3}, {1, 3, 4}, {1, 4, 5}, {1, 5, 0}}) {
    add(6, {a, c, b});
    add(7, {a + 6, b + 6, c + 6});
  }
  return body;
}

TEST(SupportBorder, NotchesAreEdgesWithMoreThanHalfATurnOfMaterial) {
  Step body = step();
  const std::vector<bool> free(body.triangles.size(), false);
  const auto ends = [&](const std::vector<bool>& isSupported) {
    std::vector<std::array<int, 2>> found;
    const auto isNotch = notchEdges(body.triangles, body.positions, body.groups, isSupported);
    for (std::size_t t = 0; t < isNotch.size(); ++t)
      for (int k = 0; k < 3; ++k)
        if (isNotch[t][k]) found.push_back({body.triangles[t][k], body.triangles[t][(k + 1) % 3]});
    return found;
  };
  using Ends = std::vector<std::array<int, 2>>;
  EXPECT_EQ(ends(free), (Ends{{1, 7}, {7, 1}}));
  std::vector<bool> held = free;
  held[0] = held[1] = true;  // a side of the notch
  EXPECT_EQ(ends(held), Ends{});
  // 40° and 20° above half a turn.
  const auto turn = [&](double degrees) {
    const double x = 1 + 1 / std::tan(degrees * std::numbers::pi / 180);
    body.positions[2] = {x, 2, 0};
    body.positions[8] = {x, 2, 1};
    body.positions[3] = {-4, 2, 0};
    body.positions[9] = {-4, 2, 1};
  };
  turn(140);
  EXPECT_EQ(ends(free), (Ends{{1, 7}, {7, 1}}));
  turn(160);
  EXPECT_EQ(ends(free), Ends{});
  body = step();
  body.groups[2] = body.groups[3] = body.groups[0];  // smooth
  EXPECT_EQ(ends(free), Ends{});
}

TEST(SupportBorder, VerticesOfNotchesHaveRoots) {
  const auto triangles = grid(8, 6);
  const std::vector<bool> free(triangles.size(), false);
  std::vector<std::array<bool, 3>> isNotch(triangles.size(), {false, false, false});
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      isNotch[t][k] = triangles[t][k] / 9 == 3 && triangles[t][(k + 1) % 3] / 9 == 3;
  const auto isOn = supportBorderVertices(triangles, free, 9 * 7, isNotch);
  for (int v = 0; v < 9 * 7; ++v) EXPECT_EQ(isOn[v], v / 9 == 3) << v;
}

/// Sphere of radius 25 mm held below a height: the border of the cap follows the mesh's edges.
BoundaryMesh heldSphere(int n, double height) {
  return retagged(sphereMesh(25, n), 1, [&](const Vector3d& x) { return x.z() < height; });
}

std::vector<SlotCondition> fixedInSupport(const QuadraticDiscretisation& on) {
  std::vector<SlotCondition> conditions;
  for (const auto& slot : on.slots().slots)
    conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
  return conditions;
}

TEST(BorderElements, HaveTheirNodesOnTheSurface) {
  const auto sphere = quadratic(heldSphere(5, -15), onSphere(25), {1});
  const QuadraticSurface& surface = sphere->surface();
  int beside = 0;
  double area = 0;
  for (int e = 0; e < surface.elementCount(); ++e) {
    beside += !surface.coordinates(e).isPlain();
    surface.visitPoints(e, 1, [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
      area += weight;
      EXPECT_NEAR(jet.position.norm(), 25, 0.03);
      const ElementFoot foot = surface.nearestOnElement(e, jet.position);
      EXPECT_LE(foot.distance, 1e-9);
      EXPECT_NEAR(foot.place.u, place.u, 1e-6);
      EXPECT_NEAR(foot.place.v, place.v, 1e-6);
    });
    for (const int node : surface.coefficients(e)) {
      const Vector3d at = surface.evaluate(surface.placeOf(node, e)).position;
      EXPECT_LE((at - surface.nodes()[node]).norm(), 1e-12);
    }
  }
  EXPECT_GT(beside, 30);
  EXPECT_NEAR(area, 4 * std::numbers::pi * 625, 2e-3 * area);
}

TEST(BorderElements, AreFoundByContacts) {
  const auto sphere = quadratic(heldSphere(6, -15), onSphere(25), {1});
  const DegreesOfFreedom dofs =
      sphere->degreesOfFreedom(fixedInSupport(*sphere), Material{0.1, 0.3});
  const auto surface = sphere->makeContactSurface(dofs);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi), height(-18, -12);
  for (int trial = 0; trial < 200; ++trial) {
    const double angle = turn(random), z = height(random), r = std::sqrt(625 - z * z);
    const Vector3d on(r * std::cos(angle), r * std::sin(angle), z);
    const SurfacePoint found = surface->nearest(1.04 * on);
    EXPECT_NEAR(found.distance, 1, 0.03);
    EXPECT_LE((found.position - on).norm(), 0.05);
    EXPECT_GE(surface->normal(found).dot(on.normalized()), 0.99);
  }
}

TEST(BorderElements, IntegrateWithTheTolerance) {
  const auto sphere = quadratic(heldSphere(4, -15), onSphere(25), {1});
  const QuadraticSurface& surface = sphere->surface();
  std::vector<SlotCondition> conditions;
  for (const auto& slot : sphere->slots().slots)
    conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
  const WeightedEquations equations = quadraticEquations(
      surface, sphere->mesh(), sphere->slots(), sphere->degreesOfFreedom(conditions, {0.1, 0.3}));
  for (const double tolerance : {1e-4, 1e-6}) {
    const QuadraticQuadrature rough(surface, tolerance), fine(surface, 1e-3 * tolerance);
    const auto workRough = rough.makeWorkspace(), workFine = fine.makeWorkspace();
    double worst = 0;
    for (std::size_t p = 0; p < equations.points.size(); p += 3) {
      const CollocationPlace& point = equations.points[p];
      for (int e = 0; e < surface.elementCount(); e += 2) {
        if (surface.coordinates(e).isPlain()) continue;
        const ElementPlace* inside = placeIn(point, e);
        rough.integrate(e, point.position, inside, *workRough);
        fine.integrate(e, point.position, inside, *workFine);
        double difference = 0, size = 0;
        for (int f = 0; f < 6; ++f)
          for (int k = 0; k < kKernelSumsU; ++k) {
            difference =
                std::max(difference, std::abs(workRough->sums[f].of[k] - workFine->sums[f].of[k]));
            size = std::max(size, std::abs(workFine->sums[f].of[k]));
          }
        worst = std::max(worst, difference / size);
      }
    }
    EXPECT_LE(worst, 5 * tolerance);
  }
}

// Quartering towards a place on the border, where elements are infinitely thin, had no end.
TEST(BorderElements, DisplacementsOnTheBorderArePrescribedOnes) {
  const auto sphere = quadratic(heldSphere(4, -15), onSphere(25), {1});
  const VectorXd u = VectorXd::Random(3 * sphere->displacementCount());
  const VectorXd p = VectorXd::Random(3 * sphere->slots().count());
  const BoundaryMesh& mesh = sphere->mesh();
  int found = 0;
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    const auto& coordinates = sphere->surface().coordinates(t / 4);
    for (int k = 0; k < 3; ++k) {
      const Vector3d weights = Vector3d::Unit(k);
      const ElementPlace place = QuadraticSurface::place(t, weights);
      if (coordinates.root({place.u, place.v}) > 0) continue;
      const SurfacePoint at{t, weights, mesh.point(t, weights), 0};
      EXPECT_EQ(sphere->displacementAt(at, u, p, Material{0.1, 0.3}), sphere->interpolate(at, u));
      ++found;
    }
  }
  EXPECT_GT(found, 50);
}

/// The reference case c_sph_equator: sphere held below z = -20, pressed by a bump at its side.
class HeldSphere : public testing::Test {
 protected:
  static constexpr double kRadius = 25, kHeight = -20;
  static inline const Material kMaterial{0.1, 0.45};

  HeldSphere() {
    nlohmann::json all;
    std::ifstream(PALPA_REFERENCE_DATA "/fem.json") >> all;
    for (const auto& entry : all.at("cases"))
      if (entry.at("id") == "c_sph_equator") case_ = entry;
  }

  /// Rings of nodes at equal distances, one of them on the border of the support.
  static BoundaryMesh rings(double size) {
    const double border = std::acos(kHeight / kRadius);
    std::vector<double> angles;
    const auto add = [&](double from, double to) {
      const int count = static_cast<int>(std::ceil((to - from) * kRadius / size));
      for (int k = 0; k < count; ++k) angles.push_back(from + (to - from) * k / count);
    };
    add(0, border);
    const std::size_t first = angles.size();
    add(border, std::numbers::pi);
    BoundaryMesh mesh;
    std::vector<std::vector<int>> ring{{0}};
    mesh.nodes.push_back({0, 0, kRadius});
    for (std::size_t i = 1; i < angles.size(); ++i) {
      const double radius = kRadius * std::sin(angles[i]);
      const int count =
          std::max(6, static_cast<int>(std::lround(2 * std::numbers::pi * radius / size)));
      std::vector<int>& nodes = ring.emplace_back();
      for (int k = 0; k < count; ++k) {
        const double turn = 2 * std::numbers::pi * (k + 0.5 * static_cast<double>(i % 2)) / count;
        nodes.push_back(mesh.nodeCount());
        mesh.nodes.emplace_back(radius * std::cos(turn), radius * std::sin(turn),
                                kRadius * std::cos(angles[i]));
      }
    }
    ring.push_back({mesh.nodeCount()});
    mesh.nodes.push_back({0, 0, -kRadius});
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      const auto addTriangle = [&](int a, int b, int c) {
        mesh.triangles.push_back({a, b, c});
        mesh.tags.push_back(i >= first ? 1 : 0);
        mesh.smoothingGroups.push_back(0);
      };
      zip(ring[i], 0.5 * static_cast<double>(i % 2), ring[i + 1],
          0.5 * static_cast<double>((i + 1) % 2), addTriangle);
    }
    return mesh;
  }

  /// Triangles between two rings with their first nodes turned by shares of a step.
  template <class Add>
  static void zip(const std::vector<int>& a, double shiftA, const std::vector<int>& b,
                  double shiftB, const Add& add) {
    const auto countA = static_cast<int>(a.size()), countB = static_cast<int>(b.size());
    int i = countA == 1 ? 1 : 0, j = countB == 1 ? 1 : 0;
    while (i < countA || j < countB) {
      const bool isA =
          j >= countB || (i < countA && (i + 1 + shiftA) / countA < (j + 1 + shiftB) / countB);
      if (isA) {
        add(a[i % countA], b[j % countB], a[(i + 1) % countA]);
        ++i;
      } else {
        add(a[i % countA], b[j % countB], b[(j + 1) % countB]);
        ++j;
      }
    }
  }

  struct Error {
    int nodes;
    double displacement;  ///< over the largest displacement
    double energy, reaction;
  };

  Error errorWith(double size, const std::vector<int>& supportTags) const {
    const PlaceMiddle middle = [](const Vector3d& a, const Vector3d& b, double share) {
      Vector3d x = onSphere(kRadius)(a, b, share);
      if (std::abs(a.z() - kHeight) < 1e-9 && std::abs(b.z() - kHeight) < 1e-9) {
        x.z() = kHeight;
        x.head<2>() *= std::sqrt(kRadius * kRadius - kHeight * kHeight) / x.head<2>().norm();
      }
      return x;
    };
    const auto on = quadratic(rings(size), middle, supportTags);
    const std::vector<SlotCondition> conditions = fixedInSupport(*on);
    const auto problem =
        makeDenseReferenceProblem(*on, {conditions, kMaterial, {1e-6}, Precision::kDouble});
    BoundaryConditions data(on->displacementCount(), on->slots().count());
    data.ofSlot = conditions;
    std::vector<int> all(static_cast<std::size_t>(on->elementCount()));
    std::iota(all.begin(), all.end(), 0);
    data.traction = on->integrals().projectTraction(
        all,
        [](const Vector3d& x, const Vector3d&) {
          const double t = (x - Vector3d(25, 0, 0)).squaredNorm() / 64;
          return t < 1 ? Vector3d(-0.002 * (1 - t) * (1 - t), 0, 0) : Vector3d(0, 0, 0);
        },
        8);
    const BoundaryField field = problem->solveField(problem->dofs().knownField(data),
                                                    ReferenceProblem::Effort::kRefined, {});
    const VectorXd u = field.u.col(0), p = field.p.col(0);
    Error error{on->displacementCount(), 0, 0, 0};
    const auto surface = on->makeContactSurface(problem->dofs());
    double largest = 0;
    for (const auto& point : case_.at("points")) {
      const auto vectorOf = [&](const char* key) {
        return Vector3d(point.at(key)[0], point.at(key)[1], point.at(key)[2]);
      };
      const Vector3d x = vectorOf("x"), expected = vectorOf("u");
      if (std::abs(x.norm() - kRadius) > 1e-6) continue;
      largest = std::max(largest, expected.norm());
      const Vector3d found = on->displacementAt(surface->nearest(x), u, p, kMaterial);
      error.displacement = std::max(error.displacement, (found - expected).norm());
    }
    error.displacement /= largest;
    error.energy = on->strainEnergy(u, p) / case_.at("energy_mJ").get<double>() - 1;
    std::vector<int> support;
    for (const int e : all)
      if (on->mesh().tags[4 * static_cast<std::size_t>(e)] == 1) support.push_back(e);
    const Vector3d reaction(case_.at("reaction_force")[0], case_.at("reaction_force")[1],
                            case_.at("reaction_force")[2]);
    error.reaction = (on->resultant(p, support).force - reaction).norm() / reaction.norm();
    return error;
  }

  nlohmann::json case_;
};

TEST_F(HeldSphere, IsAccurateWithoutGrading) {
  ASSERT_FALSE(case_.is_null());
  const Error plain = errorWith(7.5, {}), coarse = errorWith(7.5, {1}), fine = errorWith(5.5, {1});
  RecordProperty("nodes", fine.nodes);
  EXPECT_LE(fine.nodes, 1500);
  EXPECT_LE(coarse.displacement, 0.01);
  EXPECT_LE(fine.displacement, 0.004);
  EXPECT_LE(std::abs(coarse.energy), 0.01);
  EXPECT_LE(std::abs(fine.energy), 0.004);
  EXPECT_LE(fine.reaction, 0.002);
  // The plain elements are another world.
  EXPECT_GE(plain.displacement, 5 * coarse.displacement);
}

TEST(BorderElements, AnUpdateEqualsARebuild) {
  const Material material{0.1, 0.45};
  const auto before = quadratic(heldSphere(4, -15), onSphere(25), {1});
  BoundaryMesh bulged = before->mesh();
  for (Vector3d& x : bulged.nodes)
    if (x.z() > 15) x.z() += 0.1 * (x.z() - 15);
  const QuadraticDiscretisation after(bulged, {1});
  const std::vector<SlotCondition> conditions = fixedInSupport(*before);
  const ProblemInputs inputs{conditions, material, {1e-6}, Precision::kDouble};
  EXPECT_LE(updateError(*before, after, inputs), 1e-5);
}

/// A uniform displacement of the support works on the resultant alone.
TEST(BorderElements, WorkOfASupportIsItsForceTimesItsDisplacement) {
  const auto on = quadratic(heldSphere(4, -15), onSphere(25), {1});
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  VectorXd p = VectorXd::Zero(3 * static_cast<Eigen::Index>(on->slots().count()));
  for (int s = 0; s < on->slots().count(); ++s)
    if (on->slots().slots[s].tag == 1)
      p.segment<3>(3 * s) = Vector3d(normal(random), normal(random), normal(random));
  const Vector3d motion(0.3, 0.1, -0.2);
  VectorXd u(3 * on->displacementCount());
  for (int k = 0; k < on->displacementCount(); ++k) u.segment<3>(3 * k) = motion;
  std::vector<int> all(static_cast<std::size_t>(on->elementCount()));
  std::iota(all.begin(), all.end(), 0);
  const double work = motion.dot(on->resultant(p, all).force) / 2;
  EXPECT_NEAR(on->strainEnergy(u, p), work, 1e-10 * std::abs(work));
}

/// A linear field needs no unbounded tractions, and the elements contain it as well as others do.
TEST(BorderElements, RigidMotionsOfTheSupportNeedNoTractions) {
  const Material material{0.1, 0.3};
  const auto on = quadratic(heldSphere(4, -15), onSphere(25), {1});
  const std::vector<SlotCondition> conditions = fixedInSupport(*on);
  const auto problem =
      makeDenseReferenceProblem(*on, {conditions, material, {1e-6}, Precision::kDouble});
  BoundaryConditions data(on->displacementCount(), on->slots().count());
  data.ofSlot = conditions;
  const Vector3d motion(0.1, -0.2, 0.3);
  for (int k = 0; k < on->displacementCount(); ++k) data.displacement.segment<3>(3 * k) = motion;
  const BoundaryField field =
      problem->solveField(problem->dofs().knownField(data), ReferenceProblem::Effort::kRefined, {});
  for (int k = 0; k < on->displacementCount(); ++k)
    EXPECT_LE((field.u.col(0).segment<3>(3 * k) - motion).norm(), 1e-8);
  EXPECT_LE(field.p.lpNorm<Eigen::Infinity>(), 1e-8);
}

}  // namespace
}  // namespace palpa::bem::test

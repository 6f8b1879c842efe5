#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "adaptive_integral.h"
#include "bem/triangle/assembly.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using test::Corners;
using test::ElementBlocks;

/// The element's entries of H and G computed by `assemble` for one collocation point. Zero weights
/// omit the free term.
ElementBlocks assembledBlocks(const Corners& corners, const Vector3d& x, const Material& material,
                              double tolerance) {
  BoundaryMesh mesh;
  mesh.nodes.assign(corners.begin(), corners.end());
  mesh.triangles = {{0, 1, 2}};
  mesh.smoothingGroups = mesh.tags = {0};
  Job job;
  job.threads = 1;
  const auto operators = assemble<double>(mesh, TractionSlots(mesh), {{x, 0, Vector3d::Zero()}},
                                          material, {tolerance}, job);
  ElementBlocks blocks;
  for (int a = 0; a < 3; ++a) {
    blocks.U[a] = operators.G.view().middleCols<3>(3 * a);
    blocks.T[a] = operators.H.view().middleCols<3>(3 * a);
  }
  return blocks;
}

/// Largest difference of a block relative to the block's norm; zero blocks of T (coplanar at nu =
/// 0.5) must be zero.
double blockError(const ElementBlocks& found, const ElementBlocks& exact) {
  double worst = 0;
  for (int a = 0; a < 3; ++a) {
    worst = std::max(worst, (found.U[a] - exact.U[a]).norm() / exact.U[a].norm());
    worst = std::max(worst, (found.T[a] - exact.T[a]).norm() / std::max(exact.T[a].norm(), 1e-10));
  }
  return worst;
}

Vector3d normalOf(const Corners& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]).normalized();
}
Vector3d centroidOf(const Corners& c) {
  return (c[0] + c[1] + c[2]) / 3;
}
double radiusOf(const Corners& c) {
  double radius = 0;
  for (const auto& corner : c) radius = std::max(radius, (corner - centroidOf(c)).norm());
  return radius;
}

struct Sampler {
  std::mt19937 random{20240917};
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  Vector3d direction() {
    std::normal_distribution<double> normal;
    return Vector3d(normal(random), normal(random), normal(random)).normalized();
  }
  /// Random triangle with longest edge 2 mm, position and orientation; every second one a sliver of
  /// up to 30:1.
  Corners triangle(int sample) {
    const double aspect = sample % 2 == 0 ? uniform(1, 2) : std::pow(30, uniform(0, 1));
    const Vector3d along = 2 * direction();
    const Vector3d across = along.cross(direction()).normalized() * 2 / aspect;
    const Vector3d origin = 10 * direction();
    return {origin, origin + along, origin + uniform(-0.1, 1.1) * along + across};
  }
  Material material(int sample) {
    return {1.0, sample % 3 == 0 ? 0.5 : sample % 3 == 1 ? 0.3 : uniform(-0.95, 0.5)};
  }
  /// Random direction: arbitrary, coplanar, nearly coplanar, or through a corner.
  Vector3d directionFrom(const Corners& c, int sample) {
    const Vector3d any = direction(), normal = normalOf(c);
    const Vector3d inPlane = (any - any.dot(normal) * normal).normalized();
    switch (sample % 5) {
      case 0:
        return inPlane;
      case 1:
        return (inPlane + 1e-3 * normal).normalized();
      case 2:
        return (c[sample % 3] - centroidOf(c)).normalized();
      default:
        return any;
    }
  }
};

class IntegrationTolerance : public ::testing::TestWithParam<double> {};

TEST_P(IntegrationTolerance, HoldsForEveryBlockFromNearToFar) {
  const double tolerance = GetParam();
  Sampler sampler;
  constexpr int kSamples = 12000;
  double worst = 0;
  for (int sample = 0; sample < kSamples; ++sample) {
    const Corners c = sampler.triangle(sample);
    // In the plane T vanishes at nu = 0.5, so its relative error is undefined.
    const bool coplanar = sample % 5 == 0 || sample % 5 == 2;
    const Material material = coplanar ? Material{1.0, 0.3} : sampler.material(sample);
    // 1.2 to 60 radii: outside the triangle, and beyond the last change of rule.
    const double ratio = 1.2 * std::pow(50, sampler.uniform(0, 1));
    const Vector3d x = centroidOf(c) + ratio * radiusOf(c) * sampler.directionFrom(c, sample);
    const double error = blockError(assembledBlocks(c, x, material, tolerance),
                                    test::integrateAdaptively(c, x, material));
    worst = std::max(worst, error);
    EXPECT_LE(error, tolerance) << "at " << ratio << " radii, nu = " << material.poissonRatio;
  }
  RecordProperty("worst", std::to_string(worst));
  std::printf("tolerance %.0e: worst block of %d samples %.1e\n", tolerance, kSamples, worst);
}
INSTANTIATE_TEST_SUITE_P(Tolerances, IntegrationTolerance,
                         ::testing::Values(1e-3, 1e-5, 1e-7, 1e-9));

/// Rounding error of the closed form near a triangle of up to 30:1, measured 1e-12 (blocks of T
/// close to the border of a sliver).
constexpr double kClosedForm = 1e-11;

TEST(ClosedForm, HoldsDownToAThousandthOfTheElement) {
  Sampler sampler;
  double worst = 0;
  for (int sample = 0; sample < 1500; ++sample) {
    const Corners c = sampler.triangle(sample);
    const bool coplanar = sample / 3 % 5 >= 3;
    // In the plane T vanishes at nu = 0.5, so its relative error is undefined.
    const Material material = coplanar ? Material{1.0, 0.3} : sampler.material(sample);
    const double height = 2e-3 * std::pow(1000, sampler.uniform(0, 1));
    const Vector3d normal = normalOf(c);
    const double s = sampler.uniform(0, 1), t = sampler.uniform(0, 1);
    const Vector3d onEdge = c[sample % 3] + s * (c[(sample + 1) % 3] - c[sample % 3]);
    Vector3d x;
    switch (sample / 3 % 5) {
      case 0:  // above a corner
        x = c[sample % 3] + height * normal;
        break;
      case 1:  // above an edge
        x = onEdge - height * normal;
        break;
      case 2:  // above the inside
        x = c[0] + s * (c[1] - c[0]) + (1 - s) * t * (c[2] - c[0]) + height * normal;
        break;
      case 3:  // in the plane, beyond an edge
        x = onEdge + height * (c[(sample + 1) % 3] - c[sample % 3]).cross(normal).normalized();
        break;
      default:  // on the extension of an edge
        x = c[sample % 3] + height * (c[sample % 3] - c[(sample + 1) % 3]).normalized();
    }
    const double error = blockError(assembledBlocks(c, x, material, 1e-7),
                                    test::integrateAdaptively(c, x, material));
    worst = std::max(worst, error);
    EXPECT_LE(error, kClosedForm) << "sample " << sample << ", height " << height
                                  << ", nu = " << material.poissonRatio;
  }
  std::printf("closed form, 1e-3 to 1 element sizes away: worst block %.1e\n", worst);
}

TEST(ClosedForm, IsThePrincipalValueInsideTheElement) {
  Sampler sampler;
  double worst = 0;
  for (int sample = 0; sample < 300; ++sample) {
    const Corners c = sampler.triangle(sample);
    const Material material{1.0, sampler.uniform(-0.9, 0.45)};
    const double s = sampler.uniform(0.05, 0.9), t = sampler.uniform(0.05, 0.95);
    const Vector3d x = c[0] + s * (c[1] - c[0]) + (1 - s) * t * (c[2] - c[0]);
    const double error =
        blockError(assembledBlocks(c, x, material, 1e-7), test::integrateInPlace(c, x, material));
    worst = std::max(worst, error);
    // Close to x the N - N(x) of the reference is a difference of rounded numbers.
    EXPECT_LE(error, 1e-8) << "sample " << sample;
  }
  std::printf("principal value inside the element: worst block %.1e\n", worst);
}

TEST(ClosedForm, HoldsAtTheCorners) {
  Sampler sampler;
  for (int sample = 0; sample < 300; ++sample) {
    const Corners c = sampler.triangle(sample);
    const Material material = sampler.material(sample);
    const int corner = sample % 3;
    const ElementBlocks found = assembledBlocks(c, c[corner], material, 1e-7);
    const ElementBlocks exact = test::integrateAdaptively(c, c[corner], material);
    for (int a = 0; a < 3; ++a) {
      // The reference omits a core of 1e-12 of the triangle.
      EXPECT_LE((found.U[a] - exact.U[a]).norm(), 1e-10 * exact.U[a].norm()) << sample;
      EXPECT_TRUE(found.T[a].allFinite());
      // The T of the corner itself follows from rigid-body translation.
      if (a != corner) {
        EXPECT_LE((found.T[a] - exact.T[a]).norm(), 1e-10 * std::max(exact.T[a].norm(), 1e-3));
      }
    }
  }
}

TEST(Integration, DoesNotDependOnTheOrderOfTheCorners) {
  Sampler sampler;
  for (int sample = 0; sample < 600; ++sample) {
    const Corners c = sampler.triangle(sample);
    const Material material = sampler.material(sample);
    const double ratio = 0.01 * std::pow(1000, sampler.uniform(0, 1));
    const Vector3d x = centroidOf(c) + ratio * radiusOf(c) * sampler.direction();
    const ElementBlocks straight = assembledBlocks(c, x, material, 1e-7);
    const ElementBlocks turned = assembledBlocks({c[1], c[2], c[0]}, x, material, 1e-7);
    const ElementBlocks flipped = assembledBlocks({c[0], c[2], c[1]}, x, material, 1e-7);
    ElementBlocks fromTurned, fromFlipped;
    for (int a = 0; a < 3; ++a) {
      fromTurned.U[(a + 1) % 3] = turned.U[a];
      fromTurned.T[(a + 1) % 3] = turned.T[a];
      fromFlipped.U[(3 - a) % 3] = flipped.U[a];
      fromFlipped.T[(3 - a) % 3] = -flipped.T[a];  // the normal is reversed
    }
    // Rounding of the closed form grows with the distance up to 5 radii, where the rules begin.
    EXPECT_LE(blockError(fromTurned, straight), 2e-10) << "at " << ratio << " radii";
    EXPECT_LE(blockError(fromFlipped, straight), 2e-10) << "at " << ratio << " radii";
  }
}

}  // namespace
}  // namespace palpa::bem

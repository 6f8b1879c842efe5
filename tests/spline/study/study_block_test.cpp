// Clamped block: the stress is singular along the rim of the fixed face, so uniform refinement does
// not reach the order of smooth fields. Reference: a graded cubic solution finer than all others.
#include <gtest/gtest.h>

#include "bem/triangle/results.h"
#include "study_block.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;

constexpr double kUniform = 1, kGraded = 1.75;

class ClampedBlockStudy {
 public:
  ClampedBlockStudy() : exact_(fieldOf(block_.solve(3, 14, 2))) {}

  StudySeries splines(const char* engine, int degree, const std::vector<int>& spans,
                      double grading) const {
    StudySeries series{"clamped block", engine, {}};
    for (const int n : spans) {
      const auto body = block_.solve(degree, n, grading);
      series.steps.push_back(stepOf(*body, exact_));
      series.steps.back().reaction = reactionError(body->reaction());
    }
    report(series);
    return series;
  }

  StudySeries triangles(const char* engine, const std::vector<double>& edgeLengths,
                        bool isRefined) const {
    StudySeries series{"clamped block", engine, {}};
    for (const double edgeLength : edgeLengths) {
      const auto body = block_.solve(edgeLength, isRefined);
      series.steps.push_back(stepOf(*body, exact_));
      series.steps.back().reaction =
          reactionError(tractionResultant(body->mesh, body->slots, body->field.p.col(0),
                                          trianglesWithTag(body->mesh, 1))
                            .force);
    }
    report(series);
    return series;
  }

 private:
  /// The force of the support equals the load for every discretisation.
  double reactionError(const Vector3d& force) const {
    return (force + block_.load()).norm() / block_.load().norm();
  }

  ClampedBlock block_;
  ExactField exact_;
};

TEST(SplineStudy, ClampedBlock) {
  const ClampedBlockStudy study;
  study.triangles(kTriangles, {7, 5, 3.5, 2.6, 1.9}, false);
  study.triangles("triangles, refined", {10, 7, 5, 3.6}, true);
  study.splines(kQuadratic, 2, {3, 5, 7, 9}, kUniform);
  study.splines("quadratic splines, graded", 2, {3, 5, 7, 9}, kGraded);
  const StudySeries uniform = study.splines(kCubic, 3, {2, 4, 6, 8, 10}, kUniform);
  const StudySeries graded = study.splines("cubic splines, graded", 3, {2, 4, 6, 8, 10}, kGraded);
  for (std::size_t i = 1; i < graded.steps.size(); ++i) {
    EXPECT_EQ(graded.steps[i].coefficients, uniform.steps[i].coefficients);
    EXPECT_LT(graded.steps[i].error, uniform.steps[i].error);
  }
  EXPECT_LT(graded.last().error, uniform.last().error / 4);
  EXPECT_LT(uniform.lastOrder(), 2);  // for any degree
  EXPECT_GE(graded.lastOrder(), 3);
  EXPECT_LE(graded.last().reaction, 3e-4);
  // A different grid of nearly the size of the reference: an estimate of the error of the
  // reference.
  const StudySeries check =
      study.splines("cubic splines, check of the reference", 3, {12}, kGraded);
  EXPECT_LT(check.last().error, 0.75 * graded.last().error);
}

}  // namespace
}  // namespace palpa::bem::test

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "app/verification/exact/simple_meshes.h"
#include "bem/compressed/block_share.h"
#include "bem/compressed/make_problem.h"
#include "bem/linalg/cluster_tree.h"
#include "quadratic_body.h"
#include "thread_team.h"

namespace palpa::bem::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

using Problem = std::unique_ptr<CompressedReferenceProblem>;

std::unique_ptr<QuadraticDiscretisation> heldBox() {
  BoundaryMesh mesh = verification::boxMesh(Vector3d::Zero(), Vector3d(48, 16, 12), 14, 5, 4);
  for (int& tag : mesh.tags) tag = tag == 0 ? 1 : 0;  // the support is the face at x = 0
  return quadratic(mesh, onFlatFaces, {1});
}

ProblemInputs inputsFor(const QuadraticDiscretisation& on) {
  std::vector<SlotCondition> conditions;
  for (const auto& slot : on.slots().slots)
    conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
  return {conditions, {0.1, 0.45}, {1e-6}, Precision::kCompressed};
}

Job oneThread() {
  Job job;
  job.threads = 1;
  return job;
}

/// The problems of all members of a team.
std::vector<Problem> makeByTeam(const QuadraticDiscretisation& on, int members) {
  std::vector<Problem> problems(static_cast<std::size_t>(members));
  ThreadTeam(members).run([&](const Team& team) {
    problems[team.index()] =
        makeCompressedReferenceProblem(on, inputsFor(on), {}, oneThread(), nullptr, &team);
  });
  return problems;
}

BoundaryField randomField(const DegreesOfFreedom& dofs) {
  srand(1);
  return {MatrixXd::Random(dofs.nodalCount(), 2),
          dofs.tractionScale() * MatrixXd::Random(3 * static_cast<Index>(dofs.slotCount()), 2)};
}

TEST(BlockShare, GivesEachBlockToOneMember) {
  for (const int count : {1, 2, 3, 4, 7}) {
    std::vector<int> ofMember(static_cast<std::size_t>(count));
    for (int cluster = 0; cluster < ClusterTree::firstOf(7); ++cluster)
      for (std::size_t block = 0; block < 12; ++block) {
        int owners = 0;
        for (int m = 0; m < count; ++m)
          if (BlockShare(m, count).hasBlock(cluster, block)) {
            ++owners;
            ++ofMember[m];
          }
        EXPECT_EQ(owners, 1) << cluster << ' ' << block << " of " << count;
      }
    for (const int blocks : ofMember) EXPECT_NEAR(blocks, 12 * 127 / count, 12 * 127 / 8);
  }
}

/// The problem of a team of one.
const CompressedReferenceProblem& alone() {
  static const auto on = heldBox();
  static const Problem problem = std::move(makeByTeam(*on, 1)[0]);
  return *problem;
}

/// Teams store right factors as they are, so that no member's share depends on the others'.
TEST(CompressedTeam, OfOneMakesTheProblemThatIsMadeWithoutOne) {
  const auto on = heldBox();
  const Problem withoutTeam = makeCompressedReferenceProblem(*on, inputsFor(*on), {}, oneThread());
  EXPECT_GT(withoutTeam->operators().sizes().bases, 0);
  EXPECT_EQ(alone().operators().sizes().bases, 0);
  const BoundaryField field = randomField(alone().dofs());
  const MatrixXd expected = withoutTeam->residual(field, {});
  EXPECT_LT((alone().residual(field, {}) - expected).norm(), 2e-6 * expected.norm());
  const std::vector<int> columns{300, 301, 302};
  const MatrixXd ofColumns = withoutTeam->greensColumns(columns);
  EXPECT_LT((alone().greensColumns(columns) - ofColumns).norm(), 2e-5 * ofColumns.norm());
}

class CompressedTeams : public testing::TestWithParam<int> {
 protected:
  /// Where two members share a leaf, its rows are summed up in another order.
  double rounding() const { return GetParam() == 3 ? 1e-6 : 1e-14; }
};
INSTANTIATE_TEST_SUITE_P(Members, CompressedTeams, testing::Values(2, 3, 4));

TEST_P(CompressedTeams, MakeTheSameProblem) {
  const auto on = heldBox();
  std::vector<Problem> members = makeByTeam(*on, GetParam());
  const BoundaryField field = randomField(alone().dofs());
  const MatrixXd expected = alone().residual(field, {});

  // The shares are summands, of about equal size.
  MatrixXd sum = MatrixXd::Zero(expected.rows(), expected.cols());
  std::size_t largest = 0, total = 0;
  for (const Problem& member : members) {
    sum += member->residual(field, {});
    const auto sizes = member->operators().sizes();
    largest = std::max(largest, sizes.far + sizes.near + sizes.averaged);
    total += sizes.far + sizes.near + sizes.averaged;
  }
  EXPECT_LT((sum - expected).norm(), rounding() * expected.norm());
  EXPECT_LT(static_cast<double>(largest), 1.5 * static_cast<double>(total) / GetParam());

  // All have the same factors; rounding may change the ranks of a few tiles.
  const MatrixXd solved = alone().precondition(expected, {}),
                 first = members.front()->precondition(expected, {});
  EXPECT_LT((first - solved).norm(), 1e-3 * solved.norm());
  EXPECT_NEAR(members.front()->factors().norm1(), alone().factors().norm1(),
              1e-5 * alone().factors().norm1());
  for (const Problem& member : members) EXPECT_EQ(member->precondition(expected, {}), first);

  // Together they are the whole.
  for (std::size_t m = 1; m < members.size(); ++m) members[0]->add(members[m]->operators());
  EXPECT_EQ(members[0]->operators().bytes(), alone().operators().bytes());
  EXPECT_LT((members[0]->residual(field, {}) - expected).norm(), rounding() * expected.norm());
  const std::vector<int> columns{300, 301, 302};
  const MatrixXd ofAlone = alone().greensColumns(columns),
                 ofTeam = members[0]->greensColumns(columns);
  EXPECT_LT((ofTeam - ofAlone).norm(), 1e-5 * ofAlone.norm());
}

}  // namespace
}  // namespace palpa::bem::test

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "base/byte_reader.h"
#include "bem/base/error.h"
#include "bem/compressed/make_problem.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/dense/transposed_solution.h"
#include "bem/dense/update_reference_problem.h"
#include "bem/element/rigid_motions.h"
#include "bem/quadratic/quadratic_assembly.h"
#include "quadratic_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::Vector3d;

using Effort = ReferenceProblem::Effort;

constexpr Material kMaterial{0.1, 0.45};

/// A body with a support and its problem in both forms.
struct BothForms {
  explicit BothForms(std::unique_ptr<QuadraticDiscretisation> discretisation,
                     const CompressionOptions& options = {}, const Material& material = kMaterial)
      : on(std::move(discretisation)) {
    std::vector<SlotCondition> conditions;
    for (const auto& slot : on->slots().slots)
      conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
    inputs = {conditions, material, {1e-6}, Precision::kMixed};
    compressed = makeCompressedReferenceProblem(*on, inputs, options);
  }

  /// Made when first needed.
  const ReferenceProblem& dense() const {
    if (!dense_) dense_ = makeDenseReferenceProblem(*on, inputs);
    return *dense_;
  }

  /// Columns of free nodes across the body: the largest relative difference of a column.
  double differenceOfColumns(Effort effort) const {
    std::vector<int> columns;
    const DegreesOfFreedom& dofs = compressed->dofs();
    for (int node = 5; node < dofs.nodeCount() && columns.size() < 12; node += 61)
      if (dofs.isFree(node))
        for (int c = 0; c < 3; ++c) columns.push_back(3 * node + c);
    const MatrixXd expected = dense().greensColumns(columns),
                   computed = compressed->greensColumns(columns, effort);
    return ((computed - expected).colwise().norm().cwiseQuotient(expected.colwise().norm()))
        .maxCoeff();
  }

  /// Relative difference of G p for tractions of a single slot in each of some columns.
  double differenceOfLoads(Index columns) const {
    const DegreesOfFreedom& dofs = compressed->dofs();
    BoundaryField field{MatrixXd::Zero(dofs.nodalCount(), columns),
                        MatrixXd::Zero(3 * static_cast<Index>(dofs.slotCount()), columns)};
    for (Index k = 0; k < columns; ++k) field.p(3 * (17 + 31 * k) + k % 3, k) = 1;
    const MatrixXd expected = dense().residual(field);
    return (compressed->residual(field, {}) - expected).norm() / expected.norm();
  }

  /// Relative difference of G p - H u for random coefficients.
  double differenceOfProducts() const {
    srand(1);
    const DegreesOfFreedom& dofs = compressed->dofs();
    const BoundaryField field{
        MatrixXd::Random(dofs.nodalCount(), 2),
        dofs.tractionScale() * MatrixXd::Random(3 * static_cast<Index>(dofs.slotCount()), 2)};
    const MatrixXd expected = dense().residual(field);
    return (compressed->residual(field, {}) - expected).norm() / expected.norm();
  }

  std::unique_ptr<QuadraticDiscretisation> on;
  ProblemInputs inputs;
  std::unique_ptr<CompressedReferenceProblem> compressed;

 private:
  mutable std::unique_ptr<ReferenceProblem> dense_;
};

std::unique_ptr<QuadraticDiscretisation> sphere(int cells) {
  return quadratic(verification::retagged(verification::sphereMesh(25, cells), 1,
                                          [](const Vector3d& x) { return x.z() < -15; }),
                   onSphere(25), {1});
}

/// Elongated, with flat faces along the axes.
std::unique_ptr<QuadraticDiscretisation> box(int along, int across, int high) {
  BoundaryMesh mesh =
      verification::boxMesh(Vector3d::Zero(), Vector3d(48, 16, 12), along, across, high);
  for (int& tag : mesh.tags) tag = tag == 0 ? 1 : 0;  // the support is the face at x = 0
  return quadratic(mesh, onFlatFaces, {1});
}

/// For tests that make several problems.
std::unique_ptr<QuadraticDiscretisation> coarseBox() {
  return box(13, 4, 3);
}

/// Made once for all tests that read it only.
const BothForms& sharedBox() {
  static const BothForms forms(box(18, 6, 5));
  return forms;
}

TEST(CompressedOperators, AreNarrowBetweenDistantClusters) {
  const BothForms sphere(test::sphere(12));
  const CompressedOperators& operators = sphere.compressed->operators();
  const CompressedOrder& order = operators.order();
  const int first = ClusterTree::firstOf(4), end = ClusterTree::firstOf(5);
  ASSERT_LE(end, order.tree.count());
  CompressedOperators::Scratch scratch;
  int narrow = 0, dense = 0;
  for (int rows = first; rows < end; ++rows)
    for (int of = first; of < end; of += 3) {
      std::vector<int> equations, columns, reached;
      for (int k = order.tree.cluster(rows).begin; k < order.tree.cluster(rows).end; ++k)
        equations.push_back(order.tree.order()[k]);
      for (int k = order.tree.cluster(of).begin; k < order.tree.cluster(of).end; ++k)
        for (int c = 0; c < 3; ++c) columns.push_back(3 * k + c);
      MatrixXf left, right;
      if (!operators.expandNarrow(equations, columns, 700, scratch, left, right)) {
        ++dense;
        continue;
      }
      operators.appendSparseColumns(equations, reached);
      if (std::any_of(reached.begin(), reached.end(), [&](int column) {
            return 3 * column >= columns.front() && 3 * column <= columns.back();
          }))
        continue;
      ++narrow;
      EXPECT_LE(left.cols(), 700);
      operators.expand(equations, columns, scratch);
      const MatrixXf all = scratch.ofEquations.matrix();
      EXPECT_LT((left * right.transpose() - all).norm(), 1e-6F * all.norm());
    }
  EXPECT_GT(narrow, 10);
  EXPECT_GT(dense, 10);
}

TEST(CompressedProblem, AgreesWithDenseOneOnASphere) {
  const BothForms sphere(test::sphere(9));
  const auto sizes = sphere.compressed->operators().sizes();
  ASSERT_GT(sizes.farBlocks, 100);
  ASSERT_GT(sizes.bases, 4);
  EXPECT_LT(sphere.differenceOfProducts(), 1e-4);
  EXPECT_LT(sphere.differenceOfColumns(Effort::kFast), 5e-4);
  EXPECT_LT(sphere.differenceOfColumns(Effort::kRefined), 5e-4);
  EXPECT_LT(sphere.compressed->bytes(), sphere.dense().bytes());
  const double expected = expectedBytes(sizeOf(*sphere.on), true, Precision::kCompressed);
  EXPECT_LT(static_cast<double>(sphere.compressed->bytes()), expected);
  EXPECT_GT(static_cast<double>(sphere.compressed->bytes()), 0.4 * expected);
  const double condition = sphere.dense().conditionEstimate();
  EXPECT_GT(sphere.compressed->conditionEstimate({}), condition / 10);
  EXPECT_LT(sphere.compressed->conditionEstimate({}), 10 * condition);
}

/// The end x = 30 L of a bar of 2 x 3 x 30 L mm is pushed along y and z.
class SlenderBar {
 public:
  explicit SlenderBar(int thirties, const CompressionOptions& options = {})
      : forms_(make(thirties), options) {}

  const BothForms& forms() const { return forms_; }
  /// Largest relative difference of the displacements of compressed and dense operators.
  double difference() const {
    double largest = 0;
    for (const int axis : {1, 2}) {
      const auto displacements = [&](const ReferenceProblem& problem) {
        return problem.solveField(problem.dofs().knownField(pushed(axis))).u;
      };
      const MatrixXd expected = displacements(forms_.dense());
      largest = std::max(largest,
                         (displacements(*forms_.compressed) - expected).norm() / expected.norm());
    }
    return largest;
  }

 private:
  static std::unique_ptr<QuadraticDiscretisation> make(int thirties) {
    BoundaryMesh mesh =
        verification::boxMesh({0, 0, 0}, {30.0 * thirties, 3, 2}, 30 * thirties, 2, 2);
    for (int& tag : mesh.tags) tag = tag == 0 ? 1 : tag == 1 ? 2 : 0;  // the ends, the sides
    return quadratic(mesh, onFlatFaces, {1});
  }
  BoundaryConditions pushed(int axis) const {
    const TractionSlots& slots = forms_.on->slots();
    BoundaryConditions data(forms_.on->displacementCount(), slots.count());
    data.ofSlot = forms_.inputs.conditions;
    for (int slot = 0; slot < slots.count(); ++slot)
      if (slots.slots[slot].tag == 2) data.traction[3 * slot + axis] = 1e-6;
    return data;
  }

  BothForms forms_;
};

TEST(CompressedProblem, AgreesWithDenseOneOnSlenderBars) {
  const SlenderBar bar(1);
  const BothForms& forms = bar.forms();
  // Its elements are integrated at seven points each.
  ASSERT_GT(thinShare(forms.on->surface()), 0.9);
  ASSERT_GT(forms.compressed->operators().sizes().farBlocks, 60);
  EXPECT_LT(forms.differenceOfProducts(), 1e-4);
  EXPECT_LT(bar.difference(), 0.002);
  const SlenderBar twice(2);
  EXPECT_LT(twice.difference(), 0.01);
}

TEST(CompressedProblem, AgreesWithDenseOneOnFlatFaces) {
  const BothForms& box = sharedBox();
  ASSERT_GT(box.compressed->operators().sizes().farBlocks, 100);
  EXPECT_LT(box.differenceOfProducts(), 1e-4);
  EXPECT_LT(box.differenceOfColumns(Effort::kFast), 1e-3);
}

TEST(CompressedProblem, LoadsOfFewSlotsGiveTheirColumns) {
  const BothForms& box = sharedBox();
  for (const Index columns : {1, 2, 3}) EXPECT_LT(box.differenceOfLoads(columns), 1e-4) << columns;
}

TEST(CompressedProblem, TheFirstSolutionIsCorrected) {
  for (const double tolerance : {1e-3, 3e-2}) {
    CompressionOptions options;
    options.factors = tolerance;
    const BothForms box(coarseBox(), options);
    EXPECT_LT(box.differenceOfColumns(Effort::kFast), 3e-3) << tolerance;
  }
}

TEST(CompressedProblem, IsMoreExactWithASmallerTolerance) {
  CompressionOptions coarse, fine;
  coarse.operators = 1e-2;
  fine.operators = 1e-5;
  const BothForms one(coarseBox(), coarse), other(coarseBox(), fine);
  EXPECT_LT(other.differenceOfProducts(), 0.1 * one.differenceOfProducts());
  EXPECT_LT(one.compressed->operators().sizes().meanRank,
            other.compressed->operators().sizes().meanRank);
  // Rounding of the stored numbers remains.
  EXPECT_LT(other.differenceOfColumns(Effort::kRefined), 4e-4);
}

TEST(CompressedProblem, RigidMotionsHaveNoResidual) {
  // Also at ν = 1/2, where the antisymmetric kernel of T has the factor zero.
  for (const double nu : {0.3, 0.5}) {
    const BothForms box(coarseBox(), {}, {0.1, nu});
    const DegreesOfFreedom& dofs = box.compressed->dofs();
    const BoundaryField field{rigidMotions(box.on->places(), Vector3d(24, 8, 6)),
                              MatrixXd::Zero(3 * static_cast<Index>(dofs.slotCount()), 6)};
    const MatrixXd residual = box.compressed->residual(field, {});
    EXPECT_LT(residual.leftCols<3>().cwiseAbs().maxCoeff(), 1e-6) << nu;
    EXPECT_LT(residual.rightCols<3>().cwiseAbs().maxCoeff(), 5e-5) << nu;  // 24 mm from the centre
    EXPECT_LT(box.dense().residual(field, {}).cwiseAbs().maxCoeff(), 1e-10) << nu;
  }
}

TEST(CompressedProblem, DoesNotDependOnTheNumberOfThreads) {
  const BothForms& box = sharedBox();
  Job one;
  one.threads = 1;
  const auto same = makeCompressedReferenceProblem(*box.on, box.inputs, {}, one);
  const std::vector<int> columns{300, 301, 302};
  EXPECT_EQ(same->greensColumns(columns, Effort::kFast),
            box.compressed->greensColumns(columns, Effort::kFast));
}

TEST(CompressedProblem, IsCancelledInEveryPhase) {
  const auto on = coarseBox();
  std::vector<SlotCondition> conditions;
  for (const auto& slot : on->slots().slots)
    conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
  for (const Phase phase : {Phase::kAssemble, Phase::kFactorise})
    for (const double at : {0.01, 0.4, 0.6, 0.9}) {
      std::stop_source stop;
      Job job;
      job.stop = stop.get_token();
      double last = 0;
      job.progress = [&](Phase now, double fraction) {
        if (now != phase) return;
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1);
        last = fraction;
        if (fraction >= at) stop.request_stop();
      };
      EXPECT_THROW(makeCompressedReferenceProblem(*on, {conditions, kMaterial, {1e-6}}, {}, job),
                   Cancelled)
          << nameOf(phase) << ' ' << at;
    }
}

TEST(CompressedProblem, IsChosenForLargeQuadraticMeshesOnly) {
  EXPECT_FALSE(isCompressed(Precision::kAutomatic, true, kCompressedFrom - 1));
  EXPECT_TRUE(isCompressed(Precision::kAutomatic, true, kCompressedFrom));
  EXPECT_FALSE(isCompressed(Precision::kAutomatic, false, kCompressedFrom));
  EXPECT_FALSE(isCompressed(Precision::kSingle, true, kCompressedFrom));
  EXPECT_TRUE(isCompressed(Precision::kCompressed, true, 100));
  // Where both fit, the choice saves memory, and more in larger models.
  const auto share = [](double nodes) {
    return expectedBytes({nodes, nodes}, true, Precision::kAutomatic) /
           expectedBytes({nodes, nodes}, true, Precision::kSingle);
  };
  EXPECT_LT(share(kCompressedFrom), 1);
  EXPECT_LT(share(4 * kCompressedFrom), 0.5 * share(kCompressedFrom));
  const auto on = sphere(4);
  std::vector<SlotCondition> conditions;
  for (const auto& slot : on->slots().slots)
    conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
  EXPECT_EQ(makeReferenceProblem(*on, {conditions, kMaterial})->storageName(), "dense");
}

TEST(CompressedProblem, IsReadAsItWasWritten) {
  const BothForms& box = sharedBox();
  ProblemInputs inputs = box.inputs;
  inputs.precision = Precision::kCompressed;
  ASSERT_GT(box.compressed->operators().sizes().bases, 0);
  std::vector<std::byte> stored;
  box.compressed->write([&](std::span<const std::byte> bytes) {
    stored.insert(stored.end(), bytes.begin(), bytes.end());
  });
  EXPECT_LT(static_cast<double>(stored.size()), 1.02 * static_cast<double>(box.compressed->bytes()))
      << "the cache plans with bytes()";
  const auto source = [](std::span<const std::byte> from) {
    return [from](std::span<std::byte> to) mutable {
      if (to.size() > from.size()) throw DamagedData();
      std::copy_n(from.begin(), to.size(), to.begin());
      from = from.subspan(to.size());
    };
  };
  const auto read = readReferenceProblem(*box.on, inputs, source(stored));
  EXPECT_EQ(read->storageName(), "compressed");
  EXPECT_EQ(read->bytes(), box.compressed->bytes());
  EXPECT_EQ(read->conditionEstimate(), box.compressed->conditionEstimate({}));
  const std::vector<int> columns{300, 301, 302};
  EXPECT_EQ(read->greensColumns(columns), box.compressed->greensColumns(columns));
  // Damaged numbers must neither take memory without bound nor be used as places.
  for (std::size_t k = 0; k < 16; ++k) {
    std::vector<std::byte> damaged = stored;
    damaged[k < 8 ? 15 * k : (k * 7919) * 4 % stored.size()] ^= std::byte{0x80};
    try {
      readReferenceProblem(*box.on, inputs, source(damaged));
    } catch (const DamagedData&) {
    }
  }
  EXPECT_THROW(
      readReferenceProblem(*box.on, inputs, source(std::span(stored).first(stored.size() - 1))),
      DamagedData);
}

TEST(CompressedProblem, SaysWhatItCannotDo) {
  BothForms box(coarseBox());
  const std::shared_ptr<const ReferenceProblem> compressed = std::move(box.compressed);
  EXPECT_THROW(solveTransposed(*compressed, MatrixXd::Zero(compressed->dofs().count(), 1)),
               SolverError);
  BoundaryMesh moved = box.on->mesh();
  moved.nodes.back() *= 1.001;
  EXPECT_EQ(updateDenseReferenceProblem(compressed, *box.on, QuadraticDiscretisation(moved, {1}),
                                        box.inputs),
            nullptr);
}

}  // namespace
}  // namespace palpa::bem::test

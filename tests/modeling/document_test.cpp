#include "modeling/editing/document.h"

#include "tests/modeling/editing_fixture.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

Document boxDocument() {
  return Document(editingProject(makeBox({40, 30, 20})));
}

Command move(int point, const Vector3d& by) {
  return MovePoints{PointSelection::of({point}), MoveBy{by}, {}};
}

TEST(Document, UndoAndRedoWalkThroughTheStates) {
  Document document = boxDocument();
  const auto start = solidOf(document.project()).controlPoints();
  EXPECT_TRUE(document.isClean());
  EXPECT_FALSE(document.canUndo());
  document.perform(move(0, {1, 0, 0}));
  document.perform(RenameProject{"other"});
  EXPECT_EQ(document.undoLabel(), "Rename project");
  Change change = document.undo();
  EXPECT_TRUE(change.name && change.movedPoints.empty());
  EXPECT_EQ(document.redoLabel(), "Rename project");
  change = document.undo();
  EXPECT_EQ(change.movedPoints, std::vector{0});
  EXPECT_EQ(change.changedPatches.size(), 3U);  // a corner
  EXPECT_EQ(solidOf(document.project()).controlPoints(), start);
  EXPECT_TRUE(document.isClean());
  EXPECT_THROW(document.undo(), std::logic_error);
  document.redo();
  document.redo();
  EXPECT_EQ(document.project().name, "other");
  EXPECT_THROW(document.redo(), std::logic_error);
}

TEST(Document, TheHistoryListsAllStatesAndGoesToAny) {
  Document document = boxDocument();
  document.perform(move(0, {1, 0, 0}));
  document.perform(RenameProject{"other"});
  document.markSaved();
  document.perform(RenameProject{"third"});
  document.undo();
  document.undo();
  const Document::History history = document.history();
  EXPECT_EQ(history.labels, (std::vector<std::string>{"", "Move 1 control point", "Rename project",
                                                      "Rename project"}));
  EXPECT_EQ(history.position, 1U);
  EXPECT_EQ(history.saved, 2U);
  EXPECT_TRUE(document.goToState(3).name);
  EXPECT_EQ(document.project().name, "third");
  EXPECT_EQ(document.goToState(0).movedPoints, std::vector{0});
  EXPECT_FALSE(document.canUndo());
  EXPECT_THROW(document.goToState(4), std::logic_error);
  document.beginGroup("group");
  EXPECT_THROW(document.goToState(1), std::logic_error);
  document.cancelGroup();
  // A saved state that can no longer be reached is not listed.
  document.perform(RenameProject{"elsewhere"});
  EXPECT_FALSE(document.history().saved);
}

TEST(Document, ANewEditEndsRedoButRefusedOrEmptyEditsDoNot) {
  Document document = boxDocument();
  document.perform(move(0, {1, 0, 0}));
  document.undo();
  EXPECT_THROW(document.perform(move(99, {1, 0, 0})), ModelingError);
  EXPECT_FALSE(document.perform(move(0, {0, 0, 0})).change.any());
  EXPECT_TRUE(document.canRedo());
  document.perform(move(1, {1, 0, 0}));
  EXPECT_FALSE(document.canRedo());
}

TEST(Document, ADragIsOneStep) {
  Document document = boxDocument();
  const auto start = solidOf(document.project()).controlPoints();
  document.perform(move(7, {0.1, 0, 0}));
  for (int k = 0; k < 9; ++k) document.perform(move(7, {0.1, 0, 0}), Merge::kWithLast);
  EXPECT_NEAR(solidOf(document.project()).controlPoints()[7].x(), start[7].x() + 1.0, 1e-12);
  EXPECT_EQ(document.undoLabel(), "Move 1 control point");
  document.undo();
  EXPECT_EQ(solidOf(document.project()).controlPoints(), start);
  EXPECT_FALSE(document.canUndo());
  // Moves of another point, or after undo, redo or saving, are not merged.
  document.redo();
  document.perform(move(7, {0, 1, 0}), Merge::kWithLast);
  document.perform(move(8, {0, 1, 0}), Merge::kWithLast);
  document.markSaved();
  document.perform(move(8, {0, 1, 0}), Merge::kWithLast);
  int steps = 0;
  for (; document.canUndo(); ++steps) document.undo();
  EXPECT_EQ(steps, 4);
}

TEST(Document, ADragBackToItsStartLeavesNoStep) {
  Document document = boxDocument();
  document.perform(move(3, {1, 0, 0}));
  document.perform(move(7, {1, 0, 0}));
  document.perform(move(7, {-1, 0, 0}), Merge::kWithLast);
  EXPECT_EQ(document.undoLabel(), "Move 1 control point");
  // Further moves of this drag must not merge with the previous step.
  document.perform(move(3, {1, 0, 0}), Merge::kWithLast);
  document.undo();
  EXPECT_TRUE(document.canUndo());
  document.undo();
  EXPECT_TRUE(document.isClean());
}

TEST(Document, TheResultOfADragDoesNotDependOnItsSteps) {
  const Solid cylinder = makeCylinder(15, 40);
  Document fine(editingProject(cylinder.withSmoothEdges({0, 1, 2, 3}, true)));
  Document coarse(fine.project());
  const MovePoints inflate{PointSelection::of({3, 4, 5}), MoveAlongNormal{0.5}, {8.0, {}}};
  fine.perform(inflate);
  for (int k = 0; k < 3; ++k) fine.perform(inflate, Merge::kWithLast);
  MovePoints all = inflate;
  all.how = MoveAlongNormal{2.0};
  coarse.perform(all);
  EXPECT_EQ(solidOf(fine.project()).controlPoints(), solidOf(coarse.project()).controlPoints());
}

TEST(Document, ARefusedMoveOfADragKeepsThePreviousOne) {
  Document document = boxDocument();
  document.perform(move(7, {1, 0, 0}));
  const Project before = document.project();
  EXPECT_THROW(document.perform(move(7, {1e30, 0, 0}), Merge::kWithLast), ModelingError);
  EXPECT_FALSE(compare(before, document.project()).any());
  document.undo();
  EXPECT_TRUE(document.isClean());
}

TEST(Document, GroupsAreOneStepAndCanBeCancelled) {
  Document document = boxDocument();
  document.beginGroup("Make a foot");
  document.perform(move(0, {1, 0, 0}));
  document.beginGroup("inner");
  document.perform(RenameProject{"foot"});
  document.endGroup();
  EXPECT_FALSE(document.canUndo());
  document.endGroup();
  EXPECT_EQ(document.undoLabel(), "Make a foot");
  const Change change = document.undo();
  EXPECT_TRUE(change.name && change.movedPoints.size() == 1);
  EXPECT_FALSE(document.canUndo());

  // Cancelling also restores the redo steps.
  document.beginGroup("x");
  document.perform(move(3, {1, 0, 0}));
  EXPECT_EQ(document.cancelGroup().movedPoints, std::vector{3});
  EXPECT_EQ(document.redoLabel(), "Make a foot");
  // A group without effect leaves no step.
  document.beginGroup("x");
  document.perform(move(3, {1, 0, 0}));
  document.perform(move(3, {-1, 0, 0}));
  document.endGroup();
  EXPECT_FALSE(document.canUndo());
  EXPECT_EQ(document.redoLabel(), "Make a foot");
  EXPECT_THROW(document.endGroup(), std::logic_error);
}

TEST(Document, KnowsWhetherItIsSaved) {
  Document document = boxDocument();
  document.perform(RenameProject{"a"});
  EXPECT_FALSE(document.isClean());
  document.markSaved();
  EXPECT_TRUE(document.isClean());
  document.undo();
  EXPECT_FALSE(document.isClean());
  document.redo();
  EXPECT_TRUE(document.isClean());
  // Equal content reached in another way is clean too.
  document.perform(RenameProject{"b"});
  document.perform(RenameProject{"a"});
  EXPECT_TRUE(document.isClean());
}

TEST(Document, ViewChangesAreNoSteps) {
  Document document = boxDocument();
  document.perform(RenameProject{"a"});
  document.setView("{\"zoom\":2}");
  document.undo();
  EXPECT_EQ(document.project().view, "{\"zoom\":2}");
  EXPECT_TRUE(document.isClean());
  EXPECT_FALSE(document.canUndo());
}

TEST(Document, ForgetsTheOldestSteps) {
  Document document(editingProject(makeBox({40, 30, 20})), 3);
  for (int k = 0; k < 10; ++k) document.perform(move(k, {1, 0, 0}));
  int steps = 0;
  for (; document.canUndo(); ++steps) document.undo();
  EXPECT_EQ(steps, 3);
  EXPECT_FALSE(document.isClean());
}

}  // namespace
}  // namespace palpa::modeling

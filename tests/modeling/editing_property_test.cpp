// Thousands of random commands, valid and invalid: invariants after each command, and undo.
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "modeling/editing/command_file.h"
#include "modeling/project/project_file.h"
#include "tests/modeling/editing_fixture.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Makes random commands for a project; about a quarter contain a fault.
class RandomCommands {
 public:
  explicit RandomCommands(unsigned seed) : random_(seed) {}

  int upTo(int most) { return static_cast<int>(random_() % static_cast<unsigned>(most + 1)); }
  bool oneIn(int n) { return upTo(n - 1) == 0; }

  Command next(const Project& project) {
    project_ = &project;
    const auto* solid = std::get_if<Solid>(&project.body);
    pointCount_ = solid ? static_cast<int>(solid->controlPoints().size()) : 8;
    const Vector3d direction = vector(1.0);
    switch (upTo(24)) {
      case 0:
      case 1:
      case 2:
        return MovePoints{selection(), MoveBy{vector(2.0)}, reach()};
      case 3:
        return MovePoints{
            PointSelection::of({point(), point()}), MoveTo{{vector(25.0), vector(25.0)}}, {}};
      case 4:
        return MovePoints{selection(), MoveAlongNormal{number(2.0)}, reach()};
      case 5:
        return ScalePoints{selection(), Vector3d::Ones() + vector(0.2), center(), reach()};
      case 6:
        return RotatePoints{selection(), direction, number(30.0), center(), reach()};
      case 7:
        return AlignPoints{selection(), oneIn(2) ? std::optional(direction) : std::nullopt, {}};
      case 8:
      case 9:
        if (pointCount_ > 250) return ElevateDegree{patch(), upTo(1), 2 + upTo(5)};
        return InsertKnot{patch(), upTo(1), parameter(), 1 + upTo(2)};
      case 10:
        return RemoveKnot{patch(), upTo(1), knot(), 1, oneIn(2) ? 10.0 : 1e-6};
      case 11:
        if (pointCount_ > 150) return RemoveKnot{patch(), upTo(1), knot(), 1, 5.0};
        return ElevateDegree{patch(), upTo(1), 2 + upTo(4)};
      case 12:
        return TransformSolid{Translation{vector(3.0)}};
      case 13:
        return oneIn(2) ? TransformSolid{Rotation{direction, number(90.0), vector(5.0)}}
                        : TransformSolid{MirrorPlane{vector(5.0), direction}};
      case 14:
        return TransformSolid{Scaling{Vector3d::Ones() + vector(0.3), vector(5.0)}};
      case 15:
        return oneIn(2) ? MakePrimitive{{BoxShape{{30, 25, 20}}, 1 + upTo(3), 0}}
                        : MakePrimitive{{SphereShape{number(20.0)}, 3, 4 + upTo(2)}};
      case 16:
        return SetEdge{patch(), kSides[upTo(3)], !oneIn(3)};
      case 17:
        return AddSupport{{name(), Support::Kind::kFixed, region(), vector(0.1)}};
      case 18:
        return oneIn(2)
                   ? Command(SetSupport{name(), {name(), Support::Kind::kRoller, region(), {}}})
               : oneIn(2) ? Command(TakeOverlap{name(), name(), std::abs(number(2.0))})
                          : Command(RemoveSupport{name()});
      case 19:
        return AddLoad{{name(), Pressure{region(), number(0.1)}}};
      case 20:
        return oneIn(2) ? Command(SetLoad{name(), {name(), Bump{vector(9.0), 2.0, 0.1, direction}}})
                        : Command(RemoveLoad{name()});
      case 21:
        if (oneIn(3)) return AddTouch{{name(), vector(20.0), TouchKind::kPush, direction, {}, 0.3}};
        return oneIn(2)
                   ? Command(AddTouch{{name(), vector(20.0), TouchKind::kForce, direction, {}}})
                   : Command(RemoveTouch{name()});
      case 22:
        return SetMaterial{{"m", number(1.0), 0.3}};
      case 23: {
        MeshSettings mesh;
        mesh.edgeLength = number(5.0);
        if (oneIn(2)) mesh.patchFactors = {{patch(), 0.5}};
        return SetMesh{mesh};
      }
      default:
        return oneIn(2) ? Command(RenameProject{name()}) : Command(RenamePatch{patch(), name()});
    }
  }

 private:
  double number(double size) {
    if (oneIn(60)) return std::numeric_limits<double>::quiet_NaN();
    if (oneIn(60)) return 1e300;
    if (oneIn(40)) return 0.0;
    return std::uniform_real_distribution<double>(-size, size)(random_);
  }
  Vector3d vector(double size) {
    const double x = number(size);
    const double y = number(size);
    return {x, y, number(size)};
  }
  std::optional<Vector3d> center() { return oneIn(2) ? std::optional(vector(20.0)) : std::nullopt; }
  int point() { return oneIn(40) ? pointCount_ : upTo(pointCount_ - 1); }
  std::string patch() {
    const std::vector<std::string> names = patchNames(project_->body);
    return oneIn(30) ? "nobody" : names[upTo(static_cast<int>(names.size()) - 1)];
  }
  std::string name() { return std::string(1, static_cast<char>('a' + upTo(5))); }
  Region region() {
    switch (upTo(3)) {
      case 0:
        return Region::below(vector(1.0), number(9.0));
      case 1:
        return {{stroke(), stroke()}};
      case 2:
        return {{PatchSet{{patch()}}, stroke()}};
      default:
        return Region::ofPatches({patch()});
    }
  }
  Stroke stroke() {
    Stroke result{{}, 0.5 + std::abs(number(5.0))};
    for (int left = upTo(5); left >= 0; --left) result.points.push_back(vector(25.0));
    return result;
  }
  double parameter() { return oneIn(20) ? 1.5 : 0.125 * (1 + upTo(6)); }
  double knot() {
    const auto* solid = std::get_if<Solid>(&project_->body);
    const Patch& any = solid->patches()[upTo(static_cast<int>(solid->patches().size()) - 1)];
    const auto& knots = any.knots[upTo(1)];
    return knots[upTo(static_cast<int>(knots.size()) - 1)];
  }
  PointSelection selection() {
    switch (upTo(5)) {
      case 0:
        return {{PatchPoints{{patch()}}}};
      case 1:
        return {{SlabPoints{vector(1.0), number(10.0), std::nullopt}}};
      case 2:
        return {{BallPoints{vector(20.0), 15.0}}};
      case 3:
        return {{SidePoints{patch(), kSides[upTo(3)]}}};
      default:
        return PointSelection::of({point(), point()});
    }
  }
  Reach reach() {
    Reach reach;
    if (oneIn(3)) reach.falloff = number(15.0);
    if (oneIn(6)) reach.mirror = MirrorPlane{{0, 0, 0}, {1, 0, 0}};
    return reach;
  }

  std::mt19937 random_;
  const Project* project_ = nullptr;
  int pointCount_ = 0;
};

/// Exact content: the text of the file, and the bits of every control point (the text does not
/// distinguish 0 from -0).
std::string fingerprint(const Project& project) {
  std::string text = toJson(project);
  if (const auto* solid = std::get_if<Solid>(&project.body))
    for (const Vector3d& p : solid->controlPoints())
      text.append(reinterpret_cast<const char*>(p.data()), 3 * sizeof(double));
  return text;
}

/// The solid satisfies all invariants when it is constructed again from its parts.
void expectSound(const Project& project) {
  checkProject(project);
  const Solid& solid = solidOf(project);
  std::vector<PatchEdge> smooth;
  for (const SolidEdge& edge : solid.edges())
    if (edge.smooth) smooth.push_back(edge.uses[1]);
  const Solid again(solid.controlPoints(), solid.patches(), smooth);
  ASSERT_EQ(again.edges().size(), solid.edges().size());
  for (std::size_t e = 0; e < again.edges().size(); ++e)
    EXPECT_EQ(again.edges()[e].smooth, solid.edges()[e].smooth);
}

/// A Change lists exactly the differences: with the marked parts reverted, the text of the file
/// equals the previous text; without reverting any one of them it does not.
void expectCorrect(const Change& change, const Project& before, const Project& after) {
  const std::string expected = toJson(before);
  const auto withPartsBack = [&](int left) {
    Project project = after;
    int part = 0;
    const auto back = [&](bool changed, auto member) {
      if (changed && part != left) project.*member = before.*member;
      ++part;
    };
    back(change.body(), &Project::body);
    back(change.primitive, &Project::primitive);
    back(change.name, &Project::name);
    back(change.material, &Project::material);
    back(change.supports, &Project::supports);
    back(change.loads, &Project::loads);
    back(change.touches, &Project::touches);
    back(change.mesh, &Project::mesh);
    return toJson(project);
  };
  EXPECT_EQ(withPartsBack(-1), expected);
  const std::array<bool, 8> changed{change.body(),   change.primitive, change.name,
                                    change.material, change.supports,  change.loads,
                                    change.touches,  change.mesh};
  for (int part = 0; part < 8; ++part)
    EXPECT_EQ(withPartsBack(part) != expected, changed[part]) << part;
  if (change.topology || change.movedPoints.empty()) return;
  const auto& a = solidOf(before).controlPoints();
  const auto& b = solidOf(after).controlPoints();
  std::size_t next = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool listed =
        next < change.movedPoints.size() && change.movedPoints[next] == static_cast<int>(i);
    EXPECT_EQ(listed, a[i] != b[i]);
    next += listed;
  }
}

struct Tally {
  int done = 0;
  int refused = 0;
  int merged = 0;
  int carried = 0;  ///< moves of the surface that also moved strokes of supports
};

Tally randomSession(const Solid& start, unsigned seed, int count) {
  RandomCommands commands(seed);
  Document document(editingProject(start), 100000);
  const std::string first = fingerprint(document.project());
  Tally tally;
  Command last = RenameProject{""};
  for (int k = 0; k < count; ++k) {
    const Project before = document.project();
    if (commands.oneIn(12)) {
      for (int steps = commands.upTo(4); steps > 0 && document.canUndo(); --steps) document.undo();
      for (int steps = commands.upTo(3); steps > 0 && document.canRedo(); --steps) document.redo();
      continue;
    }
    const bool again = commands.oneIn(4);
    const Command command = again ? last : commands.next(before);
    try {
      const Performed performed = document.perform(command, again ? Merge::kWithLast : Merge::kNo);
      expectCorrect(performed.change, before, document.project());
      expectSound(document.project());
      ++tally.done;
      tally.merged += again;
      tally.carried += performed.change.supports && performed.change.body() &&
                       !performed.change.topology &&
                       !std::holds_alternative<TransformSolid>(command);
      last = command;
    } catch (const ModelingError& error) {
      EXPECT_EQ(fingerprint(document.project()), fingerprint(before)) << error.what();
      EXPECT_FALSE(std::string(error.what()).empty());
      ++tally.refused;
    }
    if (testing::Test::HasFailure()) {
      ADD_FAILURE() << "seed " << seed << ", command " << k << ": " << toJson(command);
      return tally;
    }
  }
  // All the way back and forward again: the same states bit for bit.
  std::vector<std::string> states;
  while (document.canRedo()) document.redo();
  const std::string newest = fingerprint(document.project());
  while (document.canUndo()) {
    states.push_back(fingerprint(document.project()));
    const Project before = document.project();
    const Change change = document.undo();
    expectCorrect(change, before, document.project());
  }
  EXPECT_EQ(fingerprint(document.project()), first);
  EXPECT_TRUE(document.isClean());
  for (; document.canRedo(); states.pop_back()) {
    document.redo();
    EXPECT_EQ(fingerprint(document.project()), states.back());
  }
  EXPECT_TRUE(states.empty());
  EXPECT_EQ(fingerprint(document.project()), newest);
  return tally;
}

TEST(EditingProperties, RandomSessionsKeepTheInvariantsAndCanBeUndone) {
  Tally total;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Solid start = seed % 3 == 0   ? makeBox({40, 30, 20})
                        : seed % 3 == 1 ? makeCylinder(15, 40)
                                        : makeSphere(20, 5);
    const Tally one = randomSession(start, seed, 100);
    total.done += one.done;
    total.refused += one.refused;
    total.merged += one.merged;
    total.carried += one.carried;
    if (HasFailure()) return;
  }
  // The mixture of valid and invalid commands is as intended.
  EXPECT_GT(total.done, 750);
  EXPECT_GT(total.refused, 150);
  EXPECT_GT(total.merged, 50);
  EXPECT_GT(total.carried, 50);
}

}  // namespace
}  // namespace palpa::modeling

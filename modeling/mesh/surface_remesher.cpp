#include "modeling/mesh/surface_remesher.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/count_text.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/surface_editor.h"

namespace palpa::modeling {
namespace {

// Bounds of Botsch and Kobbelt, of the wanted length, for which splits and collapses do not undo
// each other.
constexpr double kLong = 4.0 / 3.0;
constexpr double kShort = 4.0 / 5.0;
constexpr double kMaxTurn = std::numbers::pi / 4.0;  // of a feature line between two nodes
constexpr double kMaxSag = 0.2;                      // of an edge: an arc of about 90 degrees
constexpr double kSliver = 15.0;                     // degrees
constexpr double kRelief = 0.6;  // factor of the length of an edge that must become shorter
constexpr int kPasses = 6;
constexpr int kReliefRounds = 5;
constexpr int kReliefPasses = 3;

struct Edge {
  double key;
  int a;
  int b;

  bool operator<(const Edge& other) const {
    return std::tie(key, a, b) < std::tie(other.key, other.a, other.b);
  }
};

class Remesher {
 public:
  Remesher(const TaggedSurface& surface, SizeField sizes, const LengthAt& smallest, const Job& job)
      : original_(surface),
        sizes_(std::move(sizes)),
        smallest_(smallest),
        editor_(surface, original_, sizes_),
        job_(job) {}

  TaggedSurface run() {
    followTurns();
    for (int i = 0; i < kPasses; ++i) pass();
    for (int round = 0; round < kReliefRounds && relieve(); ++round)
      for (int i = 0; i < kReliefPasses; ++i) pass();
    job_.report(Phase::kMesh, 0.95);
    for (int i = 0; i < 2; ++i) {
      flipAll();
      relaxAll();
    }
    return editor_.result();
  }

 private:
  /// Reports the end of one of the four steps of a pass. The first pass, which makes the nodes,
  /// takes about as long as all later ones.
  void advance() {
    constexpr int kFirst = 4, kLater = 4 * (kPasses - 1 + kReliefRounds * kReliefPasses);
    ++steps_;
    job_.report(Phase::kMesh,
                steps_ <= kFirst ? 0.5 * steps_ / kFirst : 0.5 + 0.45 * (steps_ - kFirst) / kLater);
  }

  /// Checks for cancellation every few thousand elements.
  void checkpoint(std::size_t i) const {
    constexpr std::size_t kOften = 2048;
    if (i % kOften == 0) job_.throwIfCancelled();
  }

  std::vector<Edge> edges(double sign, double bound) const {
    std::vector<Edge> result;
    for (int t = 0; t < editor_.triangleCount(); ++t) {
      checkpoint(static_cast<std::size_t>(t));
      if (!editor_.isAlive(t)) continue;
      const auto& n = editor_.triangle(t);
      for (int k = 0; k < 3; ++k) {
        const int a = n[k];
        const int b = n[(k + 1) % 3];
        if (a > b) continue;
        const double key = sign * editor_.relativeLength(a, b);
        if (key < bound) result.push_back({key, a, b});
      }
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  void splitLong() {
    constexpr int kRounds = 40;  // each halves the longest edge
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<Edge> longest = edges(-1.0, -kLong);
      if (longest.empty()) return;
      std::size_t count = 0;
      for (const Edge& e : longest) {
        checkpoint(count++);
        editor_.split(e.a, e.b);
        if (editor_.nodeCount() > 2.0 * kMaxNodes)
          throw ModelingError("mesh.edge_length_mm: more than " + countText(kMaxNodes) +
                                  " nodes would be needed; choose a longer edge or less refinement",
                              ModelingError::Kind::kTooLarge);
      }
    }
  }

  void collapseShort() {
    constexpr int kRounds = 10;
    for (int round = 0; round < kRounds; ++round) {
      bool changed = false;
      std::size_t count = 0;
      for (const Edge& e : edges(1.0, kShort)) {
        checkpoint(count++);
        if (!editor_.isUsed(e.a) || !editor_.isUsed(e.b) || editor_.leftOf(e.a, e.b) < 0) continue;
        if (editor_.relativeLength(e.a, e.b) >= kShort) continue;
        changed |= editor_.collapse(e.a, e.b) || editor_.collapse(e.b, e.a);
      }
      if (!changed) return;
    }
  }

  void flipAll() {
    constexpr int kSweeps = 6;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      bool changed = false;
      for (int t = 0; t < editor_.triangleCount(); ++t) {
        checkpoint(static_cast<std::size_t>(t));
        for (int k = 0; k < 3; ++k) {
          if (!editor_.isAlive(t)) break;
          const int a = editor_.triangle(t)[k];
          const int b = editor_.triangle(t)[(k + 1) % 3];
          if (a < b) changed |= editor_.flip(a, b);
        }
      }
      if (!changed) return;
    }
  }

  void relaxAll() {
    for (int node = 0; node < editor_.nodeCount(); ++node) {
      checkpoint(static_cast<std::size_t>(node));
      editor_.relax(node);
    }
  }

  /// Splits long edges before collapsing short ones: collapsing the short sides of long facets
  /// would twist curved surfaces.
  void pass() {
    splitLong();
    advance();
    collapseShort();
    advance();
    for (int i = 0; i < 2; ++i) {
      flipAll();
      relaxAll();
      advance();
    }
  }

  /// Shortens the edges of feature lines that turn within a wanted edge length: a circle gets at
  /// least eight pieces.
  void followTurns() {
    std::vector<bool> seen(static_cast<std::size_t>(editor_.nodeCount()), false);
    const auto start = [&](bool corners) {
      for (int node = 0; node < editor_.nodeCount(); ++node)
        if (editor_.isCorner(node) == corners && !seen[node])
          for (int next : editor_.featureNeighbours(node))
            if (editor_.isCorner(next) || !seen[next]) followLine(node, next, seen);
    };
    start(true);
    start(false);  // only closed lines remain
    sizes_.update();
    editor_.updateSizes();
  }

  void followLine(int first, int second, std::vector<bool>& seen) {
    std::vector<int> line{first, second};
    double length = editor_.length(first, second);
    double turn = 0.0;
    const auto turnAt = [&](int before, int at, int after) {
      const Eigen::Vector3d in = editor_.position(at) - editor_.position(before);
      const Eigen::Vector3d out = editor_.position(after) - editor_.position(at);
      return std::acos(std::clamp(in.dot(out) / (in.norm() * out.norm() + 1e-300), -1.0, 1.0));
    };
    while (!editor_.isCorner(line.back()) && line.back() != first) {
      const int at = line.back();
      const int before = line[line.size() - 2];
      seen[at] = true;
      const std::vector<int> rails = editor_.featureNeighbours(at);
      const int next = rails[0] == before ? rails[1] : rails[0];
      turn += turnAt(before, at, next);
      length += editor_.length(at, next);
      line.push_back(next);
    }
    if (!editor_.isCorner(first)) seen[first] = true;
    constexpr double kMaxPieces = 16.0;  // noisy lines have a large total turn
    const double pieces = std::min(turn / kMaxTurn, kMaxPieces);
    if (pieces <= 1.0) return;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      addSource(line[i], line[i + 1], length / pieces);
  }

  void addSource(int a, int b, double length) {
    const Eigen::Vector3d &from = editor_.position(a), &to = editor_.position(b);
    sizes_.addSource(from, to, std::max(length, smallest_(0.5 * (from + to))));
  }

  /// Requests shorter edges at slivers between features and at edges that cut off too much of a
  /// curved surface. Returns whether there was such a place.
  bool relieve() {
    const double sliver = std::cos(kSliver * std::numbers::pi / 180.0);
    bool found = false;
    const auto shorten = [&](int a, int b) {
      const double length = kRelief * editor_.length(a, b);
      if (length < smallest_(0.5 * (editor_.position(a) + editor_.position(b)))) return;
      addSource(a, b, length);
      found = true;
    };
    for (int t = 0; t < editor_.triangleCount(); ++t) {
      checkpoint(static_cast<std::size_t>(t));
      if (!editor_.isAlive(t)) continue;
      const auto& n = editor_.triangle(t);
      int longest = 0;
      for (int k = 0; k < 3; ++k) {
        const int a = n[k];
        const int b = n[(k + 1) % 3];
        if (editor_.length(a, b) > editor_.length(n[longest], n[(longest + 1) % 3])) longest = k;
        if (a < b && editor_.sag(a, b) > kMaxSag * editor_.length(a, b)) shorten(a, b);
      }
      if (editor_.smallestAngleCosine(t) > sliver && !isSharpCorner(n))
        shorten(n[longest], n[(longest + 1) % 3]);
    }
    sizes_.update();
    editor_.updateSizes();
    return found;
  }

  /// True if the smallest angle of the triangle lies between two features. No mesh can enlarge it.
  bool isSharpCorner(const std::array<int, 3>& n) const {
    int shortest = 0;
    for (int k = 1; k < 3; ++k)
      if (editor_.length(n[k], n[(k + 1) % 3]) < editor_.length(n[shortest], n[(shortest + 1) % 3]))
        shortest = k;
    const int tip = n[(shortest + 2) % 3];
    return editor_.isFeature(tip, n[shortest]) && editor_.isFeature(tip, n[(shortest + 1) % 3]);
  }

  OriginalSurface original_;
  SizeField sizes_;
  const LengthAt& smallest_;
  SurfaceEditor editor_;
  const Job& job_;
  int steps_ = 0;
};

}  // namespace

TaggedSurface remesh(const TaggedSurface& surface, SizeField sizes, const LengthAt& smallest,
                     const Job& job) {
  return Remesher(surface, std::move(sizes), smallest, job).run();
}

}  // namespace palpa::modeling

#include "modeling/mesh/mesh_counts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "modeling/mesh/mesh_refine.h"
#include "modeling/solid/edge_curve.h"

namespace palpa::modeling {
namespace {

constexpr double kGradingLines = 1.5;  // measured on thin plates, discs and pins

double meanPieces(const SurfaceEvaluator& surface, int patch, int direction, double edgeLength) {
  const auto [low, high] = surface.range(patch, 1 - direction);
  const auto pieces = [&](double fixed) {
    return IsoCurve(surface, patch, direction, fixed).pieces(edgeLength);
  };
  return (pieces(low) + 4.0 * pieces(0.5 * (low + high)) + pieces(high)) / 6.0;
}

/// Number of pieces for the long sides of a patch's cells, and the direction of these sides.
struct Cuts {
  int direction = 0;
  double pieces = 1.0;
  double ratio = 1.0;  ///< of the sides of a cell
};

/// Cuts from the lengths of the patch's middle lines: a right triangle with legs a and b ≫ a has
/// the aspect √3/2 · b / a.
Cuts cutsOf(const SurfaceEvaluator& surface, int patch, const std::array<double, 2>& counts) {
  std::array<double, 2> cell{};
  for (int direction : {0, 1}) {
    const auto [low, high] = surface.range(patch, 1 - direction);
    cell[direction] =
        IsoCurve(surface, patch, direction, 0.5 * (low + high)).length() / counts[direction];
  }
  Cuts cuts{cell[0] > cell[1] ? 0 : 1};
  // Absurdly small edge lengths make the cells vanish.
  if (!(cell[0] > 0.0 && cell[1] > 0.0)) return cuts;
  cuts.ratio = cell[cuts.direction] / cell[1 - cuts.direction];
  while (cuts.pieces < kMaxCuts &&
         0.5 * std::numbers::sqrt3 * cuts.ratio > kMaxAspect * cuts.pieces)
    cuts.pieces *= 2.0;
  return cuts;
}

/// Patches whose cells fulfil a condition.
template <class Condition>
std::set<int> patchesWhere(const SurfaceEvaluator& surface, const Counts& counts,
                           const Condition& condition) {
  std::set<int> result;
  for (int patch = 0; patch < surface.patchCount(); ++patch)
    if (condition(cutsOf(surface, patch, counts[patch]))) result.insert(patch);
  return result;
}

}  // namespace

std::vector<double> patchEdgeLengths(const Solid& solid, const MeshSettings& settings) {
  std::vector<double> lengths(solid.patches().size(), settings.edgeLength);
  for (const auto& [name, factor] : settings.patchFactors)
    if (const auto patch = solid.findPatch(name)) lengths[*patch] = factor * settings.edgeLength;
  return lengths;
}

Counts subdivisionCounts(const Solid& solid, const SurfaceEvaluator& surface,
                         const std::vector<double>& edgeLengths, const Job& job) {
  const int patches = static_cast<int>(solid.patches().size());
  std::vector<int> chain(2 * patches);
  std::iota(chain.begin(), chain.end(), 0);
  const auto root = [&](int i) {
    while (chain[i] != i) i = chain[i] = chain[chain[i]];
    return i;
  };
  for (const SolidEdge& edge : solid.edges()) {
    const auto [a, b] = edge.uses;
    chain[root(2 * a.patch + directionOf(a.side))] = root(2 * b.patch + directionOf(b.side));
  }
  std::vector<double> count(2 * patches, 1.0);
  for (int i = 0; i < 2 * patches; ++i) {
    job.throwIfCancelled();
    const double pieces = std::round(meanPieces(surface, i / 2, i % 2, edgeLengths[i / 2]));
    count[root(i)] = std::max(count[root(i)], pieces);
  }
  Counts result(patches);
  for (int i = 0; i < 2 * patches; ++i) result[i / 2][i % 2] = count[root(i)];
  return result;
}

double structuredNodeCount(const Solid& solid, const Counts& counts) {
  double nodes = 0.0;
  for (const auto& [u, v] : counts) nodes += (u - 1.0) * (v - 1.0);
  std::set<int> vertices;
  for (const SolidEdge& edge : solid.edges()) {
    nodes += counts[edge.uses[0].patch][directionOf(edge.uses[0].side)] - 1.0;
    vertices.insert(edge.vertices.begin(), edge.vertices.end());
  }
  return nodes + static_cast<double>(vertices.size());
}

std::set<int> narrowPatches(const SurfaceEvaluator& surface, const Counts& counts) {
  return patchesWhere(surface, counts, [](const Cuts& cuts) { return cuts.pieces > 1; });
}

std::set<int> longPatches(const SurfaceEvaluator& surface, const Counts& counts) {
  return patchesWhere(surface, counts, [](const Cuts& cuts) {
    return cuts.pieces == 1 && cuts.ratio > kMaxUnevenness;
  });
}

double narrowPatchNodes(const SurfaceEvaluator& surface, const Counts& counts) {
  double nodes = 0.0;
  for (int patch = 0; patch < surface.patchCount(); ++patch) {
    const Cuts cuts = cutsOf(surface, patch, counts[patch]);
    if (cuts.pieces == 1.0) continue;
    // Nodes on every long line, and on the graded rows beside the patch.
    const double lines = counts[patch][1 - cuts.direction] + 1.0;
    nodes += (lines + kGradingLines) * counts[patch][cuts.direction] * (cuts.pieces - 1.0);
  }
  return nodes;
}

}  // namespace palpa::modeling

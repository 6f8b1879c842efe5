#include "modeling/solid/solid_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/disjoint_sets.h"
#include "base/text.h"
#include "modeling/error.h"
#include "modeling/solid/basis.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

constexpr double kMaxCoordinate = 1e7;   // mm; larger values indicate a wrong unit
constexpr double kKnotTolerance = 1e-9;  // of the knot range, for comparing the knots of two sides

std::string patchPath(std::size_t patch) {
  return "solid.patches[" + std::to_string(patch) + "]";
}

std::string quotedPatch(const std::vector<Patch>& patches, int patch) {
  return patchPath(patch) + " (\"" + patches[patch].name + "\")";
}

std::string sidePath(const std::vector<Patch>& patches, PatchEdge edge) {
  return "the " + std::string(sideName(edge.side)) + " edge of " + quotedPatch(patches, edge.patch);
}

void checkNet(const Patch& patch, const std::string& path, std::size_t pointCount) {
  const std::size_t rows = patch.net.size();
  if (rows < static_cast<std::size_t>(patch.degree[0]) + 1)
    throw ModelingError(path + ".net: " + std::to_string(rows) + " rows, but degree " +
                        std::to_string(patch.degree[0]) + " in u needs at least " +
                        std::to_string(patch.degree[0] + 1));
  const std::size_t columns = patch.net.front().size();
  for (std::size_t i = 0; i < rows; ++i) {
    const std::string rowPath = path + ".net[" + std::to_string(i) + "]";
    if (patch.net[i].size() != columns)
      throw ModelingError(rowPath + ": " + std::to_string(patch.net[i].size()) +
                          " indices, but the first row has " + std::to_string(columns));
    for (std::size_t j = 0; j < columns; ++j) {
      const int index = patch.net[i][j];
      if (index < 0 || static_cast<std::size_t>(index) >= pointCount)
        throw ModelingError(rowPath + "[" + std::to_string(j) + "]: index " +
                            std::to_string(index) + " is out of range; there are " +
                            std::to_string(pointCount) + " control points (0 … " +
                            std::to_string(static_cast<long long>(pointCount) - 1) + ")");
    }
  }
  if (columns < static_cast<std::size_t>(patch.degree[1]) + 1)
    throw ModelingError(path + ".net[0]: " + std::to_string(columns) + " indices, but degree " +
                        std::to_string(patch.degree[1]) + " in v needs at least " +
                        std::to_string(patch.degree[1] + 1));
}

void checkKnots(const std::vector<double>& knots, int degree, std::size_t points,
                const std::string& path) {
  const std::size_t expected = points + degree + 1;
  if (knots.size() != expected)
    throw ModelingError(path + ": " + std::to_string(knots.size()) + " knots, but " +
                        std::to_string(points) + " control points of degree " +
                        std::to_string(degree) + " need " + std::to_string(expected));
  const auto fail = [&](std::size_t i, const std::string& what) {
    throw ModelingError(path + "[" + std::to_string(i) + "]: " + numberText(knots[i]) + what);
  };
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i])) fail(i, " is not a finite number");
    if (i > 0 && knots[i] < knots[i - 1])
      fail(i, " is smaller than the knot before it (" + numberText(knots[i - 1]) + ")");
  }
  const std::size_t last = knots.size() - 1;
  if (!(knots[last] > knots[0])) fail(last, " equals the first knot; the range must not be empty");
  const auto order = static_cast<std::size_t>(degree) + 1;
  for (std::size_t i = 1; i < order; ++i) {
    if (knots[i] != knots[0])
      fail(i, " differs from the first knot; the first " + std::to_string(order) +
                  " knots must be equal (clamped) for degree " + std::to_string(degree));
    if (knots[last - i] != knots[last])
      fail(last - i, " differs from the last knot; the last " + std::to_string(order) +
                         " knots must be equal (clamped) for degree " + std::to_string(degree));
  }
  // Interior knots: more than `degree` equal knots would disconnect the surface.
  for (std::size_t i = 0, run = 0; i <= last; ++i) {
    run = i > 0 && knots[i] == knots[i - 1] ? run + 1 : 1;
    const bool atEnds = knots[i] == knots[0] || knots[i] == knots[last];
    const std::size_t allowed = atEnds ? order : static_cast<std::size_t>(degree);
    if (run > allowed)
      fail(i, " occurs more than " + std::to_string(allowed) + " times; degree " +
                  std::to_string(degree) + " allows no more here");
  }
}

/// True if two knot vectors agree after mapping both to [0, 1] (and reversing the second if
/// `reversed`).
bool knotsAgree(const std::vector<double>& a, const std::vector<double>& b, bool reversed) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double s = (a[i] - a.front()) / (a.back() - a.front());
    const double raw = b[reversed ? b.size() - 1 - i : i];
    const double t = (raw - b.front()) / (b.back() - b.front());
    if (std::abs(s - (reversed ? 1.0 - t : t)) > kKnotTolerance) return false;
  }
  return true;
}

SolidEdge glue(const std::vector<Patch>& patches, PatchEdge first, PatchEdge second,
               bool reversed) {
  const int d0 = directionOf(first.side);
  const int d1 = directionOf(second.side);
  const Patch& a = patches[first.patch];
  const Patch& b = patches[second.patch];
  if (a.degree[d0] != b.degree[d1])
    throw ModelingError(quotedPatch(patches, second.patch) + ".degree[" + std::to_string(d1) +
                        "]: " + std::to_string(b.degree[d1]) + ", but " + sidePath(patches, first) +
                        " shares these points with degree " + std::to_string(a.degree[d0]));
  if (!knotsAgree(a.knots[d0], b.knots[d1], reversed))
    throw ModelingError(patchPath(second.patch) + ".knots[" + std::to_string(d1) +
                        "]: differ from the knots along " + sidePath(patches, first) +
                        ", with which it shares an edge");
  if ((isForward(first.side) == isForward(second.side)) != reversed)
    throw ModelingError(quotedPatch(patches, second.patch) +
                        ": its normal is opposite to the normal of its neighbour " +
                        quotedPatch(patches, first.patch) + "; exchange u and v in one of the two");
  const std::vector<int> indices = sideIndices(a, first.side);
  return {{first, second}, reversed, false, {indices.front(), indices.back()}};
}

}  // namespace

void checkPoints(const std::vector<Eigen::Vector3d>& points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double value = points[i][axis];
      if (std::isfinite(value) && std::abs(value) <= kMaxCoordinate) continue;
      throw ModelingError("solid.control_points_mm[" + std::to_string(i) + "][" +
                          std::to_string(axis) + "]: " + numberText(value) +
                          " is not a finite number within ±" + numberText(kMaxCoordinate) + " mm");
    }
}

void checkPatches(const std::vector<Eigen::Vector3d>& points, const std::vector<Patch>& patches) {
  checkPoints(points);
  if (patches.empty()) throw ModelingError("solid.patches: is empty; a solid needs patches");
  std::set<std::string> names;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Patch& patch = patches[i];
    const std::string path = patchPath(i);
    if (patch.name.empty()) throw ModelingError(path + ".name: is empty");
    if (!names.insert(patch.name).second)
      throw ModelingError(path + ".name: \"" + patch.name + "\" is already the name of a patch");
    for (int direction = 0; direction < 2; ++direction)
      if (patch.degree[direction] < 1 || patch.degree[direction] > kMaxDegree)
        throw ModelingError(path + ".degree[" + std::to_string(direction) +
                            "]: " + std::to_string(patch.degree[direction]) + " is outside 1 … " +
                            std::to_string(kMaxDegree));
    checkNet(patch, path, points.size());
    checkKnots(patch.knots[0], patch.degree[0], patch.net.size(), path + ".knots[0]");
    checkKnots(patch.knots[1], patch.degree[1], patch.net.front().size(), path + ".knots[1]");
  }
}

std::vector<int> sideIndices(const Patch& patch, Side side) {
  if (side == Side::kUMin) return patch.net.front();
  if (side == Side::kUMax) return patch.net.back();
  std::vector<int> indices;
  for (const auto& row : patch.net)
    indices.push_back(side == Side::kVMin ? row.front() : row.back());
  return indices;
}

std::vector<SolidEdge> glueSides(const std::vector<Patch>& patches) {
  struct Use {
    PatchEdge edge;
    bool turned;  // the key lists the points against the growing parameter
  };
  std::map<std::vector<int>, std::vector<Use>> uses;
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (Side side : kSides) {
      const PatchEdge edge{static_cast<int>(p), side};
      std::vector<int> key = sideIndices(patches[p], side);
      if (key.front() == key.back())
        throw ModelingError(
            sidePath(patches, edge) + ": starts and ends in the same control point (" +
            std::to_string(key.front()) + "); closed and collapsed edges are not supported");
      std::vector<int> turned(key.rbegin(), key.rend());
      const bool useTurned = turned < key;
      auto& list = uses[useTurned ? turned : key];
      if (list.size() == 2)
        throw ModelingError(sidePath(patches, edge) + ": its points are already shared by " +
                            sidePath(patches, list[0].edge) + " and " +
                            sidePath(patches, list[1].edge) +
                            "; an edge joins exactly two patches");
      list.push_back({edge, useTurned});
    }

  // In patch order instead of key order, so that edges are numbered predictably.
  std::vector<SolidEdge> edges;
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (Side side : kSides) {
      std::vector<int> key = sideIndices(patches[p], side);
      std::vector<int> turned(key.rbegin(), key.rend());
      const auto& list = uses.at(std::min(key, turned));
      if (list.size() == 1)
        throw ModelingError(sidePath(patches, list[0].edge) + " (control points " +
                            std::to_string(key.front()) + " to " + std::to_string(key.back()) +
                            "): no other patch shares these points; a solid must be closed");
      if (list[0].edge.patch != static_cast<int>(p) || list[0].edge.side != side) continue;
      edges.push_back(glue(patches, list[0].edge, list[1].edge, list[0].turned != list[1].turned));
    }
  return edges;
}

void checkVertexFans(const std::vector<Patch>& patches, const std::vector<SolidEdge>& edges) {
  // The patch corners that use one control point, joined over the glued sides, must form one group.
  // Corner c of a patch lies between side c - 1 and side c (counter-clockwise).
  const auto cornerAtEnd = [](Side side, bool end) {
    const int index = static_cast<int>(side);
    return end == isForward(side) ? (index + 1) % 4 : index;
  };
  DisjointSets corners(patches.size() * 4);
  for (const SolidEdge& edge : edges)
    for (bool end : {false, true}) {
      const int a = edge.uses[0].patch * 4 + cornerAtEnd(edge.uses[0].side, end);
      const int b = edge.uses[1].patch * 4 + cornerAtEnd(edge.uses[1].side, end != edge.reversed);
      corners.join(a, b);
    }
  std::map<int, int> groupOfVertex;
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (Side side : kSides) {
      const std::vector<int> indices = sideIndices(patches[p], side);
      for (bool end : {false, true}) {
        const int vertex = end ? indices.back() : indices.front();
        const int group = corners.rootOf(static_cast<int>(p) * 4 + cornerAtEnd(side, end));
        const auto [found, added] = groupOfVertex.emplace(vertex, group);
        if (!added && found->second != group)
          throw ModelingError("solid.control_points_mm[" + std::to_string(vertex) +
                              "]: two separate fans of patches touch in this corner (one holds " +
                              quotedPatch(patches, static_cast<int>(p)) +
                              "); a solid must not touch itself in a point");
      }
    }
}

void checkOutward(const std::vector<Eigen::Vector3d>& points, const std::vector<Patch>& patches) {
  const double enclosed = volume(points, patches);
  if (enclosed > 0.0) return;
  throw ModelingError("solid.patches: the enclosed volume is " + numberText(enclosed) +
                      " mm³; the normals du × dv must point outwards (exchange u and v in every "
                      "patch to turn the solid inside out)");
}

}  // namespace palpa::modeling

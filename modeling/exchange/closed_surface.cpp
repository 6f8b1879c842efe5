#include "modeling/exchange/closed_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>

#include "base/text.h"
#include "modeling/body/smooth_regions.h"
#include "modeling/error.h"
#include "modeling/exchange/mesh_reader.h"
#include "modeling/exchange/polygon_triangulation.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<int, 3>;

constexpr double kMaxCoordinate = 1e7;  // mm, as for control points
constexpr double kWeld = 1e-6;          // of the body's size

std::string countText(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

void scalePoints(const PolygonSoup& soup, double scale, ClosedSurface& surface) {
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    const Vector3d point = scale * soup.points[i] + Vector3d::Zero();  // no negative zeros
    if (!point.allFinite() || point.cwiseAbs().maxCoeff() > kMaxCoordinate)
      throw ModelingError("point " + std::to_string(i + 1) + " at " + placeText(point) +
                          " is farther than " + numberText(kMaxCoordinate) +
                          " mm from the origin; check the unit");
    surface.positions.push_back(point);
  }
}

/// For each point, the first point at exactly the same place.
std::vector<int> firstAtSamePlace(const std::vector<Vector3d>& points) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) { return std::tie(points[i].x(), points[i].y(), points[i].z()); };
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  std::vector<int> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
  return first;
}

void cutPolygons(const PolygonSoup& soup, ClosedSurface& surface, const Job& job) {
  for (int i = 0; i < soup.polygonCount(); ++i) {
    if (i % 4096 == 0) job.throwIfCancelled();
    for (const Triangle& triangle : triangulatePolygon(surface.positions, soup.polygon(i))) {
      surface.triangles.push_back(triangle);
      if (!soup.groups.empty()) surface.groups.push_back(soup.groups[i]);
    }
  }
}

/// Replaces the corners, then removes triangles with equal corners and duplicates.
void joinCorners(ClosedSurface& surface, const std::vector<int>& replacement) {
  struct Entry {
    Triangle sorted;
    int index;
    bool operator<(const Entry& other) const {
      return std::tie(sorted, index) < std::tie(other.sorted, other.index);
    }
  };
  std::vector<Entry> entries;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    Triangle n = surface.triangles[t];
    for (int& corner : n) corner = replacement[corner];
    surface.triangles[t] = n;
    std::sort(n.begin(), n.end());
    if (n[0] != n[1] && n[1] != n[2]) entries.push_back({n, static_cast<int>(t)});
  }
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end(),
                            [](const Entry& a, const Entry& b) { return a.sorted == b.sorted; }),
                entries.end());
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.index < b.index; });
  for (std::size_t i = 0; i < entries.size(); ++i) {
    surface.triangles[i] = surface.triangles[entries[i].index];
    if (!surface.groups.empty()) surface.groups[i] = surface.groups[entries[i].index];
  }
  surface.triangles.resize(entries.size());
  if (!surface.groups.empty()) surface.groups.resize(entries.size());
}

/// Edges without exactly two triangles.
struct WrongEdges {
  std::vector<std::pair<int, int>> open;
  std::vector<std::pair<int, int>> crowded;
};

WrongEdges wrongEdges(const ClosedSurface& surface) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(3 * surface.triangles.size());
  for (const Triangle& n : surface.triangles)
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax({n[k], n[(k + 1) % 3]}));
  std::sort(edges.begin(), edges.end());
  WrongEdges wrong;
  for (std::size_t i = 0; i < edges.size();) {
    const std::size_t begin = i;
    while (i < edges.size() && edges[i] == edges[begin]) ++i;
    if (i - begin == 1) wrong.open.push_back(edges[begin]);
    if (i - begin > 2) wrong.crowded.push_back(edges[begin]);
  }
  return wrong;
}

/// Joins the ends of open edges that nearly meet, because some programs write the same corner with
/// different rounding. Points in one cell of a grid with the tolerance as cell width, and the first
/// points of neighbouring cells, are merged.
void weld(ClosedSurface& surface, const std::vector<std::pair<int, int>>& open) {
  Vector3d low = surface.positions[open.front().first];
  Vector3d high = low;
  for (const Vector3d& p : surface.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double tolerance = kWeld * (high - low).norm();
  std::set<int> ends;
  for (const auto& [a, b] : open) ends.insert({a, b});
  std::vector<int> replacement(surface.positions.size());
  std::iota(replacement.begin(), replacement.end(), 0);
  std::map<std::array<long, 3>, int> cells;
  for (int end : ends) {
    const Vector3d& p = surface.positions[end];
    std::array<long, 3> cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] = std::lround(std::floor((p[axis] - low[axis]) / tolerance));
    int partner = -1;
    for (int i = 0; i < 27 && partner < 0; ++i) {
      const std::array<long, 3> near{cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1,
                                     cell[2] + i / 9 - 1};
      const auto found = cells.find(near);
      if (found != cells.end() && (surface.positions[found->second] - p).norm() <= tolerance)
        partner = found->second;
    }
    if (partner < 0)
      cells.try_emplace(cell, end);
    else
      replacement[end] = partner;
  }
  joinCorners(surface, replacement);
}

std::string edgeText(const ClosedSurface& surface, const std::pair<int, int>& edge) {
  return "between " + placeText(surface.positions[edge.first]) + " and " +
         placeText(surface.positions[edge.second]);
}

void checkEdges(const ClosedSurface& surface, const WrongEdges& wrong) {
  if (!wrong.crowded.empty())
    throw ModelingError(
        countText(wrong.crowded.size(), "edge has", "edges have") +
        " more than two triangles, the first " + edgeText(surface, wrong.crowded.front()) +
        "; bodies that touch along an edge and inner walls are not possible: separate or remove "
        "them");
  if (!wrong.open.empty())
    throw ModelingError(countText(wrong.open.size(), "open edge", "open edges") + ", the first " +
                        edgeText(surface, wrong.open.front()) + "; close the surface");
}

/// Orients the triangles consistently with their neighbours. The number of connected parts is
/// limited, because their nesting is found by comparing all pairs.
void orient(ClosedSurface& surface) {
  const auto neighbours = triangleNeighbours(surface.triangles);
  std::vector<bool> reached(surface.triangles.size(), false);
  std::vector<int> open;
  const auto uses = [&](int t, int a, int b) {
    const Triangle& n = surface.triangles[t];
    for (int k = 0; k < 3; ++k)
      if (n[k] == a && n[(k + 1) % 3] == b) return true;
    return false;
  };
  int parts = 0;
  for (std::size_t seed = 0; seed < reached.size(); ++seed) {
    if (reached[seed]) continue;
    if (++parts > kMaxMeshShells)
      throw ModelingError(
          "consists of more than " + std::to_string(kMaxMeshShells) +
          " closed surfaces; a project has one body with its cavities: export one body");
    reached[seed] = true;
    open.push_back(static_cast<int>(seed));
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (int other : neighbours[t]) {
        // The only common edge: two triangles with two common edges would be duplicates.
        const Triangle& n = surface.triangles[t];
        int a = -1;
        int b = -1;
        for (int k = 0; k < 3; ++k)
          if (uses(other, n[k], n[(k + 1) % 3]) || uses(other, n[(k + 1) % 3], n[k])) {
            a = n[k];
            b = n[(k + 1) % 3];
          }
        const bool agrees = uses(other, b, a);
        if (!reached[other]) {
          if (!agrees) std::swap(surface.triangles[other][1], surface.triangles[other][2]);
          reached[other] = true;
          open.push_back(other);
        } else if (!agrees) {
          throw ModelingError(
              "the surface has one side only (like a Klein bottle); inside and "
              "outside cannot be distinguished at the edge " +
              edgeText(surface, {a, b}) + "; repair the surface there");
        }
      }
    }
  }
}

/// Throws ModelingError if the triangles around a vertex do not form one fan.
void checkFans(const ClosedSurface& surface) {
  const auto neighbours = triangleNeighbours(surface.triangles);
  std::vector<int> valence(surface.positions.size(), 0);
  std::vector<int> start(surface.positions.size(), -1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int corner : surface.triangles[t]) {
      ++valence[corner];
      start[corner] = static_cast<int>(t);
    }
  std::vector<int> touching;
  for (std::size_t v = 0; v < start.size(); ++v) {
    const int vertex = static_cast<int>(v);
    int turned = 0;
    int t = start[v];
    do {
      const Triangle& n = surface.triangles[t];
      const auto k = std::find(n.begin(), n.end(), vertex) - n.begin();
      // The neighbours were determined before the triangles were oriented, but are valid here.
      t = neighbours[t][k];
      ++turned;
    } while (t != start[v]);
    if (turned != valence[v]) touching.push_back(vertex);
  }
  if (!touching.empty())
    throw ModelingError("parts of the surface touch in " +
                        countText(touching.size(), "single vertex", "single vertices") +
                        ", the first at " + placeText(surface.positions[touching.front()]) +
                        "; separate them or join them along a face");
}

void dropUnusedPoints(ClosedSurface& surface) {
  std::vector<int> number(surface.positions.size(), -1);
  std::vector<Vector3d> used;
  for (Triangle& n : surface.triangles)
    for (int& corner : n) {
      if (number[corner] < 0) {
        number[corner] = static_cast<int>(used.size());
        used.push_back(surface.positions[corner]);
      }
      corner = number[corner];
    }
  surface.positions = std::move(used);
}

}  // namespace

void PolygonSoup::closePolygon() {
  constexpr std::size_t kMaxCorners = 4 * static_cast<std::size_t>(kMaxMeshTriangles);
  if (polygonCount() >= kMaxMeshTriangles || corners.size() > kMaxCorners)
    throw ModelingError("has more than " + std::to_string(kMaxMeshTriangles) +
                            " triangles; reduce their number in the program of origin",
                        ModelingError::Kind::kTooLarge);
  ends.push_back(static_cast<int>(corners.size()));
}

ClosedSurface closeSurface(const PolygonSoup& soup, double scale, const Job& job) {
  if (soup.polygonCount() == 0)
    throw ModelingError(
        "contains no triangles, only points or lines, or nothing; export a surface");
  ClosedSurface surface;
  scalePoints(soup, scale, surface);
  cutPolygons(soup, surface, job);
  job.throwIfCancelled();
  joinCorners(surface, firstAtSamePlace(surface.positions));
  if (surface.triangles.empty())
    throw ModelingError("all of its triangles are without extent; export a closed surface");
  job.throwIfCancelled();
  WrongEdges wrong = wrongEdges(surface);
  if (!wrong.open.empty()) {
    weld(surface, wrong.open);
    wrong = wrongEdges(surface);
  }
  checkEdges(surface, wrong);
  if (surface.triangles.empty())
    throw ModelingError("all of its triangles are without extent; export a closed surface");
  dropUnusedPoints(surface);
  job.throwIfCancelled();
  orient(surface);
  checkFans(surface);
  return surface;
}

void keepBody(ClosedSurface& surface, int body) {
  if (surface.bodies.empty()) return;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.bodies[t] != body) continue;
    surface.triangles[kept] = surface.triangles[t];
    if (!surface.groups.empty()) surface.groups[kept] = surface.groups[t];
    ++kept;
  }
  surface.triangles.resize(kept);
  if (!surface.groups.empty()) surface.groups.resize(kept);
  surface.bodies.clear();
  dropUnusedPoints(surface);
}

}  // namespace palpa::modeling

#include "modeling/body/smooth_regions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Neighbours = std::span<const std::array<int, 3>>;

constexpr double kThin = 1e-3;  // height over longest edge below which a normal is unreliable

struct Shape {
  Vector3d normal;  ///< unit; zero for a triangle without area
  double area;
  int longest;  ///< edge
  double thinness;
};

Shape shapeOf(const std::vector<Vector3d>& p, const std::array<int, 3>& n) {
  Shape shape{(p[n[1]] - p[n[0]]).cross(p[n[2]] - p[n[0]]), 0.0, 0, 0.0};
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double length = (p[n[(k + 1) % 3]] - p[n[k]]).norm();
    if (length > longest) {
      longest = length;
      shape.longest = k;
    }
  }
  const double twice = shape.normal.norm();
  shape.area = 0.5 * twice;
  shape.thinness = longest > 0.0 ? twice / (longest * longest) : 0.0;
  shape.normal = twice > 0.0 ? Vector3d(shape.normal / twice) : Vector3d::Zero();
  return shape;
}

/// Merges small regions into their neighbours, smallest first.
class Merging {
 public:
  Merging(std::vector<double> areas, std::map<std::pair<int, int>, double> borders)
      : area_(std::move(areas)), parent_(area_.size()), borders_(area_.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (const auto& [pair, length] : borders) {
      borders_[pair.first][pair.second] += length;
      borders_[pair.second][pair.first] += length;
    }
  }

  void run(double minArea, int maxCount) {
    std::set<std::pair<double, int>> order;
    for (std::size_t r = 0; r < area_.size(); ++r) order.emplace(area_[r], static_cast<int>(r));
    while (!order.empty()) {
      const auto [area, region] = *order.begin();
      if (area >= minArea && static_cast<int>(order.size()) <= maxCount) return;
      order.erase(order.begin());
      if (borders_[region].empty()) {  // a separate shell remains a region
        --maxCount;
        continue;
      }
      int into = -1;
      double longest = -1.0;
      for (const auto& [other, length] : borders_[region])
        if (length > longest) {
          longest = length;
          into = other;
        }
      order.erase({area_[into], into});
      join(region, into);
      order.emplace(area_[into], into);
    }
  }

  int find(int region) {
    while (parent_[region] != region) region = parent_[region] = parent_[parent_[region]];
    return region;
  }

  const std::vector<double>& areas() const { return area_; }

 private:
  void join(int region, int into) {
    parent_[region] = into;
    area_[into] += area_[region];
    for (const auto& [other, length] : borders_[region]) {
      borders_[other].erase(region);
      if (other == into) continue;
      borders_[other][into] += length;
      borders_[into][other] += length;
    }
    borders_[region].clear();
  }

  std::vector<double> area_;
  std::vector<int> parent_;
  std::vector<std::map<int, double>> borders_;  // neighbour -> length of the common border
};

/// Numbers the parts of the surface that are connected without crossing sharp edges.
std::vector<int> connectedParts(const std::vector<Vector3d>& normals, Neighbours neighbours) {
  const double cosine = std::cos(kSharpEdgeDegrees * std::numbers::pi / 180.0);
  std::vector<int> part(normals.size(), -1);
  std::vector<int> open;
  int count = 0;
  for (std::size_t seed = 0; seed < part.size(); ++seed) {
    if (part[seed] >= 0) continue;
    part[seed] = count;
    open.push_back(static_cast<int>(seed));
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (int other : neighbours[t])
        if (part[other] < 0 && normals[t].dot(normals[other]) > cosine) {
          part[other] = count;
          open.push_back(other);
        }
    }
    ++count;
  }
  return part;
}

}  // namespace

std::vector<std::array<int, 3>> triangleNeighbours(const Triangles& triangles) {
  struct Use {
    int low, high, triangle, edge;
  };
  std::vector<Use> uses;
  uses.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
      uses.push_back({low, high, static_cast<int>(t), k});
    }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return std::tie(a.low, a.high, a.triangle, a.edge) <
           std::tie(b.low, b.high, b.triangle, b.edge);
  });
  std::vector<std::array<int, 3>> neighbours(triangles.size(), {-1, -1, -1});
  for (std::size_t i = 0; i + 1 < uses.size(); i += 2) {
    neighbours[uses[i].triangle][uses[i].edge] = uses[i + 1].triangle;
    neighbours[uses[i + 1].triangle][uses[i + 1].edge] = uses[i].triangle;
  }
  return neighbours;
}

std::vector<int> reliableTriangles(const std::vector<Vector3d>& positions,
                                   const Triangles& triangles, Neighbours neighbours) {
  std::vector<int> source(triangles.size());
  std::iota(source.begin(), source.end(), 0);
  std::vector<std::pair<double, int>> thin;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const double thinness = shapeOf(positions, triangles[t]).thinness;
    if (thinness < kThin) thin.emplace_back(-thinness, static_cast<int>(t));
  }
  // The least thin first, so that in a stack of slivers the region spreads inwards.
  std::sort(thin.begin(), thin.end());
  for (const auto& [thinness, t] : thin)
    source[t] = source[neighbours[t][shapeOf(positions, triangles[t]).longest]];
  return source;
}

std::vector<int> smoothRegions(const std::vector<Vector3d>& positions, const Triangles& triangles,
                               double minArea, int maxCount) {
  const auto neighbours = triangleNeighbours(triangles);
  std::vector<Vector3d> normals;
  for (int t : reliableTriangles(positions, triangles, neighbours))
    normals.push_back(shapeOf(positions, triangles[t]).normal);
  std::vector<int> part = connectedParts(normals, neighbours);
  const int count = *std::max_element(part.begin(), part.end()) + 1;
  std::vector<double> areas(count, 0.0);
  std::map<std::pair<int, int>, double> borders;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    areas[part[t]] += shapeOf(positions, triangles[t]).area;
    for (int k = 0; k < 3; ++k) {
      const int other = part[neighbours[t][k]];
      if (part[t] < other)
        borders[{part[t], other}] +=
            (positions[triangles[t][k]] - positions[triangles[t][(k + 1) % 3]]).norm();
    }
  }
  Merging merging(areas, std::move(borders));
  merging.run(minArea, maxCount);
  std::vector<int> order;
  for (int r = 0; r < count; ++r)
    if (merging.find(r) == r) order.push_back(r);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return merging.areas()[a] > merging.areas()[b]; });
  std::vector<int> number(count, -1);
  for (std::size_t i = 0; i < order.size(); ++i) number[order[i]] = static_cast<int>(i);
  for (int& p : part) p = number[merging.find(p)];
  return part;
}

}  // namespace palpa::modeling

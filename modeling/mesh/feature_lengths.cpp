#include "modeling/mesh/feature_lengths.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "modeling/body/smooth_regions.h"
#include "modeling/mesh/nearest_point.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr double kOfRadius =
    0.3;                        // shortest edge on a curved surface: edges turn by 17 to 35 degrees
constexpr double kFlat = 1e-9;  // 1 - cosine below which two triangles lie in one plane
const double kSharpCosine = std::cos(kSharpEdgeDegrees * std::numbers::pi / 180.0);

/// Lengths that keep the thickness of walls: collapsed edges across their rims would make them
/// knives.
void keepWalls(const FacedTriangles& body, std::vector<double>& lengths, const Job& job) {
  constexpr std::size_t kCheckpoint = 1000;  // triangles between checks of the stop token
  constexpr double kOfThickness = 0.8, kTowardsCorner = 0.8;
  const auto& p = body.positions;
  const NearestOnTriangles walls(p, body.triangles);
  for (std::size_t t = 0; t < body.triangles.size(); ++t) {
    if (t % kCheckpoint == 0) job.throwIfCancelled();
    const auto& triangle = body.triangles[t];
    const Vector3d middle = (p[triangle[0]] + p[triangle[1]] + p[triangle[2]]) / 3;
    const Vector3d inward =
        (p[triangle[2]] - p[triangle[0]]).cross(p[triangle[1]] - p[triangle[0]]).normalized();
    const auto thickness = [&](const Vector3d& x) {
      return walls.distanceAlong(x, inward, static_cast<int>(t));
    };
    const double atMiddle = thickness(middle);
    for (const int corner : triangle) {
      const double atCorner = thickness(middle + kTowardsCorner * (p[corner] - middle));
      lengths[corner] = std::min(lengths[corner], kOfThickness * std::min(atMiddle, atCorner));
    }
  }
}

/// The smallest lengths at the vertices, also of the edges there: less on curved surfaces whose
/// radius is not small itself.
std::vector<double> lengthsOf(const FacedTriangles& body, const LengthAt& smallest) {
  constexpr double kMaxSamples = 32;
  std::vector<double> atVertices;
  for (const Vector3d& p : body.positions) atVertices.push_back(smallest(p));
  std::vector<double> lengths = atVertices;
  for (const auto& triangle : body.triangles)
    for (int k = 0; k < 3; ++k) {
      const int from = triangle[k], to = triangle[(k + 1) % 3];
      if (from > to) continue;
      const Vector3d& a = body.positions[from];
      const Vector3d along = body.positions[to] - a;
      const double count = std::min(
          std::floor(along.norm() / std::min(atVertices[from], atVertices[to])), kMaxSamples);
      for (int i = 1; i < count; ++i) {
        const double inside = smallest(a + i / count * along);
        for (const int end : {from, to}) lengths[end] = std::min(lengths[end], inside);
      }
    }
  std::vector<double> result = lengths;
  const auto& p = body.positions;
  const auto neighbours = triangleNeighbours(body.triangles);
  const auto areaVector = [&](int t) {
    const auto& [a, b, c] = body.triangles[t];
    return Vector3d((p[b] - p[a]).cross(p[c] - p[a]));
  };
  for (std::size_t t = 0; t < body.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int other = neighbours[t][k];
      if (other < static_cast<int>(t)) continue;
      const Vector3d one = areaVector(static_cast<int>(t)), two = areaVector(other);
      const double cosine = one.normalized().dot(two.normalized());
      if (cosine < kSharpCosine || cosine > 1 - kFlat) continue;
      const int a = body.triangles[t][k], b = body.triangles[t][(k + 1) % 3];
      const double width = (one.norm() + two.norm()) / (2 * (p[a] - p[b]).norm());
      const double radius = width / std::acos(cosine);
      for (const int end : {a, b})
        if (radius >= lengths[end]) result[end] = std::min(result[end], kOfRadius * radius);
    }
  return result;
}

}  // namespace

std::vector<double> featureLengths(const FacedTriangles& body, const LengthAt& smallest,
                                   const Job& job) {
  std::vector<double> lengths = lengthsOf(body, smallest);
  keepWalls(body, lengths, job);
  return lengths;
}

}  // namespace palpa::modeling

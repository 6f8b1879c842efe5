#include "app/core/page/page_surface.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "base/count_text.h"
#include "bem/base/error.h"

namespace palpa::app {

using Eigen::Index;
using Eigen::Vector3d;

namespace {

/// Vertices of a drawn surface that is fine enough on every screen, and that costs little time.
constexpr std::size_t kMaxVertices = 4000;
/// Strong bends add up to this part.
constexpr double kMaxBentShare = 0.5;
/// Pieces of an edge at a strong bend, and the angle by which a piece turns. Drawn points are
/// beside the surface; where that is far for its radius of curvature, the nearest places of
/// neighbouring points are far apart, and so are their compliances.
constexpr int kMaxBentPieces = 8;
constexpr double kPieceAngle = std::numbers::pi / 12;
/// Edges are numbered with 16 bits, and a closed surface has three for each vertex.
constexpr std::size_t kMaxNumbered = std::numeric_limits<std::uint16_t>::max() / 4;

}  // namespace

PageSurface::PageSurface(const TouchableModel& model, const Job& job) : model_(model) {
  constexpr int kMaxPieces = 3;
  const auto draw = [&](int least, int most, double angle) {
    return std::make_unique<DrawnBody>(model.sharedModel(),
                                       modeling::DisplaySettings{least, most, angle}, job);
  };
  atNodes_ = draw(1, 1, kPieceAngle);
  const auto verticesFor = [&](int pieces) {
    return nodeCount() * static_cast<std::size_t>(pieces * pieces);
  };
  int pieces = kMaxPieces;
  while (pieces > 1 && verticesFor(pieces) > kMaxVertices) --pieces;
  const double most = std::min(
      (1 + kMaxBentShare) * static_cast<double>(std::max(kMaxVertices, verticesFor(pieces))),
      static_cast<double>(kMaxNumbered));
  // At the end no edge turns by more, and all have the same number of pieces.
  for (double angle = kPieceAngle; angle < 4 * std::numbers::pi; angle *= 1.5) {
    drawn_ = draw(pieces, kMaxBentPieces, angle);
    if (static_cast<double>(vertexCount()) <= most) break;
  }
  if (vertexCount() > kMaxNumbered)
    throw bem::SolverError(bem::SolverError::Kind::kTooLarge,
                           "the model has " + countText(static_cast<double>(nodeCount())) +
                               " nodes; a page that can be touched has at most " +
                               countText(static_cast<double>(kMaxNumbered)) +
                               ". Mesh the body with longer edges");
  findEdges();
}

void PageSurface::findEdges() {
  std::map<std::pair<int, int>, std::uint16_t> known;
  const auto& triangles = drawn_->mesh().triangles;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<std::uint16_t, 3> ofTriangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto ends = std::minmax(triangles[t][(k + 1) % 3], triangles[t][(k + 2) % 3]);
      const auto [found, isNew] =
          known.try_emplace({ends.first, ends.second}, static_cast<std::uint16_t>(known.size()));
      ofTriangle[k] = found->second;
      if (!isNew) continue;
      Vector3d middle = Vector3d::Constant(0.5);
      middle[static_cast<Index>(k)] = 0;
      edgeMiddles_.push_back({static_cast<int>(t), middle});
    }
    edges_.push_back(ofTriangle);
  }
}

void PageSurface::describe(TouchPage& page) const {
  const modeling::DisplayMesh& mesh = drawn_->mesh();
  for (std::size_t v = 0; v < vertexCount(); ++v) {
    page.positions.push_back(mesh.positions[v].cast<float>());
    page.normals.push_back(mesh.normals[v].cast<float>());
  }
  for (const auto& [a, b, c] : mesh.triangles)
    page.triangles.push_back({static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b),
                              static_cast<std::uint16_t>(c)});
  for (const bool isSupported : drawn_->isSupported()) page.isTouchable.push_back(!isSupported);
  page.edges = edges_;
  linkToNodes(page);
}

void PageSurface::linkToNodes(TouchPage& page) const {
  const modeling::DisplayMesh& nodes = atNodes_->mesh();
  for (const auto& link : drawn_->mesh().links) {
    // With one piece per edge the triangles are the triangles of the boundary mesh.
    const auto& corners = nodes.triangles[static_cast<std::size_t>(link.triangle)];
    std::array<std::uint16_t, 3> linked{};
    std::array<float, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) {
      linked[k] = static_cast<std::uint16_t>(corners[k]);
      Index corner = 0;
      linkIn(nodes, link.triangle, corners[k]).maxCoeff(&corner);
      weights[k] = static_cast<float>(link.weights[corner]);
    }
    page.nodes.push_back(linked);
    page.nodeWeights.push_back(weights);
  }
  page.nodeCount = static_cast<int>(nodeCount());
}

bem::SurfacePoint PageSurface::at(const TouchPage::Point& point) const {
  const modeling::DisplayMesh& mesh = drawn_->mesh();
  const auto& corners = mesh.triangles[static_cast<std::size_t>(point.triangle)];
  Vector3d position = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    position +=
        point.weights[static_cast<Index>(k)] * mesh.positions[static_cast<std::size_t>(corners[k])];
  return model_.surface().nearest(position);
}

bem::SurfacePoint PageSurface::atVertex(std::size_t vertex) const {
  return model_.surface().nearest(drawn_->mesh().positions[vertex]);
}

Vector3d PageSurface::linkIn(const modeling::DisplayMesh& mesh, int boundaryTriangle,
                             int vertex) const {
  const auto& link = mesh.links[static_cast<std::size_t>(vertex)];
  if (link.triangle == boundaryTriangle) return link.weights;
  const auto& triangles = model_.model().surface().triangles;
  const auto& from = triangles[static_cast<std::size_t>(link.triangle)];
  const auto& to = triangles[static_cast<std::size_t>(boundaryTriangle)];
  Vector3d weights = Vector3d::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (from[i] == to[k]) weights[static_cast<Index>(k)] += link.weights[static_cast<Index>(i)];
  return weights / weights.sum();
}

Eigen::VectorXd PageSurface::fieldOf(const DrawnBody& body, const Eigen::VectorXd& u) {
  Eigen::VectorXd field(3 * static_cast<Index>(body.mesh().positions.size()));
  Index row = 0;
  for (const Vector3d& each : body.displacements(u)) {
    field.segment<3>(row) = each;
    row += 3;
  }
  return field;
}

}  // namespace palpa::app

#include "modeling/exchange/patch_weld.h"

#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/solid/solid_check.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Kind = QuadFace::Kind;

std::vector<Vector3d> sideRow(const Net& net, Side side) {
  if (side == Side::kUMin) return net.front();
  if (side == Side::kUMax) return net.back();
  std::vector<Vector3d> row;
  for (const auto& column : net)
    row.push_back(side == Side::kVMin ? column.front() : column.back());
  return row;
}

/// Builder of a solid from loose patches: one control point per vertex, one row per edge.
class Welder {
 public:
  Welder(const QuadFaces& quads, const KnotChains& chains, std::vector<LoosePatch> patches,
         double tolerance)
      : quads_(quads), chains_(chains), patches_(std::move(patches)), tolerance_(tolerance) {}

  Solid weld() {
    findRows();
    for (std::size_t f = 0; f < patches_.size(); ++f) assign(f);
    std::vector<Patch> patches;
    for (LoosePatch& loose : patches_) patches.push_back(std::move(loose.patch));
    return numbered(std::move(patches));
  }

 private:
  /// The solid with its control points in the order of the nets, as in the primitives.
  Solid numbered(std::vector<Patch> patches) const {
    std::vector<int> number(points_.size(), -1);
    std::vector<Vector3d> points;
    for (Patch& patch : patches)
      for (auto& column : patch.net)
        for (int& index : column) {
          int& fresh = number[index];
          if (fresh < 0) {
            fresh = static_cast<int>(points.size());
            points.push_back(points_[index]);
          }
          index = fresh;
        }
    return Solid(std::move(points), std::move(patches));
  }

  /// Side of a face at an edge. `row` runs along the edge and is empty for flat faces.
  struct Use {
    std::size_t face;
    Side side;
    std::vector<Vector3d> row;
  };

  void findRows() {
    const std::size_t edges = static_cast<std::size_t>(quads_.edges.Extent());
    std::vector<std::vector<Use>> uses(edges + 1);
    for (std::size_t f = 0; f < patches_.size(); ++f)
      for (Side side : kSides) {
        const auto& use = quads_.faces[f].sides[static_cast<std::size_t>(side)];
        std::vector<Vector3d> row;
        if (!patches_[f].net.empty()) row = sideRow(patches_[f].net, side);
        if (use.reversed) std::reverse(row.begin(), row.end());
        uses[static_cast<std::size_t>(use.edge)].push_back({f, side, std::move(row)});
      }
    rows_.resize(edges + 1);
    // Splines, then approximations, then straight lines: each uses the corners of the previous
    // ones.
    for (const Kind kind : {Kind::kSpline, Kind::kSmooth})
      for (std::size_t e = 1; e <= edges; ++e)
        for (const Use& use : uses[e])
          if (rows_[e].empty() && quads_.faces[use.face].kind == kind)
            rows_[e] = indices(static_cast<int>(e), use.row);
    for (std::size_t e = 1; e <= edges; ++e)
      if (rows_[e].empty() && !uses[e].empty())
        rows_[e] = straightRow(static_cast<int>(e), uses[e][0]);
    for (std::size_t e = 1; e <= edges; ++e)
      for (const Use& use : uses[e]) checkAgreement(uses[e], use, rows_[e]);
  }

  int vertexIndex(int edge, bool end, const Vector3d* position) {
    const TopoDS_Edge& shape = TopoDS::Edge(quads_.edges(edge));
    const TopoDS_Vertex vertex = end ? TopExp::LastVertex(shape) : TopExp::FirstVertex(shape);
    const int known = vertices_.Extent();
    const std::size_t found = static_cast<std::size_t>(vertices_.Add(vertex)) - 1;
    if (vertices_.Extent() > known) {
      pointOfVertex_.push_back(static_cast<int>(points_.size()));
      points_.push_back(position ? *position : toEigen(BRep_Tool::Pnt(vertex)));
    }
    return pointOfVertex_[found];
  }

  std::vector<int> indices(int edge, const std::vector<Vector3d>& row) {
    std::vector<int> result{vertexIndex(edge, false, &row.front())};
    for (std::size_t i = 1; i + 1 < row.size(); ++i) {
      result.push_back(static_cast<int>(points_.size()));
      points_.push_back(row[i]);
    }
    result.push_back(vertexIndex(edge, true, &row.back()));
    return result;
  }

  /// The row between two flat faces.
  std::vector<int> straightRow(int edge, const Use& use) {
    double first, last;
    const Handle(Geom_Curve) curve =
        BRep_Tool::Curve(TopoDS::Edge(quads_.edges(edge)), first, last);
    if (curve.IsNull()) throw NoPatches{"an edge has no curve"};
    const Vector3d a = points_[vertexIndex(edge, false, nullptr)];
    const Vector3d b = points_[vertexIndex(edge, true, nullptr)];
    const Vector3d along = (b - a).normalized();
    for (int i = 1; i < 8; ++i) {
      const Vector3d p = toEigen(curve->Value(first + (last - first) * i / 8)) - a;
      if ((p - p.dot(along) * along).norm() > tolerance_)
        throw NoPatches{"the faces \"" + quads_.faces[use.face].name +
                        "\" and its neighbour are flat and meet in a curve"};
    }
    const int direction = directionOf(use.side);
    std::vector<double> sites = chains_.of(static_cast<int>(use.face), direction).sites();
    if (quads_.faces[use.face].sides[static_cast<std::size_t>(use.side)].reversed) {
      std::reverse(sites.begin(), sites.end());
      for (double& site : sites) site = 1.0 - site;
    }
    std::vector<Vector3d> row;
    for (const double site : sites) row.push_back((1.0 - site) * a + site * b);
    return indices(edge, row);
  }

  void checkAgreement(const std::vector<Use>& uses, const Use& use, const std::vector<int>& row) {
    for (std::size_t i = 0; i < use.row.size(); ++i) {
      const double distance = (use.row[i] - points_[row[i]]).norm();
      if (distance <= tolerance_) continue;
      const Vector3d& p = points_[row[i]];
      throw NoPatches{"the parameters of the faces \"" + quads_.faces[uses[0].face].name +
                      "\" and \"" + quads_.faces[uses[1].face].name +
                      "\" do not agree along their common edge near (" + shortNumberText(p.x()) +
                      ", " + shortNumberText(p.y()) + ", " + shortNumberText(p.z()) +
                      ") mm (they differ by " + shortNumberText(distance) + " mm)"};
    }
  }

  std::vector<int> rowOf(std::size_t face, Side side) const {
    const auto& use = quads_.faces[face].sides[static_cast<std::size_t>(side)];
    std::vector<int> row = rows_[static_cast<std::size_t>(use.edge)];
    if (use.reversed) std::reverse(row.begin(), row.end());
    return row;
  }

  void assign(std::size_t f) {
    const std::vector<int> bottom = rowOf(f, Side::kVMin);
    const std::vector<int> top = rowOf(f, Side::kVMax);
    const std::vector<int> left = rowOf(f, Side::kUMin);
    const std::vector<int> right = rowOf(f, Side::kUMax);
    if (bottom.size() != top.size() || left.size() != right.size())
      throw NoPatches{"the sides of the face \"" + quads_.faces[f].name + "\" do not match"};
    if (patches_[f].net.empty()) spanFlat(f, {bottom, right, top, left});
    auto& net = patches_[f].patch.net;
    net.assign(bottom.size(), std::vector<int>(left.size()));
    for (std::size_t i = 0; i < bottom.size(); ++i)
      for (std::size_t j = 0; j < left.size(); ++j) {
        const bool inner = i > 0 && j > 0 && i + 1 < bottom.size() && j + 1 < left.size();
        if (inner) {
          net[i][j] = static_cast<int>(points_.size());
          points_.push_back(patches_[f].net[i][j]);
        } else {
          net[i][j] = i == 0                   ? left[j]
                      : i + 1 == bottom.size() ? right[j]
                      : j == 0                 ? bottom[i]
                                               : top[i];
        }
      }
  }

  /// Makes the net of a Coons patch between four rows. The Greville abscissae are the control
  /// points of the identity, so blending control points with them blends the curves.
  void spanFlat(std::size_t f, const std::array<std::vector<int>, 4>& rows) {
    const std::vector<double> u = chains_.of(static_cast<int>(f), 0).sites();
    const std::vector<double> v = chains_.of(static_cast<int>(f), 1).sites();
    const auto& [bottom, right, top, left] = rows;
    const auto p = [&](int index) -> const Vector3d& { return points_[index]; };
    Net net(u.size(), std::vector<Vector3d>(v.size()));
    for (std::size_t i = 0; i < u.size(); ++i)
      for (std::size_t j = 0; j < v.size(); ++j) {
        const double s = u[i];
        const double t = v[j];
        net[i][j] = (1 - t) * p(bottom[i]) + t * p(top[i]) + (1 - s) * p(left[j]) +
                    s * p(right[j]) - (1 - s) * (1 - t) * p(bottom.front()) -
                    s * (1 - t) * p(bottom.back()) - (1 - s) * t * p(top.front()) -
                    s * t * p(top.back());
      }
    patches_[f].net = std::move(net);
  }

  const QuadFaces& quads_;
  const KnotChains& chains_;
  std::vector<LoosePatch> patches_;
  double tolerance_;
  std::vector<Vector3d> points_;
  TopTools_IndexedMapOfShape vertices_;
  std::vector<int> pointOfVertex_;
  std::vector<std::vector<int>> rows_;  // per edge: its control points in order
};

}  // namespace

Solid weldPatches(const QuadFaces& quads, const KnotChains& chains, std::vector<LoosePatch> patches,
                  double tolerance) {
  return Welder(quads, chains, std::move(patches), tolerance).weld();
}

}  // namespace palpa::modeling

#include "modeling/exchange/cad_patches.h"

#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <BSplSLib.hxx>
#include <Eigen/Geometry>
#include <GProp_GProps.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>

#include "modeling/error.h"
#include "modeling/exchange/knot_chain.h"
#include "modeling/exchange/opencascade_session.h"
#include "modeling/solid/solid_check.h"
#include "modeling/solid/spline_surface.h"
#include "modeling/solid/surface_properties.h"
#include "modeling/text.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Kind = QuadFace::Kind;
using Net = std::vector<std::vector<Vector3d>>;

Vector3d toEigen(const gp_Pnt& p) {
  return {p.X(), p.Y(), p.Z()};
}

/// A patch with control points of its own, before they are joined with those of its neighbours.
struct LoosePatch {
  Patch patch;  // without net
  Net net;      // empty for flat faces
};

TColStd_Array1OfReal toArray(const std::vector<double>& values) {
  TColStd_Array1OfReal array(1, static_cast<int>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) array(static_cast<int>(i) + 1) = values[i];
  return array;
}

Net toNet(const TColgp_Array2OfPnt& poles) {
  Net net(static_cast<std::size_t>(poles.ColLength()));
  for (int i = 0; i < poles.ColLength(); ++i)
    for (int j = 0; j < poles.RowLength(); ++j)
      net[i].push_back(toEigen(poles(poles.LowerRow() + i, poles.LowerCol() + j)));
  return net;
}

/// Brings one direction of a spline to the knots of its chain. Knots that are there already keep
/// their value to the last bit, unless the neighbour's differs by more than rounding.
void matchKnots(Geom_BSplineSurface& spline, int direction, const KnotSet& knots) {
  const bool u = direction == 0;
  double u0, u1, v0, v1;
  spline.Bounds(u0, u1, v0, v1);
  const double low = u ? u0 : v0;
  const double length = u ? u1 - u0 : v1 - v0;
  for (const auto& knot : knots.inner) {
    const double value = low + knot.at * length;
    int found = 0;
    for (int i = 2; i < (u ? spline.NbUKnots() : spline.NbVKnots()); ++i)
      if (std::abs((u ? spline.UKnot(i) : spline.VKnot(i)) - value) <= kSameKnot * length)
        found = i;
    if (found == 0) {
      if (u)
        spline.InsertUKnot(value, knot.multiplicity, 0.0);
      else
        spline.InsertVKnot(value, knot.multiplicity, 0.0);
      continue;
    }
    constexpr double kRounding = 1e-12;
    const double old = u ? spline.UKnot(found) : spline.VKnot(found);
    const bool moved = std::abs(old - value) > kRounding * length;
    if (u) {
      if (moved) spline.SetUKnot(found, value);
      spline.IncreaseUMultiplicity(found, knot.multiplicity);
    } else {
      if (moved) spline.SetVKnot(found, value);
      spline.IncreaseVMultiplicity(found, knot.multiplicity);
    }
  }
}

std::vector<double> flatKnots(const Geom_BSplineSurface& spline, int direction) {
  TColStd_Array1OfReal knots(1, direction == 0 ? spline.NbUPoles() + spline.UDegree() + 1
                                               : spline.NbVPoles() + spline.VDegree() + 1);
  if (direction == 0)
    spline.UKnotSequence(knots);
  else
    spline.VKnotSequence(knots);
  return {knots.begin(), knots.end()};
}

LoosePatch exactPatch(const QuadFace& face, const KnotSet& uKnots, const KnotSet& vKnots) {
  const auto spline = Handle(Geom_BSplineSurface)::DownCast(face.spline->Copy());
  spline->IncreaseDegree(uKnots.degree, vKnots.degree);
  matchKnots(*spline, 0, uKnots);
  matchKnots(*spline, 1, vKnots);
  LoosePatch loose;
  loose.patch.degree = {spline->UDegree(), spline->VDegree()};
  loose.patch.knots = {flatKnots(*spline, 0), flatKnots(*spline, 1)};
  loose.net = toNet(spline->Poles());
  return loose;
}

/// Interpolates the surface at the Greville abscissae. A border of the net depends only on points
/// of that border, so neighbours with the same parameters agree.
LoosePatch interpolatedPatch(const QuadFace& face, const KnotSet& uKnots, const KnotSet& vKnots) {
  LoosePatch loose;
  loose.patch.degree = {uKnots.degree, vKnots.degree};
  loose.patch.knots = {uKnots.flat(), vKnots.flat()};
  if (face.kind == Kind::flat) return loose;
  const std::vector<double> uSites = uKnots.sites();
  const std::vector<double> vSites = vKnots.sites();
  TColgp_Array2OfPnt poles(1, static_cast<int>(uSites.size()), 1, static_cast<int>(vSites.size()));
  for (std::size_t i = 0; i < uSites.size(); ++i)
    for (std::size_t j = 0; j < vSites.size(); ++j)
      poles(static_cast<int>(i) + 1, static_cast<int>(j) + 1) = face.value(uSites[i], vSites[j]);
  int problem = 0;
  BSplSLib::Interpolate(uKnots.degree, vKnots.degree, toArray(loose.patch.knots[0]),
                        toArray(loose.patch.knots[1]), toArray(uSites), toArray(vSites), poles,
                        problem);
  if (problem != 0) throw NoPatches{"the face \"" + face.name + "\" cannot be interpolated"};
  loose.net = toNet(poles);
  return loose;
}

std::vector<Vector3d> sideRow(const Net& net, Side side) {
  if (side == Side::uMin) return net.front();
  if (side == Side::uMax) return net.back();
  std::vector<Vector3d> row;
  for (const auto& column : net) row.push_back(side == Side::vMin ? column.front() : column.back());
  return row;
}

/// Joins loose patches to a solid: one control point per vertex, one row per edge.
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
  /// Control points in the order in which the nets name them, as in the primitives.
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

  /// One side of a face at an edge; `row` runs along the edge, empty for flat faces.
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
    // Splines before approximations before straight lines: each takes the corners of those before.
    for (const Kind kind : {Kind::spline, Kind::smooth})
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

  /// Between two flat faces.
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
    const std::vector<int> bottom = rowOf(f, Side::vMin);
    const std::vector<int> top = rowOf(f, Side::vMax);
    const std::vector<int> left = rowOf(f, Side::uMin);
    const std::vector<int> right = rowOf(f, Side::uMax);
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

  /// A Coons patch between the four rows. The Greville abscissae are the control points of the
  /// identity, so blending control points with them blends the curves.
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
  std::vector<std::vector<int>> rows_;  // per edge, along it
};

/// Points of a parameter range that lie inside its spans.
std::vector<double> samples(const std::vector<double>& spans, int perSpan) {
  std::vector<double> result{spans.front()};
  for (std::size_t i = 1; i < spans.size(); ++i)
    for (int k = 1; k <= perSpan; ++k)
      result.push_back(spans[i - 1] + (spans[i] - spans[i - 1]) * k / perSpan);
  return result;
}

/// Largest distance between a patch and its face: between points of the same parameters, or from
/// the plane.
double deviationOf(const SurfaceEvaluator& surface, int patch, const QuadFace& face) {
  constexpr int kPerSpan = 5;
  const auto [u0, u1] = surface.range(patch, 0);
  const auto [v0, v1] = surface.range(patch, 1);
  double worst = 0.0;
  for (const double u : samples(surface.spans(patch, 0), kPerSpan))
    for (const double v : samples(surface.spans(patch, 1), kPerSpan)) {
      const Vector3d p = surface.position(patch, u, v);
      const double distance =
          face.kind == Kind::flat
              ? std::abs((p - toEigen(face.origin))
                             .dot(Vector3d(face.normal.X(), face.normal.Y(), face.normal.Z())))
              : (p - toEigen(face.value((u - u0) / (u1 - u0), (v - v0) / (v1 - v0)))).norm();
      worst = std::max(worst, distance);
    }
  return worst;
}

/// A flat face that one patch cannot cover has a Coons patch that folds.
void checkFlat(const SurfaceEvaluator& surface, int patch, const QuadFace& face) {
  const Vector3d normal(face.normal.X(), face.normal.Y(), face.normal.Z());
  constexpr int kSamples = 12;
  const auto [u0, u1] = surface.range(patch, 0);
  const auto [v0, v1] = surface.range(patch, 1);
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j) {
      const SurfacePoint p = surface.evaluate(patch, u0 + (u1 - u0) * (i + 0.5) / kSamples,
                                              v0 + (v1 - v0) * (j + 0.5) / kSamples);
      if (p.du.cross(p.dv).dot(normal) <= 0.0)
        throw NoPatches{"the flat face \"" + face.name + "\" is bent too much for one patch"};
    }
}

double volumeOf(const TopoDS_Solid& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

PatchResult attempt(const QuadFaces& quads, const KnotChains& chains, double tolerance,
                    const Job& job) {
  std::vector<LoosePatch> loose;
  PatchResult result;
  for (int f = 0; f < static_cast<int>(quads.faces.size()); ++f) {
    job.throwIfCancelled();
    const QuadFace& face = quads.faces[f];
    const KnotSet u = chains.of(f, 0);
    const KnotSet v = chains.of(f, 1);
    loose.push_back(face.kind == Kind::spline ? exactPatch(face, u, v)
                                              : interpolatedPatch(face, u, v));
    loose.back().patch.name = face.name;
    if (face.kind == Kind::smooth) ++result.approximatedFaces;
  }
  try {
    result.solid = Welder(quads, chains, std::move(loose), tolerance).weld();
  } catch (const ModelingError& error) {
    throw NoPatches{std::string("its faces make no valid solid: ") + error.what()};
  }
  const SurfaceEvaluator surface(result.solid);
  for (int f = 0; f < surface.patchCount(); ++f) {
    job.throwIfCancelled();
    if (quads.faces[f].kind == Kind::flat) checkFlat(surface, f, quads.faces[f]);
    result.deviation = std::max(result.deviation, deviationOf(surface, f, quads.faces[f]));
  }
  return result;
}

}  // namespace

PatchResult makePatches(const TopoDS_Solid& shape, const std::vector<std::string>& faceNames,
                        double tolerance, const Job& job) {
  const QuadFaces quads = findQuadFaces(shape, faceNames);
  job.throwIfCancelled();
  KnotChains chains(quads);
  chains.refine(0.5 * tolerance);  // two directions add up
  PatchResult result = attempt(quads, chains, tolerance, job);
  constexpr int kMostAttempts = 3;
  for (int i = 1; i < kMostAttempts && result.deviation > tolerance; ++i) {
    chains.halve();
    result = attempt(quads, chains, tolerance, job);
  }
  if (!(result.deviation <= tolerance))
    throw NoPatches{"patches would differ from it by " + shortNumberText(result.deviation) +
                    " mm, more than the tolerance of " + shortNumberText(tolerance) + " mm"};
  const double expected = volumeOf(shape);
  const double enclosed = volume(SurfaceEvaluator(result.solid));
  constexpr double kVolume = 0.01;  // relative; guards against gross misunderstanding only
  if (!(std::abs(enclosed - expected) <= kVolume * expected))
    throw NoPatches{"patches would enclose another volume"};
  return result;
}

}  // namespace palpa::modeling

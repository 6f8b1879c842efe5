#include "modeling/exchange/cad_patches.h"

#include <BRepGProp.hxx>
#include <BSplSLib.hxx>
#include <Eigen/Geometry>
#include <GProp_GProps.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/exchange/knot_chain.h"
#include "modeling/exchange/opencascade_session.h"
#include "modeling/exchange/patch_weld.h"
#include "modeling/solid/opencascade_surface.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Kind = QuadFace::Kind;

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

/// Refines one direction of a spline to the knots of its chain. Existing knots keep their bits,
/// unless the knot of the neighbour differs by more than rounding.
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
/// of this border, so neighbours with the same parameters have equal borders.
LoosePatch interpolatedPatch(const QuadFace& face, const KnotSet& uKnots, const KnotSet& vKnots) {
  LoosePatch loose;
  loose.patch.degree = {uKnots.degree, vKnots.degree};
  loose.patch.knots = {uKnots.flat(), vKnots.flat()};
  if (face.kind == Kind::kFlat) return loose;
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

/// Sample parameters inside the spans.
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
          face.kind == Kind::kFlat
              ? std::abs((p - toEigen(face.origin))
                             .dot(Vector3d(face.normal.X(), face.normal.Y(), face.normal.Z())))
              : (p - toEigen(face.value((u - u0) / (u1 - u0), (v - v0) / (v1 - v0)))).norm();
      worst = std::max(worst, distance);
    }
  return worst;
}

/// Throws NoPatches if the Coons patch of a flat face is folded: then one patch cannot cover it.
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
        throw NoPatches{"the flat face \"" + face.name + "\" cannot be covered by one patch"};
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
    loose.push_back(face.kind == Kind::kSpline ? exactPatch(face, u, v)
                                               : interpolatedPatch(face, u, v));
    loose.back().patch.name = face.name;
    if (face.kind == Kind::kSmooth) ++result.approximatedFaces;
  }
  try {
    result.solid = weldPatches(quads, chains, std::move(loose), tolerance);
  } catch (const ModelingError& error) {
    throw NoPatches{std::string("its faces do not form a valid solid: ") + error.what()};
  }
  const SurfaceEvaluator surface(result.solid);
  for (int f = 0; f < surface.patchCount(); ++f) {
    job.throwIfCancelled();
    if (quads.faces[f].kind == Kind::kFlat) checkFlat(surface, f, quads.faces[f]);
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
  constexpr int kMaxAttempts = 3;
  for (int i = 1; i < kMaxAttempts && result.deviation > tolerance; ++i) {
    chains.halve();
    result = attempt(quads, chains, tolerance, job);
  }
  if (!(result.deviation <= tolerance))
    throw NoPatches{"patches would differ from it by " + shortNumberText(result.deviation) +
                    " mm, more than the tolerance of " + shortNumberText(tolerance) + " mm"};
  const double expected = volumeOf(shape);
  const double enclosed = volume(SurfaceEvaluator(result.solid));
  constexpr double kVolume = 0.01;  // relative; detects gross errors only
  if (!(std::abs(enclosed - expected) <= kVolume * expected))
    throw NoPatches{"patches would enclose a different volume"};
  return result;
}

}  // namespace palpa::modeling

#include "modeling/exchange/knot_chain.h"

#include <BSplCLib.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <algorithm>
#include <cmath>

namespace palpa::modeling {
namespace {

constexpr int kOpenDegree = 3;  // of chains without a degree in the file
constexpr int kMaxSpans = 128;  // of an approximation

std::size_t placeOf(int face, int direction) {
  return static_cast<std::size_t>(2 * face + direction);
}

/// Knots of one direction of a spline face over [0, 1], multiplicities at the given degree.
KnotSet knotsOf(const Geom_BSplineSurface& spline, int direction, int degree) {
  const bool u = direction == 0;
  const int count = u ? spline.NbUKnots() : spline.NbVKnots();
  const auto knot = [&](int i) { return u ? spline.UKnot(i) : spline.VKnot(i); };
  KnotSet set;
  set.degree = degree;
  const int raise = degree - (u ? spline.UDegree() : spline.VDegree());
  for (int i = 2; i < count; ++i)
    set.add((knot(i) - knot(1)) / (knot(count) - knot(1)),
            raise + (u ? spline.UMultiplicity(i) : spline.VMultiplicity(i)));
  return set;
}

/// Spans of the knots on which the interpolation of `curve` deviates by more than the tolerance.
std::vector<int> badSpans(const KnotSet& knots, const std::function<gp_Pnt(double)>& curve,
                          double tolerance) {
  const std::vector<double> flat = knots.flat();
  const std::vector<double> sites = knots.sites();
  const int count = knots.pointCount();
  TColStd_Array1OfReal flatKnots(1, static_cast<int>(flat.size()));
  TColStd_Array1OfReal parameters(1, count);
  TColStd_Array1OfInteger contact(1, count);
  TColgp_Array1OfPnt poles(1, count);
  for (int i = 0; i < static_cast<int>(flat.size()); ++i) flatKnots(i + 1) = flat[i];
  for (int i = 0; i < count; ++i) {
    parameters(i + 1) = sites[i];
    contact(i + 1) = 0;
    poles(i + 1) = curve(sites[i]);
  }
  int problem = 0;
  BSplCLib::Interpolate(knots.degree, flatKnots, parameters, contact, poles, problem);
  if (problem != 0) throw NoPatches{"an interpolation failed"};

  TColStd_Array1OfReal distinct(1, static_cast<int>(knots.inner.size()) + 2);
  TColStd_Array1OfInteger multiplicities(1, distinct.Upper());
  multiplicities.Init(knots.degree + 1);
  distinct(1) = 0.0;
  distinct(distinct.Upper()) = 1.0;
  for (int i = 0; i < static_cast<int>(knots.inner.size()); ++i) {
    distinct(i + 2) = knots.inner[i].at;
    multiplicities(i + 2) = knots.inner[i].multiplicity;
  }
  const Geom_BSplineCurve fit(poles, distinct, multiplicities, knots.degree);
  std::vector<int> bad;
  for (int span = 1; span < distinct.Upper(); ++span) {
    constexpr int kSamples = 8;
    double worst = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      const double t =
          distinct(span) + (distinct(span + 1) - distinct(span)) * (i + 0.5) / kSamples;
      worst = std::max(worst, fit.Value(t).Distance(curve(t)));
    }
    if (!(worst <= tolerance)) bad.push_back(span - 1);
  }
  return bad;
}

/// Halves the given spans.
void halveSpans(KnotSet& knots, const std::vector<int>& spans) {
  std::vector<double> ends{0.0};
  for (const auto& knot : knots.inner) ends.push_back(knot.at);
  ends.push_back(1.0);
  if (ends.size() + spans.size() > kMaxSpans)
    throw NoPatches{"its curved faces need too many control points for the tolerance"};
  for (const int span : spans) knots.add(0.5 * (ends[span] + ends[span + 1]), 1);
}

}  // namespace

void KnotSet::add(double at, int multiplicity) {
  auto next = std::lower_bound(inner.begin(), inner.end(), at - kSameKnot,
                               [](const Knot& knot, double value) { return knot.at < value; });
  if (next != inner.end() && next->at <= at + kSameKnot) {
    next->multiplicity = std::max(next->multiplicity, multiplicity);
  } else {
    inner.insert(next, {at, multiplicity});
  }
}

int KnotSet::pointCount() const {
  int count = degree + 1;
  for (const Knot& knot : inner) count += knot.multiplicity;
  return count;
}

KnotSet KnotSet::turned() const {
  KnotSet result{degree, {}};
  for (auto knot = inner.rbegin(); knot != inner.rend(); ++knot)
    result.inner.push_back({1.0 - knot->at, knot->multiplicity});
  return result;
}

std::vector<double> KnotSet::flat() const {
  std::vector<double> result(static_cast<std::size_t>(degree) + 1, 0.0);
  for (const Knot& knot : inner) result.insert(result.end(), knot.multiplicity, knot.at);
  result.insert(result.end(), static_cast<std::size_t>(degree) + 1, 1.0);
  return result;
}

std::vector<double> KnotSet::sites() const {
  const std::vector<double> knots = flat();
  std::vector<double> result;
  for (int i = 0; i < pointCount(); ++i) {
    double sum = 0.0;
    for (int k = 1; k <= degree; ++k) sum += knots[static_cast<std::size_t>(i + k)];
    result.push_back(sum / degree);
  }
  return result;
}

KnotChains::KnotChains(const QuadFaces& quads) : faces_(quads.faces) {
  join(quads);
  std::vector<bool> open(chains_.size(), false);  // per chain: the file gives no degree
  for (std::size_t place = 0; place < places_.size(); ++place) {
    const QuadFace& face = faces_[place / 2];
    KnotSet& chain = chains_[places_[place].chain];
    if (face.kind == QuadFace::Kind::kSpline)
      chain.degree =
          std::max(chain.degree, place % 2 == 0 ? face.spline->UDegree() : face.spline->VDegree());
    if (face.kind == QuadFace::Kind::kSmooth) open[places_[place].chain] = true;
  }
  for (std::size_t c = 0; c < chains_.size(); ++c)
    if (open[c] || chains_[c].degree == 0)
      chains_[c].degree = std::max(chains_[c].degree, kOpenDegree);
  // Knots of splines first: of two nearly equal knots the first one is kept.
  for (const auto kind : {QuadFace::Kind::kSpline, QuadFace::Kind::kSmooth})
    for (int f = 0; f < static_cast<int>(faces_.size()); ++f)
      for (int d : {0, 1}) {
        if (faces_[f].kind != kind) continue;
        if (kind == QuadFace::Kind::kSpline) addSplineKnots(f, d);
        if (kind == QuadFace::Kind::kSmooth) addBreaks(f, d);
      }
}

void KnotChains::join(const QuadFaces& quads) {
  // Chains grow from each first place along the links between (face, direction) places.
  struct Link {
    std::size_t to;
    bool turned;
  };
  std::vector<std::vector<Link>> links(2 * faces_.size());
  std::vector<std::vector<std::pair<std::size_t, bool>>> uses(
      static_cast<std::size_t>(quads.edges.Extent()) + 1);
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f)
    for (Side side : kSides) {
      const auto& use = faces_[f].sides[static_cast<std::size_t>(side)];
      uses[static_cast<std::size_t>(use.edge)].emplace_back(placeOf(f, directionOf(side)),
                                                            use.reversed);
    }
  for (const auto& edge : uses) {
    if (edge.empty()) continue;
    if (edge.size() != 2) throw NoPatches{"an edge does not join two faces"};
    const bool turned = edge[0].second != edge[1].second;
    links[edge[0].first].push_back({edge[1].first, turned});
    links[edge[1].first].push_back({edge[0].first, turned});
  }
  places_.assign(links.size(), {-1, false});
  for (std::size_t first = 0; first < links.size(); ++first) {
    if (places_[first].chain >= 0) continue;
    const int chain = static_cast<int>(chains_.size());
    chains_.emplace_back();
    places_[first] = {chain, false};
    std::vector<std::size_t> stack{first};
    while (!stack.empty()) {
      const std::size_t at = stack.back();
      stack.pop_back();
      for (const Link& link : links[at]) {
        const bool turned = places_[at].turned != link.turned;
        Place& place = places_[link.to];
        if (place.chain < 0) {
          place = {chain, turned};
          stack.push_back(link.to);
        } else if (place.turned != turned) {
          throw NoPatches{"its faces form a one-sided strip"};
        }
      }
    }
  }
}

void KnotChains::addSplineKnots(int face, int direction) {
  const Place place = places_[placeOf(face, direction)];
  KnotSet& chain = chains_[place.chain];
  KnotSet own = knotsOf(*faces_[face].spline, direction, chain.degree);
  if (place.turned) own = own.turned();
  for (const auto& knot : own.inner) chain.add(knot.at, knot.multiplicity);
}

void KnotChains::addBreaks(int face, int direction) {
  const Place place = places_[placeOf(face, direction)];
  KnotSet& chain = chains_[place.chain];
  const QuadFace& quad = faces_[face];
  const bool alongU = (direction == 0) != quad.swapped;  // in the parameters of `quad.surface`
  const auto& [uRange, vRange] =
      quad.swapped ? std::array{quad.range[1], quad.range[0]} : quad.range;
  const GeomAdaptor_Surface adaptor(quad.surface, uRange[0], uRange[1], vRange[0], vRange[1]);
  const auto [low, high] = quad.range[static_cast<std::size_t>(direction)];
  constexpr std::array kContinuity{GeomAbs_C1, GeomAbs_C2, GeomAbs_C3};
  for (int c = 0; c < 3; ++c) {
    const int count =
        alongU ? adaptor.NbUIntervals(kContinuity[c]) : adaptor.NbVIntervals(kContinuity[c]);
    TColStd_Array1OfReal ends(1, count + 1);
    if (alongU)
      adaptor.UIntervals(ends, kContinuity[c]);
    else
      adaptor.VIntervals(ends, kContinuity[c]);
    for (int i = 2; i <= count; ++i) {
      const double t = (ends(i) - low) / (high - low);
      if (t > kSameKnot && t < 1.0 - kSameKnot)
        chain.add(place.turned ? 1.0 - t : t, chain.degree - c);
    }
  }
  if (chain.inner.size() > kMaxSpans)
    throw NoPatches{"the face \"" + quad.name + "\" has too many pieces"};
}

void KnotChains::refine(double tolerance) {
  while (refineOnce(tolerance)) {
  }
}

bool KnotChains::refineOnce(double tolerance) {
  bool changed = false;
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f)
    for (int d : {0, 1}) {
      if (faces_[f].kind != QuadFace::Kind::kSmooth) continue;
      const Place place = places_[placeOf(f, d)];
      KnotSet& chain = chains_[place.chain];
      for (const double across : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const auto curve = [&](double t) {
          const double s = place.turned ? 1.0 - t : t;
          return d == 0 ? faces_[f].value(s, across) : faces_[f].value(across, s);
        };
        const std::vector<int> bad = badSpans(chain, curve, tolerance);
        if (bad.empty()) continue;
        halveSpans(chain, bad);
        changed = true;
      }
    }
  return changed;
}

void KnotChains::halve() {
  std::vector<bool> done(chains_.size(), false);
  for (std::size_t place = 0; place < places_.size(); ++place) {
    const int chain = places_[place].chain;
    if (done[chain] || faces_[place / 2].kind != QuadFace::Kind::kSmooth) continue;
    done[chain] = true;
    std::vector<int> all;
    for (int i = 0; i <= static_cast<int>(chains_[chain].inner.size()); ++i) all.push_back(i);
    halveSpans(chains_[chain], all);
  }
}

KnotSet KnotChains::of(int face, int direction) const {
  const Place place = places_[placeOf(face, direction)];
  return place.turned ? chains_[place.chain].turned() : chains_[place.chain];
}

}  // namespace palpa::modeling

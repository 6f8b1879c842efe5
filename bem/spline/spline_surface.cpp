#include "bem/spline/spline_surface.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "base/disjoint_sets.h"

namespace palpa::bem {

using Eigen::Vector3d;

SplineSurface::SplineSurface(std::vector<Vector3d> controlPoints, std::vector<SplinePatch> patches)
    : controlPoints_(std::move(controlPoints)), patches_(std::move(patches)) {
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const SplinePatch& patch = patches_[p];
    const auto& [u, v] = patch.basis;
    if (patch.net.size() != static_cast<std::size_t>(u.count()) * v.count())
      throw std::invalid_argument("SplineSurface: the net of a patch does not fit its knots");
    for (const int point : patch.net)
      if (point < 0 || point >= coefficientCount())
        throw std::invalid_argument("SplineSurface: a net names a point that does not exist");
    firstCell_.push_back(elementCount());
    for (std::size_t j = 0; j < v.spans().size(); ++j)
      for (std::size_t i = 0; i < u.spans().size(); ++i) {
        const auto &spanU = u.spans()[i], &spanV = v.spans()[j];
        elementsOfCell_.push_back({elementCount()});
        elements_.push_back({static_cast<int>(p),
                             {static_cast<int>(i), static_cast<int>(j)},
                             {spanU.lower, spanV.lower},
                             {spanU.upper, spanV.upper}});
        std::vector<int>& list = functions_.emplace_back();
        for (int b = 0; b <= v.degree(); ++b)
          for (int a = 0; a <= u.degree(); ++a)
            list.push_back(patch.net[spanU.first + a + (spanV.first + b) * u.count()]);
      }
  }
  sides_.assign(elements_.size(), kFree);
  bordersOf_.assign(elements_.size(), -1);
  cutBorders_ = std::make_shared<const std::vector<CutBorder>>();
  tornFrom_.resize(controlPoints_.size());
  std::iota(tornFrom_.begin(), tornFrom_.end(), 0);
  isTorn_.resize(controlPoints_.size(), false);
}

void SplineSurface::replaceElement(int element, const std::vector<SplineElement>& pieces,
                                   const std::vector<std::optional<CutMap>>& maps) {
  const auto& [u, v] = elements_[element].span;
  const std::size_t cell =
      firstCell_[elements_[element].patch] +
      static_cast<std::size_t>(v) * patches_[elements_[element].patch].basis[0].spans().size() + u;
  const std::vector<int> list = functions_[element];
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    SplineElement piece = pieces[k];
    if (maps[k]) {
      const int inside = piece.cut;
      piece.cut = static_cast<int>(cuts_.size());
      cuts_.push_back({*maps[k], inside});
    }
    if (k == 0) {
      elements_[element] = piece;
      continue;
    }
    elementsOfCell_[cell].push_back(elementCount());
    elements_.push_back(piece);
    functions_.push_back(list);
    sides_.push_back(sides_[element]);
    bordersOf_.push_back(bordersOf_[element]);
  }
}

void SplineSurface::setBorders(std::vector<CutBorder> borders, std::vector<int> owners,
                               std::vector<std::optional<ElementFunctions>> functions) {
  std::vector<std::vector<int>> nets;
  for (int e = 0; e < elementCount(); ++e) nets.push_back(net(e));
  cutBorders_ = std::make_shared<const std::vector<CutBorder>>(std::move(borders));
  owners_ = std::move(owners);
  borderFunctions_.clear();
  borderNet_.clear();
  for (int e = 0; e < elementCount(); ++e) {
    bordersOf_[e] = -1;
    functions_[e] = nets[e];
    if (!functions[e]) continue;
    bordersOf_[e] = static_cast<int>(borderNet_.size());
    borderNet_.push_back(nets[e]);
    functions_[e] = std::move(functions[e]->coefficients);
    borderFunctions_.push_back(std::move(functions[e]->functions));
    borderFunctions_.back().borders = cutBorders_;
  }
}

int SplineSurface::tear(int coefficient, const std::vector<bool>& elements) {
  const int other = coefficientCount();
  controlPoints_.push_back(controlPoints_[coefficient]);
  tornFrom_.push_back(tornFrom_[coefficient]);
  isTorn_[coefficient] = true;
  isTorn_.push_back(true);
  for (int e = 0; e < elementCount(); ++e)
    if (elements[e]) std::replace(functions_[e].begin(), functions_[e].end(), coefficient, other);
  return other;
}

std::optional<Eigen::Vector2d> SplineSurface::invert(int cut, double u, double v,
                                                     double slack) const {
  const Cut& at = cuts_[cut];
  if (at.inside < 0) return at.map.invert(u, v, slack);
  const auto outer = invert(at.inside, u, v, slack);
  if (!outer) return {};
  return at.map.invert((*outer)[0], (*outer)[1], slack);
}

std::optional<ElementPlace> SplineSurface::placeIn(int index, double u, double v) const {
  const SplineElement& element = elements_[index];
  constexpr double kSlack = 1e-9;
  std::array<double, 2> parameter{u, v};
  if (element.cut >= 0) {
    const auto local = invert(element.cut, u, v, kSlack);
    if (!local) return {};
    parameter = {(*local)[0], (*local)[1]};
  }
  for (int d = 0; d < 2; ++d) {
    const double slack = kSlack * (element.upper[d] - element.lower[d]);
    if (parameter[d] < element.lower[d] - slack || parameter[d] > element.upper[d] + slack)
      return {};
  }
  return ElementPlace{index, parameter[0], parameter[1]};
}

CutMap::Image SplineSurface::parameters(const ElementPlace& place) const {
  CutMap::Image image{{place.u, place.v}, Eigen::Matrix2d::Identity()};
  for (int cut = elements_[place.element].cut; cut >= 0; cut = cuts_[cut].inside) {
    const CutMap::Image outer = cuts_[cut].map.at(image.parameters[0], image.parameters[1]);
    image = {outer.parameters, outer.derivative * image.derivative};
  }
  return image;
}

double SplineSurface::boundingSize() const {
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : controlPoints_) box.extend(p);
  return box.diagonal().norm();
}

int SplineSurface::closedSurfaceCount() const {
  DisjointSets points(controlPoints_.size());
  // The nets do not contain the second coefficients of torn functions.
  int count = 0;
  for (int k = 0; k < coefficientCount(); ++k) count += tornFrom_[k] == k ? 1 : 0;
  for (const SplinePatch& patch : patches_)
    for (const int point : patch.net)
      if (points.join(point, patch.net.front())) --count;
  return count;
}

bool SplineSurface::isSameCut(int cut, const SplineSurface& other, int otherCut) const {
  if (cut < 0 || otherCut < 0) return cut < 0 && otherCut < 0;
  const Cut &own = cuts_[cut], &others = other.cuts_[otherCut];
  return own.map == others.map && isSameCut(own.inside, other, others.inside);
}

std::optional<std::vector<int>> SplineSurface::movedElements(const SplineSurface& before) const {
  if (patches_ != before.patches_ || functions_ != before.functions_ ||
      tornFrom_ != before.tornFrom_ || isTorn_ != before.isTorn_ ||
      barelyReaches_ != before.barelyReaches_ || sides_ != before.sides_ ||
      owners_ != before.owners_)
    return std::nullopt;
  std::vector<int> moved;
  for (int e = 0; e < elementCount(); ++e) {
    const SplineElement &element = elements_[e], &old = before.elements_[e];
    if (element.patch != old.patch || element.span != old.span || element.tag != old.tag ||
        (element.cut < 0) != (old.cut < 0))
      return std::nullopt;
    const BorderFunctions *beside = borderFunctions(e), *besideOld = before.borderFunctions(e);
    if ((beside == nullptr) != (besideOld == nullptr) ||
        (beside && (net(e) != before.net(e) || !beside->hasSameFunctions(*besideOld))))
      return std::nullopt;
    const bool isSame = (!beside || beside->samples == besideOld->samples) &&
                        element.lower == old.lower && element.upper == old.upper &&
                        isSameCut(element.cut, before, old.cut) &&
                        std::all_of(net(e).begin(), net(e).end(), [&](int coefficient) {
                          return controlPoints_[coefficient] == before.controlPoints_[coefficient];
                        });
    if (!isSame) moved.push_back(e);
  }
  return moved;
}

void SplineSurface::write(const ByteSink& sink) const {
  writeList(sink, controlPoints_);
  writeCount(sink, patches_.size());
  for (const SplinePatch& patch : patches_) {
    for (const BsplineBasis& basis : patch.basis) {
      writeValue(sink, basis.degree());
      writeList(sink, basis.knots());
    }
    writeList(sink, patch.net);
    writeValue(sink, patch.smoothingGroup);
  }
  writeCount(sink, elements_.size());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const SplineElement& element = elements_[e];
    writeValue(sink, element.patch);
    writeValue(sink, element.span);
    writeValue(sink, element.lower);
    writeValue(sink, element.upper);
    writeValue(sink, element.tag);
    writeValue(sink, element.cut);
    writeList(sink, functions_[e]);
    if (const BorderFunctions* beside = borderFunctions(static_cast<int>(e))) {
      writeList(sink, net(static_cast<int>(e)));
      beside->write(sink);
    }
  }
  writeCount(sink, cuts_.size());
  for (const Cut& cut : cuts_) {
    cut.map.write(sink);
    writeValue(sink, cut.inside);
  }
  writeList(sink, tornFrom_);
  writeList(sink, std::vector<char>(isTorn_.begin(), isTorn_.end()));
  if (!owners_.empty()) {
    writeList(sink, sides_);
    writeList(sink, owners_);
  }
  writeCount(sink, barelyReaches_.size());
  for (const auto& mark : barelyReaches_) writeValue(sink, mark);
}

}  // namespace palpa::bem

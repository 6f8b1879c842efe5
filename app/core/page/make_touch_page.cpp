#include "app/core/page/make_touch_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "app/core/live/touchable_model.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/page/page_errors.h"
#include "app/core/page/page_project.h"
#include "app/core/page/page_solutions.h"
#include "app/core/page/page_surface.h"
#include "base/count_text.h"
#include "base/text.h"
#include "bem/base/error.h"

namespace palpa::app {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Shares of the phase "touch" at which its parts end.
constexpr double kOwnEnd = 0.2, kPlacesEnd = 0.6;

[[noreturn]] void badSetting(const std::string& message) {
  throw bem::SolverError(bem::SolverError::Kind::kBadCondition, message);
}

/// Adds a sentence to a notice.
void addNotice(std::string& notice, const std::string& text) {
  notice += (notice.empty() ? "" : ". Also, ") + text;
}

class PageMaker {
 public:
  PageMaker(const std::shared_ptr<const TouchModel>& model, const TouchPageSettings& settings,
            const Job& job)
      : settings_(settings), job_(job), quiet_(job), model_(model) {
    quiet_.progress = nullptr;
  }

  TouchPage make() {
    const PageSurface surface(model_, quiet_);
    choosePlaceCount(surface);
    describe(surface);
    chooseRadius(surface);
    PageSolutions solutions(model_, page_.radius, job_);
    findOwn(surface, solutions);
    choosePlaces();
    solvePlaces(surface, solutions);
    measurePageErrors(page_, model_.model(), surface, solutions, kPlacesEnd, job_);
    return std::move(page_);
  }

 private:
  /// As many places as wanted, or as the size allows.
  void choosePlaceCount(const PageSurface& surface) {
    const auto nodes = static_cast<double>(surface.nodeCount()),
               vertices = static_cast<double>(surface.vertexCount());
    placeCount_ = settings_.places;
    while (placeCount_ >= TouchPageSettings::kMinPlaces &&
           pageBytes(nodes, vertices, 2 * vertices, placeCount_) > settings_.megabytes * 1e6)
      --placeCount_;
    if (placeCount_ < TouchPageSettings::kMinPlaces)
      throw bem::SolverError(bem::SolverError::Kind::kTooLarge,
                             "the model has " + countText(nodes) + " nodes; a page of " +
                                 countText(settings_.megabytes) +
                                 " MB cannot hold their displacements for " +
                                 std::to_string(TouchPageSettings::kMinPlaces) +
                                 " touch places. Allow a larger page, or mesh the body with "
                                 "longer edges");
    if (placeCount_ < settings_.places)
      addNotice(page_.notice, "the page has " + std::to_string(placeCount_) +
                                  " touch places instead of " + std::to_string(settings_.places) +
                                  ", to stay below " + countText(settings_.megabytes) +
                                  " MB; allow a larger page, or mesh the body with longer edges, "
                                  "for more");
  }

  void describe(const PageSurface& surface) {
    const BoundarySetup& setup = model_.model().setup();
    page_.material = setup.material;
    page_.modelNodes = setup.mesh().nodeCount();
    page_.modelTriangles = setup.mesh().triangleCount();
    surface.describe(page_);
    const Eigen::VectorXd loaded = surface.vertexField(model_.base().u.col(0));
    for (Index row = 0; row < loaded.size(); row += 3)
      page_.loaded.push_back(loaded.segment<3>(row).cast<float>());
    page_.meanLoaded = page_.loaded;
    isUsed_.assign(page_.positions.size(), false);
    for (std::size_t t = 0; t < page_.triangles.size(); ++t)
      for (const std::uint16_t corner : page_.triangles[t])
        if (page_.isTouchable[t]) isUsed_[corner] = true;
  }

  /// One radius for all touches, so that a force depends on the place alone and not on the mesh.
  void chooseRadius(const PageSurface& surface) {
    page_.radius = settings_.radius;
    for (std::size_t v = 0; v < page_.positions.size(); ++v)
      if (isUsed_[v])
        page_.radius = std::max(page_.radius, model_.surface().narrowestMask(surface.atVertex(v)));
  }

  static std::array<float, 6> numbersOf(const Matrix3d& s) {
    const Eigen::Matrix3f f = s.cast<float>();
    return {f(0, 0), f(1, 1), f(2, 2), f(0, 1), f(0, 2), f(1, 2)};
  }

  /// The compliances of single touches at vertices, edges and middles. A triangle can be touched if
  /// it has all of them.
  void findOwn(const PageSurface& surface, PageSolutions& solutions) {
    isFree_.assign(page_.positions.size(), false);
    page_.own.resize(page_.positions.size());
    for (std::size_t v = 0; v < page_.positions.size(); ++v) {
      const auto own = isUsed_[v] ? solutions.own(surface.atVertex(v)) : std::nullopt;
      if (!own) continue;
      isFree_[v] = true;
      page_.own[v] = numbersOf(own->compliance);
      page_.meanLoaded[v] = own->loaded.cast<float>();
    }
    job_.throwIfCancelled();
    std::vector<bool> hasEdge;
    for (const TouchPage::Point& middle : surface.edgeMiddles()) {
      const auto own = solutions.own(surface.at(middle));
      hasEdge.push_back(own.has_value());
      page_.ownAtEdges.push_back(own ? numbersOf(own->compliance) : std::array<float, 6>{});
      page_.meanLoadedAtEdges.emplace_back(own ? own->loaded.cast<float>()
                                               : Eigen::Vector3f(Eigen::Vector3f::Zero()));
      job_.throwIfCancelled();
    }
    page_.ownAtMiddles.resize(page_.triangles.size());
    page_.meanLoadedAtMiddles.assign(page_.triangles.size(), Eigen::Vector3f::Zero());
    for (std::size_t t = 0; t < page_.triangles.size(); ++t) {
      if (!page_.isTouchable[t]) continue;
      const auto own = solutions.own(surface.at({static_cast<int>(t)}));
      page_.isTouchable[t] = own.has_value();
      for (std::size_t k = 0; k < 3; ++k)
        if (!isFree_[page_.triangles[t][k]] || !hasEdge[page_.edges[t][k]])
          page_.isTouchable[t] = false;
      if (own) {
        page_.ownAtMiddles[t] = numbersOf(own->compliance);
        page_.meanLoadedAtMiddles[t] = own->loaded.cast<float>();
      }
      job_.throwIfCancelled();
    }
    if (std::find(page_.isTouchable.begin(), page_.isTouchable.end(), 1) == page_.isTouchable.end())
      badSetting(
          "supports cover the whole surface, so that nothing is left to touch; free a part of it");
    job_.report(Phase::kTouch, kOwnEnd);
  }

  OrientedPoint oriented(std::size_t v) const {
    return {page_.positions[v].cast<double>(), page_.normals[v].cast<double>()};
  }

  void choosePlaces() {
    std::vector<OrientedPoint> free;
    std::vector<std::uint16_t> vertexOf;
    for (std::size_t v = 0; v < page_.positions.size(); ++v) {
      if (!isFree_[v]) continue;
      free.push_back(oriented(v));
      vertexOf.push_back(static_cast<std::uint16_t>(v));
    }
    for (const int k : spreadPlaces(free, placeCount_, page_.radius)) {
      page_.places.push_back(vertexOf[static_cast<std::size_t>(k)]);
      places_.push_back(free[static_cast<std::size_t>(k)]);
    }
  }

  /// Fields and couplings of the places, and with them the weights of the vertices.
  void solvePlaces(const PageSurface& surface, PageSolutions& solutions) {
    const auto count = static_cast<Index>(page_.places.size());
    std::vector<bem::ContactMask> masks(page_.positions.size()), ofPlaces;
    for (std::size_t v = 0; v < masks.size(); ++v)
      if (isFree_[v]) masks[v] = solutions.mask(surface.atVertex(v));
    for (const std::uint16_t v : page_.places) ofPlaces.push_back(masks[v]);
    // Displacements of the masks at all vertices per force at the places.
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(3 * static_cast<Index>(masks.size()), 3 * count);
    solutions.forEach(
        ofPlaces,
        [&](std::size_t k, const Eigen::MatrixXd& u) {
          const Index column = 3 * static_cast<Index>(k);
          for (std::size_t v = 0; v < masks.size(); ++v)
            if (isFree_[v])
              moved.block<3, 3>(3 * static_cast<Index>(v), column) = masks[v].displacement(u);
          for (Index axis = 0; axis < 3; ++axis) page_.fields.add(surface.nodeField(u.col(axis)));
        },
        [&](double fraction) {
          job_.report(Phase::kTouch, kOwnEnd + (kPlacesEnd - kOwnEnd) * fraction);
        },
        job_);
    Eigen::MatrixXd between(3 * count, 3 * count);
    for (Index k = 0; k < count; ++k)
      between.middleRows<3>(3 * k) =
          moved.middleRows<3>(3 * static_cast<Index>(page_.places[static_cast<std::size_t>(k)]));
    between = 0.5 * (between + between.transpose()).eval();
    for (Index column = 0; column < 3 * count; ++column) page_.coupling.add(between.col(column));
    page_.weights.resize(masks.size());
    for (std::size_t v = 0; v < masks.size(); ++v) {
      if (v % 64 == 0) job_.throwIfCancelled();
      if (isFree_[v])
        page_.weights[v] = placeWeights(oriented(v), places_, page_.radius, between,
                                        moved.middleRows<3>(3 * static_cast<Index>(v)));
    }
  }

  const TouchPageSettings& settings_;
  const Job& job_;
  Job quiet_;
  TouchableModel model_;
  TouchPage page_;
  int placeCount_ = 0;
  std::vector<bool> isUsed_, isFree_;  // vertices: of touchable triangles, with a compliance
  std::vector<OrientedPoint> places_;
};

}  // namespace

void TouchPageSettings::validate() const {
  const auto require = [](bool isGood, const std::string& message) {
    if (!isGood) badSetting(message);
  };
  require(places >= kMinPlaces && places <= kMaxPlaces,
          "a page has " + std::to_string(kMinPlaces) + " to " + std::to_string(kMaxPlaces) +
              " touch places, not " + std::to_string(places));
  require(megabytes >= kMinSize && megabytes <= kMaxSize,
          "the size of a page is " + numberText(kMinSize) + " to " + numberText(kMaxSize) +
              " MB, not " + numberText(megabytes));
  require(radius >= 0 && std::isfinite(radius),
          "the radius of touches is " + numberText(radius) + " mm; it must be greater than 0");
}

double pageBytes(double nodes, double vertices, double triangles, double places) {
  constexpr double kOwnText = 60e3;  // script, style and words of the page
  constexpr double kWeights = PlaceWeights::kCount * (2 + 9 * 2) + 4;
  constexpr double kVertex = 4 * 12 + 6 * 4 + kWeights + 3 * 6;
  constexpr double kTriangle = 2 * 3 * 2 + 9 * 4 + 1.5 * 9 * 4 + 2 * 4 + 1;
  const double binary = vertices * kVertex + triangles * kTriangle +
                        2 * (9 * nodes * places + 9 * places * places) + 24 * places;
  return kOwnText + binary * 4 / 3;
}

TouchPage makeTouchPage(const std::shared_ptr<const TouchModel>& model,
                        const TouchPageSettings& settings, const Job& job) {
  settings.validate();
  if (!(settings.radius > 0)) badSetting("a page of a given model needs the radius of its touches");
  return PageMaker(model, settings, job).make();
}

TouchPage makeTouchPage(const modeling::Project& project, const std::string& version,
                        const TouchPageSettings& settings, const Job& job) {
  settings.validate();
  const PageProject chosen = pageProject(project, settings.radius, job);
  TouchPageSettings withRadius = settings;
  withRadius.radius = chosen.radius;
  TouchPage page = makeTouchPage(buildTouchModel(chosen.project, {}, job), withRadius, job);
  page.name = project.name;
  page.materialName = project.material.name;
  page.version = version;
  if (settings.radius > 0 && page.radius > 1.01 * settings.radius)
    addNotice(page.notice, "touches have a radius of " + roundedText(page.radius) +
                               " mm instead of " + numberText(settings.radius) +
                               ", the smallest that the mesh carries everywhere; mesh the body "
                               "with shorter edges, or with triangles, for smaller touches");
  return page;
}

}  // namespace palpa::app

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "app/core/model/build_touch_model.h"
#include "app/core/page/page_project.h"
#include "app/core/page/touch_page.h"
#include "app/core/results/drawn_body.h"
#include "app/core/results/error_estimate.h"
#include "base/count_text.h"
#include "bem/base/error.h"
#include "bem/contact/contact_mask.h"
#include "bem/contact/contact_surface.h"

namespace palpa::app {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Masks that are solved together: enough for the solver to be efficient, few enough to stop soon.
constexpr std::size_t kBlock = 32;
/// Places between vertices at which the errors are measured.
constexpr std::size_t kSamples = 48;
/// From the largest error of the samples to the stated one, because samples miss the worst place.
constexpr double kMargin = 2;
/// Below this the error comes from the 16 bits and the solution without refinement.
constexpr double kMinDeviation = 1e-3;
/// Vertices of a drawn surface that is fine enough on every screen, and that cost little time.
constexpr std::size_t kMaxVertices = 4000;

[[noreturn]] void badSetting(const std::string& message) {
  throw bem::SolverError(bem::SolverError::Kind::kBadCondition, message);
}

class PageMaker {
 public:
  PageMaker(const std::shared_ptr<const TouchModel>& model, const TouchPageSettings& settings,
            const Job& job)
      : model_(*model),
        settings_(settings),
        job_(job),
        quiet_(job),
        surface_(model->setup().discretisation->makeContactSurface(model->problem()->dofs())),
        workspace_(surface_->makeWorkspace()) {
    quiet_.progress = nullptr;
    draw(model);
  }

  TouchPage make() {
    describe();
    linkToNodes();
    makeMasks();
    choosePlaces();
    chooseMiddles();
    chooseSamples();
    solve();
    stateErrors();
    return std::move(page_);
  }

 private:
  /// The field is stored at the nodes, the drawn surface may be finer.
  void draw(const std::shared_ptr<const TouchModel>& model) {
    constexpr int kMaxPieces = 3;
    const auto drawn = [&](int pieces) {
      modeling::DisplaySettings display;
      display.leastPieces = display.mostPieces = pieces;
      return std::make_unique<DrawnBody>(model, display, quiet_);
    };
    atNodes_ = drawn(1);
    const std::size_t nodes = atNodes_->mesh().positions.size();
    int pieces = kMaxPieces;
    while (pieces > 1 && nodes * static_cast<std::size_t>(pieces * pieces) > kMaxVertices) --pieces;
    body_ = drawn(pieces);
    choosePlaceCount(static_cast<double>(nodes),
                     static_cast<double>(body_->mesh().positions.size()));
  }

  /// As many places as wanted, or as the size allows.
  void choosePlaceCount(double nodes, double vertices) {
    constexpr double kMaxNumbered = 65535;
    places_ = settings_.places;
    const auto fits = [&] {
      return vertices <= kMaxNumbered &&
             pageBytes(nodes, vertices, 2 * vertices, places_) <= settings_.megabytes * 1e6;
    };
    while (places_ >= TouchPageSettings::kMinPlaces && !fits()) --places_;
    if (places_ < TouchPageSettings::kMinPlaces)
      throw bem::SolverError(bem::SolverError::Kind::kTooLarge,
                             "the model has " + countText(nodes) + " nodes; a page of " +
                                 countText(settings_.megabytes) +
                                 " MB cannot hold their displacements for " +
                                 std::to_string(TouchPageSettings::kMinPlaces) +
                                 " touch places. Allow a larger page, or mesh the body with "
                                 "longer edges");
    if (places_ < settings_.places)
      page_.notice = "the page has " + std::to_string(places_) + " touch places instead of " +
                     std::to_string(settings_.places) + ", to stay below " +
                     countText(settings_.megabytes) +
                     " MB; allow a larger page, or mesh the body with longer edges, for more";
  }

  /// The nodes whose displacements give the one of a drawn vertex.
  void linkToNodes() {
    const modeling::DisplayMesh& nodes = atNodes_->mesh();
    for (const auto& link : body_->mesh().links) {
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
      page_.nodes.push_back(linked);
      page_.nodeWeights.push_back(weights);
    }
    page_.nodeCount = static_cast<int>(nodes.positions.size());
    page_.isHeld.assign(body_->mesh().positions.size(), 1);
  }

  void describe() {
    const BoundarySetup& setup = model_.setup();
    page_.material = setup.material;
    page_.radius = settings_.radius;
    page_.modelNodes = setup.mesh().nodeCount();
    page_.modelTriangles = setup.mesh().triangleCount();
    const modeling::DisplayMesh& drawn = body_->mesh();
    for (std::size_t k = 0; k < drawn.positions.size(); ++k) {
      page_.positions.push_back(drawn.positions[k].cast<float>());
      page_.normals.push_back(drawn.normals[k].cast<float>());
    }
    for (const auto& [a, b, c] : drawn.triangles)
      page_.triangles.push_back({static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b),
                                 static_cast<std::uint16_t>(c)});
    for (const Vector3d& each : body_->displacements(model_.rest().field.u.col(0)))
      page_.loaded.push_back(each.cast<float>());
  }

  bem::ContactMask maskAt(const modeling::DisplayMesh::Link& link) {
    bem::ContactMask mask;
    surface_->makeMask(surface_->at(link.triangle, link.weights), page_.radius, *workspace_, mask);
    return mask;  // empty if supports fix the whole place
  }

  void makeMasks() {
    const modeling::DisplayMesh& drawn = body_->mesh();
    std::vector<bool> isUsed(drawn.positions.size(), false);
    for (std::size_t t = 0; t < drawn.triangles.size(); ++t)
      if (!body_->isSupported()[t])
        for (const int corner : drawn.triangles[t]) isUsed[static_cast<std::size_t>(corner)] = true;
    for (std::size_t v = 0; v < drawn.positions.size(); ++v)
      masks_.push_back(isUsed[v] ? maskAt(drawn.links[v]) : bem::ContactMask{});
    for (const bem::ContactMask& mask : masks_) raise(page_.widestMask, mask.radius);
    for (std::size_t v = 0; v < masks_.size(); ++v)
      page_.meanLoaded.push_back(
          isTouchable(v)
              ? Eigen::Vector3f(
                    Vector3d(masks_[v].displacement(model_.rest().field.u)).cast<float>())
              : page_.loaded[v]);
    for (std::size_t t = 0; t < drawn.triangles.size(); ++t)
      page_.isTouchable.push_back(
          !body_->isSupported()[t] &&
          std::all_of(drawn.triangles[t].begin(), drawn.triangles[t].end(),
                      [&](int corner) { return isTouchable(static_cast<std::size_t>(corner)); }));
    page_.own.resize(masks_.size());
  }

  bool isTouchable(std::size_t vertex) const { return !masks_[vertex].nodes.empty(); }

  void choosePlaces() {
    std::vector<OrientedPoint> free;
    std::vector<std::uint16_t> vertexOf;
    const auto oriented = [&](std::size_t v) -> OrientedPoint {
      return {page_.positions[v].cast<double>(), page_.normals[v].cast<double>()};
    };
    for (std::size_t v = 0; v < masks_.size(); ++v) {
      if (!isTouchable(v)) continue;
      free.push_back(oriented(v));
      vertexOf.push_back(static_cast<std::uint16_t>(v));
    }
    if (free.empty())
      badSetting(
          "supports cover the whole surface, so that nothing is left to touch; free a part of it");
    std::vector<OrientedPoint> places;
    placeOfVertex_.assign(masks_.size(), -1);
    for (const int k : spreadPlaces(free, places_, page_.radius)) {
      const std::uint16_t vertex = vertexOf[static_cast<std::size_t>(k)];
      placeOfVertex_[vertex] = static_cast<int>(page_.places.size());
      page_.places.push_back(vertex);
      places.push_back(free[static_cast<std::size_t>(k)]);
    }
    for (std::size_t v = 0; v < masks_.size(); ++v)
      page_.weights.push_back(weightsAt(oriented(v), places, page_.radius));
  }

  /// The mask at a point of a drawn triangle.
  bem::ContactMask maskAt(const TouchPage::Point& point) {
    modeling::DisplayMesh::Link link;
    const auto triangle = static_cast<std::size_t>(point.triangle);
    link.triangle = body_->mesh().boundaryTriangle[triangle];
    for (std::size_t k = 0; k < 3; ++k)
      link.weights += point.weights[static_cast<Index>(k)] *
                      linkIn(body_->mesh(), link.triangle, body_->mesh().triangles[triangle][k]);
    return maskAt(link);
  }

  /// Places between those where the compliance is known: on edges and around the middles.
  void chooseSamples() {
    const std::array<Vector3d, 3> where{Vector3d(0.5, 0.5, 0), Vector3d(0.6, 0.2, 0.2),
                                        Vector3d(0.15, 0.7, 0.15)};
    const std::size_t count = std::min(kSamples, touchable_.size());
    for (std::size_t k = 0; k < count; ++k) {
      const TouchPage::Point point{touchable_[(2 * k + 1) * touchable_.size() / (2 * count)],
                                   where[k % where.size()]};
      bem::ContactMask mask = maskAt(point);
      if (mask.nodes.empty()) continue;
      samples_.push_back(point);
      sampleMasks_.push_back(std::move(mask));
    }
    crossings_.resize(samples_.size());
  }

  /// Triangles that can be touched, and the masks at their middles.
  void chooseMiddles() {
    for (std::size_t t = 0; t < page_.isTouchable.size(); ++t) {
      if (!page_.isTouchable[t]) continue;
      bem::ContactMask mask = maskAt(TouchPage::Point{static_cast<int>(t)});
      page_.isTouchable[t] = !mask.nodes.empty();
      if (mask.nodes.empty()) continue;
      touchable_.push_back(static_cast<int>(t));
      middleMasks_.push_back(std::move(mask));
    }
    page_.ownAtMiddles.resize(page_.triangles.size());
    page_.forceErrors.resize(page_.triangles.size());
  }

  /// Barycentric coordinates of a drawn vertex in one of the boundary triangles around it.
  Vector3d linkIn(const modeling::DisplayMesh& drawn, int boundaryTriangle, int vertex) const {
    const auto& link = drawn.links[static_cast<std::size_t>(vertex)];
    if (link.triangle == boundaryTriangle) return link.weights;
    const auto& from = model_.surface().triangles[static_cast<std::size_t>(link.triangle)];
    const auto& to = model_.surface().triangles[static_cast<std::size_t>(boundaryTriangle)];
    Vector3d weights = Vector3d::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        if (from[i] == to[k]) weights[static_cast<Index>(k)] += link.weights[static_cast<Index>(i)];
    return weights / weights.sum();
  }

  /// Displacements for unit forces along x, y and z on each of some masks.
  Eigen::MatrixXd unitFields(std::span<const bem::ContactMask* const> masks,
                             bem::ReferenceProblem::Effort effort) const {
    const auto columns = 3 * static_cast<Index>(masks.size());
    const bem::BoundaryField& rest = model_.rest().field;
    bem::BoundaryField known{Eigen::MatrixXd::Zero(rest.u.rows(), columns),
                             Eigen::MatrixXd::Zero(rest.p.rows(), columns)};
    const std::vector<int>& firstSlot = surface_->slots().firstOfNode;
    for (std::size_t m = 0; m < masks.size(); ++m)
      for (std::size_t k = 0; k < masks[m]->nodes.size(); ++k) {
        const auto node = static_cast<std::size_t>(masks[m]->nodes[k]);
        for (int slot = firstSlot[node]; slot < firstSlot[node + 1]; ++slot)
          known.p.block<3, 3>(3 * static_cast<Index>(slot), 3 * static_cast<Index>(m)) =
              masks[m]->traction[k] * Matrix3d::Identity();
      }
    return model_.problem()->solveField(known, effort, quiet_).u;
  }

  /// Places are solved with refinement, as playTouches() does; other vertices without, which
  /// changes five digits less than the 16 bits of the file.
  void solve() {
    std::vector<int> others;
    for (std::size_t v = 0; v < masks_.size(); ++v)
      if (isTouchable(v) && placeOfVertex_[v] < 0) others.push_back(static_cast<int>(v));
    const std::vector<int> places(page_.places.begin(), page_.places.end());
    std::vector<int> middles(middleMasks_.size()), samples(samples_.size());
    std::iota(middles.begin(), middles.end(), 0);
    std::iota(samples.begin(), samples.end(), 0);
    total_ = static_cast<double>(places.size() + others.size() + middles.size() + samples.size());
    forBlocks(places, bem::ReferenceProblem::Effort::kRefined, masks_,
              [&](int vertex, const Eigen::MatrixXd& u) {
                const auto v = static_cast<std::size_t>(vertex);
                page_.own[v] = ownOf(masks_[v], u);
                addPlace(v, u);
              });
    forBlocks(others, bem::ReferenceProblem::Effort::kFast, masks_,
              [&](int vertex, const Eigen::MatrixXd& u) {
                const auto v = static_cast<std::size_t>(vertex);
                page_.own[v] = ownOf(masks_[v], u);
              });
    forBlocks(middles, bem::ReferenceProblem::Effort::kFast, middleMasks_,
              [&](int k, const Eigen::MatrixXd& u) {
                const auto t = static_cast<std::size_t>(touchable_[static_cast<std::size_t>(k)]);
                page_.ownAtMiddles[t] = ownOf(middleMasks_[static_cast<std::size_t>(k)], u);
              });
    findDeviations();
    forBlocks(samples, bem::ReferenceProblem::Effort::kRefined, sampleMasks_,
              [&](int k, const Eigen::MatrixXd& u) { measure(static_cast<std::size_t>(k), u); });
  }

  template <class Use>
  void forBlocks(const std::vector<int>& which, bem::ReferenceProblem::Effort effort,
                 const std::vector<bem::ContactMask>& masks, const Use& use) {
    for (std::size_t first = 0; first < which.size(); first += kBlock) {
      job_.throwIfCancelled();
      const std::size_t count = std::min(kBlock, which.size() - first);
      std::vector<const bem::ContactMask*> block;
      for (std::size_t k = 0; k < count; ++k)
        block.push_back(&masks[static_cast<std::size_t>(which[first + k])]);
      const Eigen::MatrixXd u = unitFields(block, effort);
      for (std::size_t k = 0; k < count; ++k)
        use(which[first + k], u.middleCols<3>(3 * static_cast<Index>(k)));
      done_ += static_cast<double>(count);
      job_.report(Phase::kGreensFunction, done_ / total_);
    }
  }

  static std::array<float, 6> ownOf(const bem::ContactMask& mask, const Eigen::MatrixXd& u) {
    const Matrix3d s = mask.displacement(u);
    const Eigen::Matrix3f f = (0.5 * (s + s.transpose())).cast<float>();
    return {f(0, 0), f(1, 1), f(2, 2), f(0, 1), f(0, 2), f(1, 2)};
  }

  static double largest(const Matrix3d& matrix) { return matrix.jacobiSvd().singularValues()[0]; }

  /// Relative error of forces of all unit displacements: f_page - f = (S_page^-1 S - 1) f.
  static double forceError(const Matrix3d& ofPage, const Matrix3d& exact) {
    return largest(ofPage.ldlt().solve(exact) - Matrix3d::Identity());
  }

  /// How much the compliance bends: the error in the middle of a triangle if it were interpolated
  /// between the corners. The largest one of the triangles around.
  void findDeviations() {
    std::vector<double> around(page_.positions.size(), 0.0);
    for (const int t : touchable_) {
      const auto& corners = page_.triangles[static_cast<std::size_t>(t)];
      Matrix3d mean = Matrix3d::Zero();
      for (const std::uint16_t corner : corners)
        mean += TouchPage::symmetric(page_.own[corner]) / 3;
      const double here =
          forceError(mean, TouchPage::symmetric(page_.ownAtMiddles[static_cast<std::size_t>(t)]));
      for (const std::uint16_t corner : corners) raise(around[corner], here);
    }
    deviations_.assign(page_.triangles.size(), 0.0);
    for (const int t : touchable_) {
      double& deviation = deviations_[static_cast<std::size_t>(t)];
      deviation = kMinDeviation;
      for (const std::uint16_t corner : page_.triangles[static_cast<std::size_t>(t)])
        raise(deviation, around[corner]);
    }
  }

  static Eigen::VectorXd drawnField(const DrawnBody& body, const Eigen::VectorXd& u) {
    Eigen::VectorXd field(3 * static_cast<Index>(body.mesh().positions.size()));
    Index row = 0;
    for (const Vector3d& each : body.displacements(u)) {
      field.segment<3>(row) = each;
      row += 3;
    }
    return field;
  }

  /// Displacements of the nodes for a unit force, without the kernel.
  Eigen::VectorXd remainder(std::size_t here, Index axis, const Eigen::VectorXd& u) const {
    Eigen::VectorXd field = drawnField(*atNodes_, u);
    for (std::size_t node = 0; node < atNodes_->mesh().positions.size(); ++node)
      field.segment<3>(3 * static_cast<Index>(node)) -=
          page_
              .kernel(
                  page_.normals[here].cast<double>(),
                  (atNodes_->mesh().positions[node] - page_.positions[here].cast<double>()).norm(),
                  page_.coreAtPoints())
              .col(axis);
    return field;
  }

  /// Vertices that no touch moves are held by supports.
  void releaseMoved(const Eigen::VectorXd& u, double most) {
    constexpr double kStill = 1e-4;
    const Eigen::VectorXd field = drawnField(*body_, u);
    for (std::size_t v = 0; v < page_.isHeld.size(); ++v)
      if (field.segment<3>(3 * static_cast<Index>(v)).norm() > kStill * most) page_.isHeld[v] = 0;
  }

  void addPlace(std::size_t here, const Eigen::MatrixXd& u) {
    Eigen::MatrixXd block(3 * static_cast<Index>(page_.places.size()), 3);
    for (std::size_t i = 0; i < page_.places.size(); ++i) {
      const std::size_t there = page_.places[i];
      block.middleRows<3>(3 * static_cast<Index>(i)) =
          masks_[there].displacement(u) - page_.meanKernel(page_.positions[there].cast<double>(),
                                                           page_.normals[there].cast<double>(),
                                                           page_.positions[here].cast<double>(),
                                                           page_.normals[here].cast<double>());
    }
    for (Index axis = 0; axis < 3; ++axis) {
      page_.coupling.add(block.col(axis));
      page_.fields.add(remainder(here, axis, u.col(axis)));
      releaseMoved(u.col(axis), largest(TouchPage::symmetric(page_.own[here])));
    }
    for (std::size_t k = 0; k < samples_.size(); ++k)
      crossings_[k].push_back(sampleMasks_[k].displacement(u));
  }

  /// Compares the page with a full solution at a place between the vertices.
  void measure(std::size_t k, const Eigen::MatrixXd& u) {
    const TouchPage::Point& at = samples_[k];
    const Matrix3d full = sampleMasks_[k].displacement(u);
    const Matrix3d exact = 0.5 * (full + full.transpose());
    raise(ratio_, forceError(page_.ownCompliance(at), exact) /
                      deviations_[static_cast<std::size_t>(at.triangle)]);
    for (std::size_t j = 0; j < page_.places.size(); ++j) {
      const TouchPage::Point place = vertexPoint(page_.places[j]);
      const bool isNear =
          (page_.positionOf(place) - page_.positionOf(at)).norm() < 2 * page_.radius;
      raise(isNear ? page_.errors.couplingNear : page_.errors.coupling,
            largest(page_.couplingOf(at, place) - crossings_[k][j]) / largest(exact));
    }
    Eigen::MatrixXd field(3 * static_cast<Index>(page_.positions.size()), 3);
    for (Index axis = 0; axis < 3; ++axis) field.col(axis) = drawnField(*body_, u.col(axis));
    double worst = 0;
    for (std::size_t v = 0; v < page_.positions.size(); ++v)
      raise(worst, largest(page_.fieldAt(v, at) - field.middleRows<3>(3 * static_cast<Index>(v))) /
                       largest(exact));
    fieldErrors_.push_back(worst);
  }

  static void raise(double& most, double value) { most = std::max(most, value); }

  /// A vertex as a point of one of its triangles.
  TouchPage::Point vertexPoint(std::size_t vertex) {
    if (triangleOfVertex_.empty()) {
      triangleOfVertex_.resize(page_.positions.size());
      for (std::size_t t = 0; t < page_.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
          triangleOfVertex_[page_.triangles[t][k]] = {static_cast<int>(t),
                                                      Vector3d::Unit(static_cast<Index>(k))};
    }
    return triangleOfVertex_[vertex];
  }

  void stateErrors() {
    TouchPage::Errors& errors = page_.errors;
    for (double* error : {&errors.couplingNear, &errors.coupling}) *error *= kMargin;
    std::sort(fieldErrors_.begin(), fieldErrors_.end());
    if (!fieldErrors_.empty()) {
      errors.typicalField = fieldErrors_[fieldErrors_.size() / 2];
      errors.field = kMargin * fieldErrors_.back();
    }
    for (const int t : touchable_)
      page_.forceErrors[static_cast<std::size_t>(t)] =
          static_cast<float>(kMargin * ratio_ * deviations_[static_cast<std::size_t>(t)]);
    std::vector<float> sorted;
    for (const int t : touchable_) sorted.push_back(page_.forceErrors[static_cast<std::size_t>(t)]);
    std::sort(sorted.begin(), sorted.end());
    errors.force = sorted.empty() ? 0 : sorted.back();
    errors.typicalForce = sorted.empty() ? 0 : sorted[sorted.size() / 2];
    errors.samples = static_cast<int>(samples_.size());
    errors.model = estimateTouchError(model_, job_).relative;
  }

  const TouchModel& model_;
  const TouchPageSettings& settings_;
  const Job& job_;
  Job quiet_;
  std::unique_ptr<bem::ContactSurface> surface_;
  std::unique_ptr<bem::ContactSurface::Workspace> workspace_;
  std::unique_ptr<DrawnBody> atNodes_, body_;
  int places_ = 0;
  TouchPage page_;
  std::vector<bem::ContactMask> masks_;  // per vertex; empty where nothing can be touched
  std::vector<int> placeOfVertex_;
  std::vector<TouchPage::Point> samples_, triangleOfVertex_;
  std::vector<bem::ContactMask> sampleMasks_, middleMasks_;
  std::vector<int> touchable_;       // triangles
  std::vector<double> deviations_;   // per triangle
  std::vector<double> fieldErrors_;  // per sample, at the worst vertex
  double ratio_ = 0;                 // largest error of a sample over the deviation there
  /// Per sample, for each place: displacement of the sample per force on the place.
  std::vector<std::vector<Matrix3d>> crossings_;
  double done_ = 0, total_ = 1;
};

}  // namespace

void TouchPageSettings::validate() const {
  const auto require = [](bool isGood, const std::string& message) {
    if (!isGood) badSetting(message);
  };
  require(places >= kMinPlaces && places <= kMaxPlaces,
          "a page has 8 to 1000 touch places, not " + std::to_string(places));
  require(megabytes >= kMinSize && megabytes <= kMaxSize,
          "the size of a page is 1 to 100 MB, not " + std::to_string(megabytes));
  require(radius >= 0 && std::isfinite(radius),
          "the radius of touches is " + std::to_string(radius) + " mm; it must be greater than 0");
}

double pageBytes(double nodes, double vertices, double triangles, double places) {
  constexpr double kOwnText = 60e3;  // script, style and words of the page
  constexpr double kVertex = 4 * 12 + 6 * 4 + PlaceWeights::kCount * 6 + 3 * 6 + 1, kTriangle = 35;
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
  return page;
}

}  // namespace palpa::app

// Pages that can be touched: their numbers against full solutions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "app/core/model/build_touch_model.h"
#include "app/core/page/make_touch_page.h"
#include "app/core/page/page_project.h"
#include "app/core/page/touch_page_file.h"
#include "app/core/results/touch.h"
#include "bem/base/error.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Made {
  std::shared_ptr<const TouchModel> model;
  TouchPage page;
};

Made makePage(const modeling::Project& project, int places) {
  const PageProject chosen = pageProject(project, 0, {});
  TouchPageSettings settings;
  settings.places = places;
  settings.radius = chosen.radius;
  auto model = buildTouchModel(chosen.project, {}, {});
  return {model, makeTouchPage(model, settings)};
}

const Made& cylinder() {
  static const Made made = [] {
    modeling::Project project = test::clampedCylinder(9);
    project.mesh.accuracy = 0.05;  // pages are compared with solutions of the same model
    // A load, so that displacements without touches matter.
    project.loads = {{"wind", modeling::Bump{{20, 0, 30}, 12, 0.004, {-1, 0, 0.3}}}};
    return makePage(project, 120);
  }();
  return made;
}

class RandomPoints {
 public:
  explicit RandomPoints(const TouchPage& page) : page_(page) {
    for (std::size_t t = 0; t < page.triangles.size(); ++t)
      if (page.isTouchable[t]) triangles_.push_back(static_cast<int>(t));
  }
  TouchPage::Point next() {
    const std::size_t k =
        std::uniform_int_distribution<std::size_t>(0, triangles_.size() - 1)(generator_);
    Vector3d weights{uniform_(generator_), uniform_(generator_), uniform_(generator_)};
    return {triangles_[k], weights / weights.sum()};
  }
  Vector3d displacement(const TouchPage::Point& at) {
    const Vector3d aside{uniform_(generator_), uniform_(generator_), uniform_(generator_)};
    return 0.1 * page_.radius * (aside - Vector3d::Constant(0.5) - page_.normalOf(at));
  }

 private:
  const TouchPage& page_;
  std::vector<int> triangles_;
  std::mt19937 generator_{7};
  std::uniform_real_distribution<double> uniform_{0.02, 1};
};

modeling::Touch grab(const TouchPage& page, const TouchPage::Point& at, const Vector3d& to) {
  modeling::Touch touch;
  touch.at = page.positionOf(at);
  touch.radius = page.radius;
  touch.vector = to;
  return touch;
}

/// Compares forces of touches at random drawn places with full solutions of the same model.
/// Returns the median of the relative errors.
double expectForcesWithinStated(const Made& made) {
  const auto& [model, page] = made;
  RandomPoints random(page);
  std::vector<double> errors;
  for (int k = 0; k < 40; ++k) {
    const TouchPage::Point at = random.next();
    const Vector3d to = random.displacement(at);
    const modeling::Touch touch = grab(page, at, to);
    const Vector3d exact = playTouches(*model, std::span(&touch, 1)).contacts[0].force;
    const Vector3d found = page.forces(std::span(&at, 1), std::span(&to, 1))[0];
    errors.push_back((found - exact).norm() / exact.norm());
    EXPECT_LT(errors.back(), page.forceErrors[static_cast<std::size_t>(at.triangle)])
        << "at " << touch.at.transpose();
  }
  std::sort(errors.begin(), errors.end());
  return errors[errors.size() / 2];
}

TEST(Page, ForcesOfOneTouchAreWithinTheStatedError) {
  EXPECT_LT(expectForcesWithinStated(cylinder()), 0.002);
  EXPECT_LT(cylinder().page.errors.typicalForce, 0.02);
  EXPECT_GT(cylinder().page.errors.model, 0);
}

// The mesh of a sphere is inside the sphere: a drawn point is beside the point of the mesh with the
// same coordinates.
TEST(Page, DrawnPointsBetweenNodesAreWhereTouchesAre) {
  EXPECT_LT(expectForcesWithinStated(makePage(test::clampedSphere(6), 20)), 0.002);
}

TEST(Page, ForcesOfTwoTouchesAreNearFullSolutions) {
  const auto& [model, page] = cylinder();
  RandomPoints random(page);
  int compared = 0;
  while (compared < 15) {
    const std::array at{random.next(), random.next()};
    if ((page.positionOf(at[0]) - page.positionOf(at[1])).norm() < 2 * page.radius) continue;
    ++compared;
    const std::array to{random.displacement(at[0]), random.displacement(at[1])};
    const std::array touches{grab(page, at[0], to[0]), grab(page, at[1], to[1])};
    const TouchState exact = playTouches(*model, touches);
    const auto found = page.forces(at, to);
    const std::array size{TouchPage::sizeOf(page.ownCompliance(at[0])),
                          TouchPage::sizeOf(page.ownCompliance(at[1]))};
    const double moved =
        page.errors.coupling[page.couplingClass(page.positionOf(at[0]), page.positionOf(at[1]))] *
        std::sqrt(size[0] * size[1]);
    // What one touch moves the other, over the compliance there; twice for the inverse.
    for (std::size_t k = 0; k < 2; ++k) {
      const double own = page.forceErrors[static_cast<std::size_t>(at[k].triangle)];
      const double stated = own * exact.contacts[k].force.norm() +
                            2 * moved / size[k] * exact.contacts[1 - k].force.norm();
      EXPECT_LT((found[k] - exact.contacts[k].force).norm(),
                stated + 0.02 * exact.contacts[k].force.norm());
    }
  }
}

TEST(Page, DisplacementsFollowTheTouch) {
  const auto& [model, page] = cylinder();
  RandomPoints random(page);
  for (int k = 0; k < 10; ++k) {
    const TouchPage::Point at = random.next();
    const Vector3d to = random.displacement(at);
    const Vector3d force = page.forces(std::span(&at, 1), std::span(&to, 1))[0];
    const modeling::Touch touch = grab(page, at, to);
    const TouchState exact = playTouches(*model, std::span(&touch, 1));
    const bem::Discretisation& on = *model->setup().discretisation;
    const Eigen::VectorXd moved = page.fieldOf(at) * force;
    double worst = 0;
    for (std::size_t v = 0; v < page.positions.size(); v += 7) {
      const auto place =
          bem::nearestSurfacePoint(model->setup().mesh(), page.positions[v].cast<double>());
      const Vector3d found =
          moved.segment<3>(3 * static_cast<Eigen::Index>(v)) + page.loaded[v].cast<double>();
      worst = std::max(worst, (found - on.interpolate(place, exact.field.u.col(0))).norm());
    }
    EXPECT_LT(worst, page.errors.field * to.norm() + 0.02 * to.norm());
  }
}

std::vector<OrientedPoint> flatPlaces(int count) {
  std::vector<OrientedPoint> points;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x)
      points.push_back({Vector3d(x + 0.3 * std::sin(3.0 * y), y, 0), Vector3d::UnitZ()});
  std::vector<OrientedPoint> places;
  for (const int k : spreadPlaces(points, count, 1))
    places.push_back(points[static_cast<std::size_t>(k)]);
  return places;
}

TEST(Page, PlacesAreSpread) {
  const std::vector<OrientedPoint> places = flatPlaces(50);
  ASSERT_EQ(places.size(), 50U);
  double closest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      closest = std::min(closest, (places[a].position - places[b].position).norm());
  // 400 mm² for 50 places: 2.8 mm apart on a grid.
  EXPECT_GT(closest, 1.9);
}

/// A compliance that falls with the distance like the one of a solid, mm/N.
Matrix3d kernel(const Vector3d& a, const Vector3d& b) {
  return Matrix3d(Vector3d(1, 1.2, 1.5).asDiagonal()) / (2 + (a - b).norm());
}

TEST(Page, WeightsReplaceAForceAtAPoint) {
  const std::vector<OrientedPoint> places = flatPlaces(50);
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd between(3 * count, 3 * count);
  for (Eigen::Index a = 0; a < count; ++a)
    for (Eigen::Index b = 0; b < count; ++b)
      between.block<3, 3>(3 * a, 3 * b) = kernel(places[static_cast<std::size_t>(a)].position,
                                                 places[static_cast<std::size_t>(b)].position);
  const auto weightsOf = [&](const OrientedPoint& point) {
    Eigen::MatrixXd toPoint(3, 3 * count);
    for (Eigen::Index b = 0; b < count; ++b)
      toPoint.middleCols<3>(3 * b) =
          kernel(point.position, places[static_cast<std::size_t>(b)].position);
    return placeWeights(point, places, 1, between, toPoint);
  };
  const OrientedPoint point{{9.3, 8.1, 0}, Vector3d::UnitZ()};
  const PlaceWeights weights = weightsOf(point);
  for (std::size_t far = 0; far < places.size(); ++far) {
    const Vector3d& at = places[far].position;
    if ((at - point.position).norm() < 9) continue;
    Matrix3d replaced = Matrix3d::Zero();
    for (std::size_t k = 0; k < PlaceWeights::kCount; ++k)
      replaced += kernel(at, places[weights.places[k]].position) * weights.at(k);
    EXPECT_LT((replaced - kernel(at, point.position)).norm(), 0.01 * kernel(at, at).norm());
  }
  const PlaceWeights own = weightsOf(places[3]);
  for (std::size_t k = 0; k < PlaceWeights::kCount; ++k)
    EXPECT_LT((own.at(k) - (own.places[k] == 3 ? 1.0 : 0.0) * Matrix3d::Identity()).norm(), 1e-3);
}

TEST(Page, TwoSidesOfAThinPlateAreFarFromEachOther) {
  const OrientedPoint above{{0, 0, 0.5}, Vector3d::UnitZ()},
      below{{0, 0, -0.5}, -Vector3d::UnitZ()};
  EXPECT_NEAR(orientedDistance(above, below, 6), std::sqrt(1 + 4 * 36), 1e-12);
}

TEST(Page, SixteenBitsAreWithinHalfAScale) {
  Eigen::VectorXd column(1000);
  for (Eigen::Index k = 0; k < column.size(); ++k)
    column[k] = std::sin(0.37 * k) * std::exp(-0.01 * k);
  QuantisedColumns columns;
  columns.add(Eigen::VectorXd::Zero(1000));
  columns.add(column);
  for (Eigen::Index k = 0; k < column.size(); ++k) {
    EXPECT_EQ(columns.at(k, 0), 0);
    EXPECT_LE(std::abs(columns.at(k, 1) - column[k]), 0.5001 * columns.scales[1]);
  }
  EXPECT_LT(columns.scales[1] / 2, 1.6e-5 * column.cwiseAbs().maxCoeff());
}

TEST(Page, BytesBecomeTheTextOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Page, TheFileNeedsNothingElseAndNamesCannotBreakIt) {
  TouchPage page = cylinder().page;
  page.name = "</script><script>alert(1)</script> /*view*/";
  const std::string text = touchPageText(page);
  EXPECT_EQ(text.find("<script>alert"), std::string::npos);
  for (const char* outside : {"http://", "https://", "src=", "@import", "url(", "fetch("})
    EXPECT_EQ(text.find(outside), std::string::npos) << outside;
  for (const char* mark :
       {"/*style*/", "/*numbers*/", "/*model*/", "/*view*/", "/*script*/", "/*data*/", "/*bytes*/"})
    EXPECT_EQ(text.find(mark), std::string::npos) << mark;
  EXPECT_NE(text.find("class View"), std::string::npos);
  const double expected = pageBytes(page.nodeCount, static_cast<double>(page.positions.size()),
                                    static_cast<double>(page.triangles.size()),
                                    static_cast<double>(page.places.size()));
  EXPECT_NEAR(static_cast<double>(text.size()), expected, 0.02 * expected);
}

TEST(Page, NumbersOutOfRangeAreRefused) {
  const auto& model = cylinder().model;
  TouchPageSettings settings;
  settings.radius = 12;
  settings.places = 7;
  EXPECT_THROW(makeTouchPage(model, settings), bem::SolverError);
  settings.places = 100;
  settings.megabytes = 0.5;
  EXPECT_THROW(makeTouchPage(model, settings), bem::SolverError);
  settings.megabytes = 2;
  const TouchPage small = makeTouchPage(model, settings);
  EXPECT_LT(small.places.size(), 100U);
  EXPECT_NE(small.notice.find("touch places instead of 100"), std::string::npos);
}

}  // namespace
}  // namespace palpa::app

#include "app/report/state_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "app/report/dimensions.h"
#include "app/report/drawn_surface.h"
#include "app/report/numbers.h"
#include "app/report/text.h"
#include "app/view/scene/arrows.h"
#include "app/view/scene/gradient_arrows.h"
#include "app/view/scene/ticks.h"
#include "bem/model/surface_point.h"

namespace palpa::report {
namespace {

using Eigen::Vector3d;
using view::ForceArrow;
using Status = app::TouchState::Status;

constexpr int kRingPieces = 48;
/// Small forces beside large ones stay visible.
constexpr double kMinShare = 0.25;

/// Three digits, or fewer where the relative error makes them uncertain.
std::string forceLabel(const Vector3d& force, std::optional<double> error = {}) {
  constexpr double kKnown = 1e-3;
  const double size = force.norm();
  return (error > kKnown ? rounded(size, *error) : view::threeDigits(size)) + " N";
}

/// Where a surface point is drawn, and the outward normal there.
struct DrawnPoint {
  Vector3d position;
  Vector3d normal;
};

DrawnPoint drawnPoint(const Vector3d& at, const app::TouchModel& model,
                      const app::TouchState& state, double scale) {
  const bem::BoundaryMesh& mesh = model.setup().mesh();
  const bem::SurfacePoint point = bem::nearestSurfacePoint(mesh, at);
  return {point.position +
              scale * model.setup().discretisation->interpolate(point, state.field.u.col(0)),
          mesh.normal(point.triangle)};
}

/// The circle about a contact, projected onto the surface, as displaced.
view::ContactRing ring(const app::TouchState::Contact& contact, double radius,
                       const app::TouchModel& model, const app::TouchState& state, double scale) {
  const Vector3d x = contact.normal.unitOrthogonal(), y = contact.normal.cross(x);
  view::ContactRing ring{{}, ringStateOf(contact.status)};
  for (int i = 0; i < kRingPieces; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRingPieces;
    const Vector3d at = contact.at + radius * (std::cos(angle) * x + std::sin(angle) * y);
    ring.points.push_back(drawnPoint(at, model, state, scale).position);
  }
  return ring;
}

void addContacts(const app::TouchModel& model, const app::TouchState& state, double scale,
                 view::Picture& picture) {
  for (const auto& contact : state.contacts) {
    const DrawnPoint drawn = drawnPoint(contact.at, model, state, scale);
    // A pressing force ends on the surface; any other leaves it.
    const bool presses = contact.force.dot(drawn.normal) < 0;
    picture.arrows.arrows.push_back(
        {drawn.position, contact.force,
         presses ? ForceArrow::Anchor::kTip : ForceArrow::Anchor::kTail, ForceArrow::Role::kApplied,
         forceLabel(contact.force,
                    contact.hasGivenForce() ? std::nullopt : contact.errorEstimate)});
    const bool isBall = contact.isBall();
    if (isBall)
      picture.balls.push_back({contact.tool + (scale - 1) * contact.displacement, contact.radius});
    const double radius = isBall ? contact.patchRadius() : contact.radius;
    if (radius > 0 && contact.force.norm() > 0)
      picture.rings.push_back(ring(contact, radius, model, state, scale));
  }
}

/// `project` has the loads of the setup, in the same order.
void addLoads(const modeling::Project& project, const app::TouchModel& model,
              const app::TouchState& state, double scale, view::Picture& picture) {
  for (std::size_t i = 0; i < project.loads.size(); ++i) {
    const app::BoundarySetup::LoadPart& load = model.setup().loads[i];
    const Vector3d force = load.resultant.force;
    if (std::holds_alternative<modeling::Gravity>(project.loads[i].what)) {
      const Vector3d centre = view::volumeCentre(picture.positions, picture.body.triangles);
      picture.arrows.arrows.push_back({centre, force, ForceArrow::Anchor::kTail,
                                       ForceArrow::Role::kApplied, forceLabel(force),
                                       ForceArrow::Kind::kWeight});
      continue;
    }
    const auto* moment = std::get_if<modeling::Moment>(&project.loads[i].what);
    const Vector3d& vector = moment ? moment->moment : force;
    const DrawnPoint drawn = drawnPoint(load.place, model, state, scale);
    const bool presses = vector.dot(drawn.normal) < 0;
    picture.arrows.arrows.push_back(
        {drawn.position, vector, presses ? ForceArrow::Anchor::kTip : ForceArrow::Anchor::kTail,
         ForceArrow::Role::kApplied,
         moment ? view::threeDigits(vector.norm()) + " N mm" : forceLabel(force),
         moment ? ForceArrow::Kind::kMoment : ForceArrow::Kind::kForce});
  }
}

void addReactions(const app::TouchModel& model, const app::TouchState& state,
                  view::Picture& picture) {
  const app::BoundarySetup& setup = model.setup();
  for (std::size_t i = 0; i < setup.supports.size(); ++i) {
    Vector3d center = Vector3d::Zero();
    double area = 0;
    for (const int triangle : setup.supports[i].triangles) {
      const double part = setup.mesh().area(triangle);
      center += part * setup.mesh().point(triangle, Vector3d::Constant(1.0 / 3));
      area += part;
    }
    if (area == 0) continue;
    const Vector3d force = state.supports[i].resultant.force;
    picture.arrows.arrows.push_back({center / area, force, ForceArrow::Anchor::kTip,
                                     ForceArrow::Role::kReaction,
                                     forceLabel(force, state.forceErrorEstimate)});
  }
}

/// Resultants that vanish but for the discretisation (pressure all around) would be drawn as arrows
/// of the smallest length.
void dropNegligible(std::vector<ForceArrow>& arrows, double absolute) {
  std::erase_if(arrows, [&](const ForceArrow& arrow) {
    return arrow.kind != ForceArrow::Kind::kMoment && arrow.force.norm() < absolute;
  });
}

/// The best of four directions around the body, from slightly above or below: the places of the
/// arrows face the eye, and the arrows lie across the view.
Vector3d bestDirection(const app::TouchModel& model, const view::Picture& picture) {
  const Vector3d usual = view::CameraView{}.direction;
  Vector3d best = usual;
  double highest = -1;
  for (const double elevation : {-0.42, 0.42}) {
    for (int i = 0; i < 4; ++i) {
      const double angle = std::atan2(usual.y(), usual.x()) + i * std::numbers::pi / 2;
      const Vector3d direction = Vector3d(std::cos(angle), std::sin(angle), elevation).normalized();
      // Ties go to the usual view: from above, from the front.
      double score = (elevation < 0 ? 0.3 : 0) - 0.05 * i;
      for (const ForceArrow& arrow : picture.arrows.arrows) {
        const bem::SurfacePoint at = bem::nearestSurfacePoint(model.setup().mesh(), arrow.at);
        const double facing = -direction.dot(model.setup().mesh().normal(at.triangle));
        const Vector3d along = arrow.force.normalized();
        const double across = along.cross(direction).norm();
        score += std::min(facing, 0.4) + 0.5 * across;
      }
      if (score > highest) {
        highest = score;
        best = direction;
      }
    }
  }
  return best;
}

/// Arrows at the control points, displaced as the nearest points of the surface.
void addGradient(const app::StiffnessGradient& gradient, const app::TouchModel& model,
                 const app::TouchState& state, const PictureOptions& options,
                 view::Picture& picture) {
  std::vector<Vector3d> places = std::get<modeling::Solid>(model.body()).controlPoints();
  for (const int point : view::pointsWithArrows(gradient.gradient)) {
    Vector3d& place = places[static_cast<std::size_t>(point)];
    const bem::SurfacePoint nearest = bem::nearestSurfacePoint(model.setup().mesh(), place);
    place += options.displacementScale *
             model.setup().discretisation->interpolate(nearest, state.field.u.col(0));
  }
  picture.gradient.arrows = view::gradientArrows(gradient.gradient, places, view::threeDigits);
  picture.gradient.legend = {
      format("stiffness of \"%s\": %.4g N/mm; pull a control point along its arrow: stiffer, by up "
             "to %s N/mm "
             "per mm",
             gradient.name.c_str(), gradient.stiffness,
             view::threeDigits(picture.gradient.arrows.fullForce).c_str())};
}

std::vector<std::string> captions(const modeling::Project& project, const app::TouchModel& model,
                                  double scale) {
  const modeling::Material& material = project.material;
  std::string line = material.name.empty() ? "" : material.name + ", ";
  line += format("E = %.4g MPa, nu = %.4g, %d nodes", material.youngsModulus, material.poissonRatio,
                 model.report().nodes);
  if (scale != 1) line += format(", displacements drawn %.4g times", scale);
  return {line};
}

/// Towards the face of a section, from above and aside.
Vector3d directionToSection(const Vector3d& normal) {
  const Vector3d up = std::abs(normal.z()) > 0.9 ? Vector3d(-0.3, 1, 0) : Vector3d::UnitZ();
  const Vector3d aside = up.cross(normal).normalized();
  return -(normal + 0.45 * aside + 0.35 * up);
}

}  // namespace

view::ContactRing::State ringStateOf(app::TouchState::Status status) {
  using State = view::ContactRing::State;
  switch (status) {
    case Status::kGrabbed:
      return State::kGrabbed;
    case Status::kSticking:
      return State::kSticking;
    case Status::kSlipping:
      return State::kSlipping;
    default:
      return State::kOpen;
  }
}

view::Picture makePicture(const modeling::Project& project,
                          const std::shared_ptr<const app::TouchModel>& shared,
                          const app::TouchState& state, const PictureOptions& options) {
  const app::TouchModel& model = *shared;
  view::Picture picture;
  addSurface(shared, state, options, picture);
  picture.hasGhost = options.showUndeformed;
  for (const auto& support : model.setup().supports)
    picture.caption.supports +=
        (picture.caption.supports.empty() ? "fixed: " : ", ") + support.name;
  addContacts(model, state, options.displacementScale, picture);
  addLoads(project, model, state, options.displacementScale, picture);
  if (options.showReactions) addReactions(model, state, picture);
  const double largest = view::largestForce(picture.arrows.arrows);
  dropNegligible(picture.arrows.arrows, std::max(0.01 * largest, 2 * state.balance));
  picture.arrows.fullForce = largest;
  picture.arrows.minShare = kMinShare;

  if (options.showGradient) addGradient(*options.gradient, model, state, options, picture);

  picture.dimensions = dimensionsOf(project, model, state, options.displacementScale);

  picture.caption.title = project.name;
  picture.caption.lines = captions(project, model, options.displacementScale);
  picture.camera.direction =
      options.viewDirection.value_or(options.section ? directionToSection(options.section->normal)
                                                     : bestDirection(model, picture));
  if (std::abs(picture.camera.direction.normalized().z()) > 0.999)
    picture.camera.up = Vector3d::UnitY();
  picture.camera.parallel = options.parallel;
  picture.camera.zoom = options.zoom;
  return picture;
}

}  // namespace palpa::report

// Palpa's own engines, as the window runs them.
#include <cstdio>
#include <limits>
#include <numeric>

#include "app/core/live/touch_field.h"
#include "app/core/live/touch_stepper.h"
#include "app/core/live/touchable_model.h"
#include "app/core/model/build_touch_model.h"
#include "bem/contact/bilateral_contact_solver.h"
#include "bem/model/traction_projection.h"
#include "bem/quadratic/quadratic_discretisation.h"
#include "bem/spline/spline_discretisation.h"
#include "bem/spline/spline_projection.h"
#include "bench/peers/case_mesh.h"
#include "bench/peers/peer_row.h"
#include "bench/timing.h"

namespace palpa::bench {
namespace {

using Eigen::Vector3d;
using Command = app::TouchCommand;
using Kind = bem::ContactTool::Kind;
constexpr double kEverywhere = std::numeric_limits<double>::infinity();
constexpr double kDepth = 1;  // mm, of the moving touch

std::vector<int> firstNumbers(std::size_t count) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

const bem::QuadraticDiscretisation* asQuadratic(const app::BoundarySetup& setup) {
  return dynamic_cast<const bem::QuadraticDiscretisation*>(setup.discretisation.get());
}

/// The exact field as boundary conditions of the engine's coefficients.
bem::BoundaryConditions exactConditions(const PeerCase& body, const app::BoundarySetup& setup) {
  bem::BoundaryConditions given = setup.conditions;
  const bem::TractionFunction traction = [&](const Vector3d& x, const Vector3d& n) {
    return body.exactTraction(x, n);
  };
  if (const auto& splines = setup.splines) {
    given.displacement = projectDisplacement(
        splines->surface(),
        [&](const Vector3d& x, const Vector3d&) { return body.exactDisplacement(x); });
    given.traction =
        projectTraction(splines->surface(), splines->tractions(),
                        firstNumbers(splines->surface().elements().size()), traction, kEverywhere);
    return given;
  }
  const bem::BoundaryMesh& mesh = setup.mesh();
  for (int k = 0; k < mesh.nodeCount(); ++k)
    given.displacement.segment<3>(3 * k) = body.exactDisplacement(mesh.nodes[k]);
  given.traction = projectTraction(mesh, setup.meshSlots(),
                                   {firstNumbers(mesh.triangles.size()), traction, kEverywhere});
  return given;
}

double kelvinError(const PeerCase& body, const app::TouchModel& model) {
  const app::BoundarySetup& setup = model.setup();
  const bem::BoundaryField field =
      model.problem()->solveField(model.problem()->dofs().knownField(exactConditions(body, setup)));
  SurfaceError error(body);
  const auto sum = [&](const auto& weights, const auto& indices) {
    Vector3d u = Vector3d::Zero();
    for (std::size_t f = 0; f < indices.size(); ++f)
      u += weights[static_cast<Eigen::Index>(f)] * field.u.block<3, 1>(3 * indices[f], 0);
    return u;
  };
  if (const auto& splines = setup.splines) {
    const bem::SplineSurface& surface = splines->surface();
    std::vector<double> basis;
    bem::visitSplinePoints(
        surface, firstNumbers(surface.elements().size()), 4, kEverywhere,
        [&](const bem::ElementPlace& place, const bem::SurfaceJet& jet, double weight) {
          surface.evaluateBasis(place, basis);
          error.add(jet.position,
                    sum(Eigen::Map<const Eigen::VectorXd>(basis.data(),
                                                          static_cast<Eigen::Index>(basis.size())),
                        surface.functions(place.element)),
                    weight);
        });
    return error.relative();
  }
  if (const auto* quadratic = asQuadratic(setup)) {
    const bem::QuadraticSurface& surface = quadratic->surface();
    const Eigen::VectorXd u = field.u.col(0);
    std::vector<double> basis;
    for (int e = 0; e < surface.elementCount(); ++e)
      surface.visitPoints(
          e, 1, [&](const bem::ElementPlace& place, const bem::SurfaceJet& jet, double weight) {
            surface.evaluateBasis(place, basis);
            error.add(jet.position, bem::weightedSum(basis, surface.coefficients(e), u), weight);
          });
    return error.relative();
  }
  const bem::BoundaryMesh& mesh = setup.mesh();
  bem::visitQuadraturePoints(mesh, firstNumbers(mesh.triangles.size()), kEverywhere,
                             [&](int t, const Vector3d& weights, double weight) {
                               error.add(mesh.point(t, weights), sum(weights, mesh.triangles[t]),
                                         weight);
                             });
  return error.relative();
}

/// A touch without columns, by one solve with three right-hand sides; what that takes at the end of
/// the path, s, and how unsymmetric D is.
Eigen::Matrix3d complianceOf(const PeerCase& body, const app::TouchableModel& touched,
                             double& seconds, double& defect) {
  const app::TouchModel& model = touched.model();
  Eigen::Matrix3d compliance;
  const auto touch = [&](const Vector3d& at) {
    bem::BilateralContactSolver solver(model.problem(), model.setup().discretisation->slots(),
                                       model.rest().field);
    solver.addGrab(makeContactMask(touched.surface(), at, body.reference.radius), {});
    compliance = solver.compliance();
    defect = solver.reciprocityDefect();
  };
  seconds = medianSecondsFor([&] { touch(body.path.back()); });
  touch(body.reference.at);
  return compliance;
}

void prepare(const app::TouchableModel& body, app::TouchStepper& stepper) {
  while (!stepper.missing().empty()) body.columns()->compute(stepper.missing(), {});
}

/// New touches at places without columns, then one that slides.
void measureTouches(const PeerCase& body, const std::shared_ptr<const app::TouchableModel>& touched,
                    PeerRow& row) {
  const double radius = body.reference.radius;
  std::vector<double> begins;
  const int before = touched->columns()->readyCount();
  double columns = 0;
  for (const Vector3d& at : body.places) {
    app::TouchStepper stepper(touched);
    stepper.step();
    begins.push_back(secondsFor([&] {
      stepper.apply({Command::Kind::kBegin, 1, {Kind::kGrab, radius}, at, Vector3d(0, 0, 0.5)});
      columns += secondsFor([&] { prepare(*touched, stepper); });
      stepper.step();
    }));
  }
  row.values["touch"] = quantilesOf(begins).p50;
  row.values["column"] = columns / (touched->columns()->readyCount() - before);

  app::TouchStepper stepper(touched);
  app::TouchField field(touched);
  app::TouchSnapshot snapshot;
  stepper.apply({Command::Kind::kBegin, 1, {Kind::kPush, radius, 0}, body.path[0], body.path[0]});
  std::vector<double> steps, fields;
  // Once to compute the columns that the path needs, then to look at the time.
  for (const bool isTimed : {false, true, true})
    for (const Vector3d& at : body.path) {
      const bem::ContactSurface& surface = touched->surface();
      const Vector3d tip = at - kDepth * surface.normal(surface.nearest(at));
      const double step = secondsFor([&] {
        stepper.apply({Command::Kind::kSet, 1, {}, {0, 0, 0}, tip});
        stepper.step();
      });
      stepper.describe(snapshot);
      const double display = secondsFor([&] { field.displacements(snapshot); });
      prepare(*touched, stepper);
      if (!isTimed) continue;
      steps.push_back(step);
      fields.push_back(display);
    }
  row.values["move_kept"] = quantilesOf(steps).p50;
  row.values["field"] = quantilesOf(fields).p50;
}

PeerRow measure(const PeerCase& body, modeling::Engine engine, double size) {
  PeerRow row;
  std::shared_ptr<const app::TouchModel> model;
  std::shared_ptr<app::TouchableModel> touched;
  row.values["setup"] = secondsFor([&] {
    model = app::buildTouchModel(projectOf(body, engine, size), {}, {});
    touched = std::make_shared<app::TouchableModel>(model);
  });
  const app::BuildReport& report = model->report();
  row.values["n"] = model->setup().discretisation->displacementCount();
  row.values["unknowns"] = model->problem()->dofs().count();
  row.values["mesh"] = report.meshSeconds;
  row.values["assemble"] = report.assembleSeconds;
  row.values["factorise"] = report.factoriseSeconds;
  measureTouches(body, touched, row);
  row.values["stiffness"] = stiffnessError(
      body, complianceOf(body, *touched, row.values["move"], row.values["reciprocity"]));
  row.values["kelvin"] = kelvinError(body, *model);
  const bem::ContactSurface& surface = touched->surface();
  const double narrowest = surface.narrowestMask(surface.nearest(body.reference.at));
  if (narrowest > body.reference.radius) {
    char text[64];
    std::snprintf(text, sizeof text, "touches with a mask of %.1f mm", narrowest);
    row.note = text;
  }
  return row;
}

}  // namespace

PeerRow measureTriangles(const PeerCase& body, double size) {
  return measure(body, modeling::Engine::kTriangles, size);
}

PeerRow measureQuadratic(const PeerCase& body, double size) {
  return measure(body, modeling::Engine::kQuadratic, size);
}

PeerRow measureSplines(const PeerCase& body, double size) {
  return measure(body, modeling::Engine::kSplines, size);
}

}  // namespace palpa::bench

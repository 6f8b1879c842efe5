#include "app/report/report_sections.h"

#include <algorithm>
#include <cmath>

#include "app/core/live/touch_table.h"
#include "app/core/results/largest_displacement.h"
#include "app/report/html.h"
#include "app/report/numbers.h"
#include "app/report/state_words.h"
#include "app/report/text.h"
#include "app/report/words.h"
#include "base/count_text.h"
#include "modeling/error.h"
#include "modeling/project/material_library.h"

namespace palpa::report {
namespace {

using app::TouchState;

/// Of the body's size: beyond it the linear model is only an indication.
constexpr double kLargeMotion = 0.1;
/// Relative errors from which a notice warns.
constexpr double kLargeError = 0.1;
/// Of sizes, which are exact: shown with four digits, without powers of ten.
constexpr double kFourDigits = 5e-4;

const char* supportKind(const modeling::Support& support) {
  return support.kind == modeling::Support::Kind::kFixed
             ? "fixed"
             : "roller: free to slide along the surface, not across it";
}

std::string errorCell(const TouchState::Contact& contact) {
  if (!contact.errorEstimate) return "not estimated";
  if (*contact.errorEstimate == 0) return "0";
  return *contact.errorEstimate > 1 ? "more than 100 %"
                                    : format("%.2g %%", 100 * *contact.errorEstimate);
}

std::vector<std::string> touchRow(const modeling::Touch& touch,
                                  const TouchState::Contact& contact) {
  const double error = contact.errorEstimate.value_or(0);
  return {touch.name,
          std::string(modeling::infoOf(touch.kind).label) + " at " + toText(contact.at, 4) + " mm",
          givenText(touch),
          withError(contact.force.norm(), contact.hasGivenForce() ? 0 : error),
          rounded(contact.stiffness, error),
          rounded(contact.displacement.norm(), error),
          errorCell(contact)};
}

HtmlTable touchTable(bool hasLargest) {
  std::vector<std::string> columns{"Touch",          "Kind and place",  "Given",
                                   "Force, N",       "Stiffness, N/mm", "Place moves, mm",
                                   "Estimated error"};
  if (hasLargest) columns.insert(columns.end() - 1, "Largest displacement, mm");
  return HtmlTable(columns);
}

/// A row of a state in which this touch alone acts.
void addSingle(const app::TouchStudy& study, const modeling::Touch& touch, const TouchState& state,
               HtmlTable& table) {
  std::vector<std::string> row = touchRow(touch, state.contacts.front());
  row.insert(row.end() - 1, rounded(app::largestDisplacement(*study.model, state).length,
                                    state.errorEstimate.value_or(0)));
  table.add(std::move(row));
}

std::string sizeText(const bem::BoundaryMesh& mesh) {
  Eigen::Vector3d low = mesh.nodes.front(), high = low;
  for (const Eigen::Vector3d& node : mesh.nodes) {
    low = low.cwiseMin(node);
    high = high.cwiseMax(node);
  }
  const Eigen::Vector3d size = high - low;
  return format("%.4g × %.4g × %.4g mm, from ", size.x(), size.y(), size.z()) + toText(low, 4) +
         " to " + toText(high, 4) + " mm";
}

std::string bodyText(const modeling::Body& body) {
  if (const auto* solid = std::get_if<modeling::Solid>(&body))
    return format("solid of %s B-spline patches with %s control points",
                  countText(static_cast<double>(solid->patches().size())).c_str(),
                  countText(static_cast<double>(solid->controlPoints().size())).c_str());
  const auto& mesh = std::get<modeling::MeshBody>(body);
  return "mesh body of " + countText(static_cast<double>(mesh.triangles().size())) + " triangles";
}

std::string engineText(modeling::Engine engine) {
  switch (engine) {
    case modeling::Engine::kSplines:
      return "boundary elements with the B-splines of the patches (splines)";
    case modeling::Engine::kQuadratic:
      return "boundary elements on curved triangles with quadratic functions (quadratic)";
    default:
      return "boundary elements on flat triangles with linear functions (triangles)";
  }
}

void addContact(const TouchState::Contact& contact, HtmlTable& table) {
  const double error = contact.errorEstimate.value_or(0);
  const double ofForce = contact.hasGivenForce() ? 0 : error;
  const double force = contact.force.norm();
  table.add({contact.name.empty() ? "Touch" : "Touch “" + contact.name + "”",
             std::string(kindName(contact)) + ", " + app::nameOf(contact.status) + ", at " +
                 toText(contact.at, 4) + " mm" +
                 (contact.radius > 0 ? format(", radius %.4g mm", contact.radius) : "") +
                 (contact.presses() ? format(", friction %.4g", contact.friction) : "")});
  table.add({"Force on the body",
             rounded(contact.force, ofForce) + " N, |" + withError(force, ofForce) + "| N"});
  table.add({"Force into the body", inDecimalsOf(contact.normalForce(), force, ofForce) + " N"});
  table.add({"Force along the surface",
             inDecimalsOf(contact.tangentialForce().norm(), force, ofForce) + " N"});
  table.add({"Place moves by", rounded(contact.displacement, error) + " mm"});
  table.add({"Deflection by this force", rounded(contact.deflection.norm(), error) + " mm"});
  table.add({"Stiffness", rounded(contact.stiffness, error) + " N/mm"});
  if (contact.isBall() && !contact.patch.empty())
    table.add({"Contact patch",
               format("radius %.4g mm, %zu masks", contact.patchRadius(), contact.patch.size())});
}

}  // namespace

std::string givenText(const modeling::Touch& touch) {
  const modeling::TouchKindInfo& kind = modeling::infoOf(touch.kind);
  const std::string vector = toText(touch.vector, 4);
  if (kind.isForce) return format("force %.4g N: ", touch.vector.norm()) + vector;
  if (app::isPassive(touch)) return "held in place";
  return format("moved %.4g mm: ", touch.vector.norm()) + vector;
}

std::string touchTables(const app::TouchStudy& study) {
  const std::vector<modeling::Touch>& touches = study.project.touches;
  if (touches.empty()) return element("p", "The project has no touches; its loads act alone.");
  HtmlTable single = touchTable(true);
  if (touches.size() == 1) {
    addSingle(study, touches.front(), study.together, single);
    return single.html();
  }
  for (const app::TouchStudy::Single& each : study.alone)
    addSingle(study, touches[each.touch], each.state, single);
  HtmlTable together = touchTable(false);
  for (std::size_t k = 0; k < touches.size(); ++k)
    together.add(touchRow(touches[k], study.together.contacts[k]));
  const double largest = app::largestDisplacement(*study.model, study.together).length;
  std::string html;
  if (!single.isEmpty()) html += element("h3", "Each touch alone") + single.html();
  return html + element("h3", "All touches at the same time") + together.html() +
         element("p", "Largest displacement of the body: " +
                          rounded(largest, study.together.errorEstimate.value_or(0)) + " mm.");
}

std::string modelTables(const app::TouchStudy& study) {
  const modeling::Project& project = study.project;
  const modeling::Material& material = project.material;
  HtmlTable body;
  const double volume = modeling::volume(project.body);
  body.add({"Body", bodyText(project.body)});
  body.add({"Size", sizeText(study.model->setup().mesh())});
  body.add({"Volume, surface", rounded(volume, kFourDigits) + " mm³, " +
                                   rounded(modeling::area(project.body), kFourDigits) + " mm²"});
  if (material.densityKgPerM3)
    body.add({"Mass", rounded(1e-6 * *material.densityKgPerM3 * volume, kFourDigits) + " g"});
  body.add({"Material", material.name.empty() ? "without a name" : material.name});
  body.add({"Young’s modulus E", format("%.4g MPa", material.youngsModulus)});
  body.add({"Poisson’s ratio ν", format("%.4g", material.poissonRatio)});
  if (material.densityKgPerM3)
    body.add({"Density", format("%.4g kg/m³", *material.densityKgPerM3)});
  body.add({"Source of the constants", materialSource(material)});
  body.add({"Method", engineText(study.model->setup().engine)});
  body.add({"Mesh", meshText(*study.model)});
  if (study.rest.errorEstimate && *study.rest.errorEstimate > 0)
    body.add({"Accuracy at rest", accuracyText(study.rest)});

  std::string html = body.html() + element("h3", "Supports");
  HtmlTable supports({"Support", "Kind", "Where", "Displacement, mm"});
  for (const modeling::Support& support : project.supports)
    supports.add({support.name, supportKind(support), regionText(support.where),
                  support.displacement.isZero(0) ? "0" : toText(support.displacement)});
  html += supports.isEmpty() ? element("p", "None.") : supports.html();
  html += element("h3", "Loads");
  HtmlTable loads({"Load", "What", "Resultant force, N"});
  for (std::size_t k = 0; k < project.loads.size(); ++k)
    loads.add({project.loads[k].name, loadText(project.loads[k]),
               toText(study.model->setup().loads[k].resultant.force, 4)});
  return html + (loads.isEmpty() ? element("p", "None: only the touches act.") : loads.html());
}

std::string stateTable(const app::TouchModel& model, const TouchState& state) {
  HtmlTable table;
  for (const TouchState::Contact& contact : state.contacts) addContact(contact, table);
  for (const auto& support : state.supports)
    table.add({"Support “" + support.name + "”",
               resultantText(support.resultant, state.forceErrorEstimate.value_or(0),
                             model.setup().mesh().boundingSize())});
  for (const auto& load : model.setup().loads)
    table.add({"Load “" + load.name + "”", resultantText(load.resultant, 0, 0)});
  table.add({"Sum of all forces", balanceText(state)});
  const app::LargestDisplacement largest = app::largestDisplacement(model, state);
  table.add({"Largest displacement", rounded(largest.length, state.errorEstimate.value_or(0)) +
                                         " mm at " + toText(largest.at, 4) + " mm"});
  table.add({"Strain energy", format("%.4g mJ", state.energy)});
  if (state.errorEstimate && *state.errorEstimate > 0) table.add({"Accuracy", accuracyText(state)});
  if (state.path)
    table.add({"Path of the tools",
               format("%d steps, then %d at rest; the last changed forces by %.1g of the largest",
                      state.path->steps, state.path->settlingSteps, state.path->change)});
  return table.html();
}

std::vector<std::string> notices(const app::TouchStudy& study,
                                 const std::vector<std::string>& notes) {
  std::vector<std::string> result = notes;
  const app::TouchModel& model = *study.model;
  if (!model.report().notice.empty()) result.push_back(model.report().notice);
  if (std::string text = simplificationText(model.surface().simplification); !text.empty())
    result.push_back("Mesh: " + text + ".");
  for (const modeling::GeometryFinding& finding : *model.report().warnings)
    result.push_back("Geometry: " + finding.message);
  const double size = model.setup().mesh().boundingSize();
  const auto check = [&](const TouchState& state, const std::string& what) {
    const double moved = app::largestDisplacement(model, state).length;
    if (moved > kLargeMotion * size)
      result.push_back(what +
                       format(": a place moves by %.2g mm, %.0f %% of the size of the body. The "
                              "linear model only hints at these forces.",
                              moved, 100 * moved / size));
    const double error = state.forceErrorEstimate.value_or(0);
    if (error > kLargeError)
      result.push_back(what + ": the estimated error of forces is " + percentText(error) +
                       "; a finer mesh is needed.");
    for (const TouchState::Contact& contact : state.contacts)
      if (contact.status == TouchState::Status::kFixed ||
          contact.status == TouchState::Status::kOpen)
        result.push_back(what + ": the touch “" + contact.name + "” exerts no force (" +
                         app::nameOf(contact.status) + ").");
  };
  check(study.rest, "At rest");
  for (const app::TouchStudy::Single& each : study.alone)
    check(each.state, "Touch “" + study.project.touches[each.touch].name + "” alone");
  if (study.project.touches.size() == 1)
    check(study.together, "Touch “" + study.project.touches.front().name + "”");
  else if (!study.project.touches.empty())
    check(study.together, "All touches");
  return result;
}

std::string materialSource(const modeling::Material& material) {
  for (const modeling::LibraryMaterial& each : modeling::materialLibrary()) {
    if (each.material.name != material.name) continue;
    if (each.material == material) return each.note + " " + each.reference;
    return "not stated; the library has other constants for a material of this name";
  }
  return "not stated";
}

double largestShare(const app::TouchStudy& study) {
  double moved = 0;
  for (const app::TouchStudy::Single& each : study.alone)
    moved = std::max(moved, app::largestDisplacement(*study.model, each.state).length);
  moved = std::max(moved, app::largestDisplacement(*study.model, study.together).length);
  return moved / study.model->setup().mesh().boundingSize();
}

std::vector<std::string> assumptions(double share) {
  return {
      "The material is linear elastic, isotropic and the same everywhere, with the two constants "
      "above. Their scatter is not part of the stated errors.",
      "Displacements and strains are small: equilibrium refers to the undeformed shape, and forces "
      "are proportional to displacements, except under balls and fingertips, whose contact grows. "
      "Beyond some ten per cent of strain, forces are only a tendency. " +
          format("The largest displacement of this report is %.2g %% of the diagonal of the body.",
                 100 * share),
      "All states are at rest: no inertia, no viscosity, no heating; the loading is slow.",
      "The surface does not touch itself, and tools touch it only where stated.",
      "Errors are estimates of the error of the numerical solution, relative to the exact solution "
      "of this linear problem; they are not bounds. Numbers are rounded to them. The sum of all "
      "forces is zero for an exact solution; it is printed, never corrected.",
  };
}

}  // namespace palpa::report

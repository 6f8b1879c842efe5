#include "app/report/state_words.h"

#include <algorithm>

#include "app/report/numbers.h"
#include "app/report/text.h"
#include "base/count_text.h"
#include "base/number_with_error.h"

namespace palpa::report {

std::string meshText(const app::TouchModel& model) {
  const app::BuildReport& build = model.report();
  const bem::Discretisation& on = *model.setup().discretisation;
  if (model.setup().engine == modeling::Engine::kTriangles)
    return format("%s nodes, %s triangles, smallest angle %.1f°", countText(build.nodes).c_str(),
                  countText(build.triangles).c_str(), build.quality.smallestAngle);
  if (model.setup().engine == modeling::Engine::kQuadratic)
    return format("%s nodes, %s quadratic triangles", countText(build.nodes).c_str(),
                  countText(on.elementCount()).c_str());
  return format("%s coefficients on %s elements; shown on %s nodes",
                countText(on.displacementCount()).c_str(), countText(on.elementCount()).c_str(),
                countText(build.nodes).c_str());
}

std::string simplificationText(const modeling::MeshSimplification& simplification) {
  const auto& [below, moved, vanishedFaces, partsBelow, cutPins, filledHoles] = simplification;
  if (!(below > 0)) return "";
  const auto count = [](int number, const char* one, const char* several) {
    return countText(number) + ' ' + (number == 1 ? one : several);
  };
  std::string text = format("features below %.3g mm are meshed over", below);
  if (vanishedFaces > 0)
    text += " (" + count(vanishedFaces, "face vanished", "faces vanished") + ')';
  if (cutPins + filledHoles > 0) {
    text += "; ";
    if (cutPins > 0)
      text += count(cutPins, "pin or knife edge cut off", "pins and knife edges cut off");
    if (cutPins > 0 && filledHoles > 0) text += " and ";
    if (filledHoles > 0) text += count(filledHoles, "hole or gap filled", "holes and gaps filled");
    text += format(", all below %.3g mm", partsBelow);
  }
  return text + format("; the surface moved by up to %.3g mm", moved);
}

std::string resultantText(const bem::Resultant& resultant, double error, double lever) {
  const double moment = resultant.moment.norm();
  // A moment below its error is shown as 0.
  const double momentError = error * std::max(moment, lever * resultant.force.norm());
  const int digits = momentError > moment ? 0
                     : momentError > 0    ? digitsFor(moment, momentError)
                                          : 4;
  return "force " + rounded(resultant.force, error) + " N, |" +
         withError(resultant.force.norm(), error) + "| N, moment " +
         (digits > 0 ? toText(resultant.moment, digits) : "(0, 0, 0)") + " N·mm";
}

std::string accuracyText(const app::TouchState& state) {
  // Parts that are only carried along may have wrong displacements where forces are right.
  constexpr double kMuchSmaller = 0.5;
  const double largest = state.errorEstimate.value_or(0);
  const double ofForces = state.forceErrorEstimate.value_or(0);
  if (ofForces > 0 && ofForces < kMuchSmaller * largest)
    return "estimated errors: of forces " + percentText(ofForces) + ", of displacements " +
           percentText(largest);
  if (largest > 1)
    return "the estimated error is " + percentText(largest) + ": take smaller elements";
  return "displacements and forces are good to " + percentText(largest) + " (estimated)";
}

std::string balanceText(const app::TouchState& state) {
  return format("%.3g N (%.2g %% of the largest force)", state.balance,
                100 * state.relativeBalance);
}

const char* kindName(const app::TouchState::Contact& contact) {
  return contact.kind ? modeling::infoOf(*contact.kind).name : "node";
}

}  // namespace palpa::report

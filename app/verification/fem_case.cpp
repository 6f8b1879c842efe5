#include "app/verification/fem_case.h"

#include <algorithm>
#include <cmath>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/field_sample.h"
#include "app/verification/analytic_case.h"
#include "modeling/error.h"
#include "modeling/shapes/primitives.h"

namespace palpa::verification {

using Eigen::Vector3d;
using nlohmann::json;

FemErrors::FemErrors(const json& reference, const std::vector<Vector3d>& displacements,
                     const Vector3d& reactionForce, double energyFound) {
  const json& places = reference.at("points");
  if (places.empty()) throw modeling::ModelingError("a finite element case has no points");
  double largest = 0, squares = 0, scale = 0;
  for (const json& point : places) largest = std::max(largest, vectorOf(point.at("u")).norm());
  for (std::size_t k = 0; k < displacements.size(); ++k) {
    const Vector3d expected = vectorOf(places.at(k).at("u"));
    const double error = (displacements[k] - expected).norm();
    anywhere = worse(anywhere, error / largest);
    if (k == 0) atLoad = error / expected.norm();
    squares += error * error;
    scale += expected.squaredNorm();
  }
  points = std::sqrt(squares / scale);
  const Vector3d expected = vectorOf(reference.at("reaction_force"));
  reaction = (reactionForce - expected).norm() / expected.norm();
  const double exactEnergy = reference.at("energy_mJ");
  energy = std::abs(energyFound - exactEnergy) / exactEnergy;
}

modeling::Project femProject(const json& reference) {
  using modeling::Region;
  using modeling::Support;
  modeling::Project project;
  project.name = reference.at("id");
  project.material = {"", reference.at("material").at("E"), reference.at("material").at("nu")};
  const json& geometry = reference.at("geometry");
  const std::string shape = geometry.at("type");
  const auto hold = [&](const char* name, Region where, const Vector3d& displacement) {
    project.supports.push_back({name, Support::Kind::kFixed, std::move(where), displacement});
  };
  if (shape == "sphere") {
    project.body = modeling::makeSphere(geometry.at("R"));
    // The clamp of the file: all of the surface below z = -20 mm.
    hold("base", Region::below(Vector3d::UnitZ(), -20), Vector3d::Zero());
  } else if (shape == "cylinder") {
    project.body = modeling::makeCylinder(geometry.at("R"), geometry.at("H"));
    hold("base", Region::ofPatches({"bottom"}), Vector3d::Zero());
  } else {
    throw modeling::ModelingError(project.name + ": there is no solid of a " + shape);
  }
  if (reference.contains("top"))
    hold("top", Region::ofPatches({"top"}), vectorOf(reference.at("top")));
  if (reference.contains("load")) {
    const json& load = reference.at("load");
    project.loads.push_back(
        {"bump", modeling::Bump{vectorOf(load.at("center")), load.at("a"), load.at("p0"),
                                vectorOf(load.at("direction"))}});
  }
  return project;
}

FemSolution solveFem(const json& reference, const modeling::MeshSettings& mesh, const Job& job) {
  modeling::Project project = femProject(reference);
  project.mesh = mesh;
  const auto model = app::buildTouchModel(project, app::BuildOptions{}, job);
  const app::TouchState& state = model->rest();
  std::vector<Vector3d> displacements;
  for (const json& point : reference.at("points"))
    displacements.push_back(sampleField(*model, state, vectorOf(point.at("x"))).displacement);
  FemSolution solution;
  solution.coefficients = model->setup().discretisation->displacementCount();
  solution.errors =
      FemErrors(reference, displacements, state.supports.at(0).resultant.force, state.energy);
  solution.balance = state.relativeBalance;
  return solution;
}

}  // namespace palpa::verification

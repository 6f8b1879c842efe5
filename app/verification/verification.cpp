#include "app/verification/verification.h"

#include <algorithm>
#include <chrono>
#include <set>

#include "app/verification/analytic_families.h"
#include "app/verification/analytic_splines.h"
#include "app/verification/analytic_triangles.h"
#include "app/verification/convergence.h"
#include "app/verification/fem_case.h"
#include "app/verification/fem_specification.h"
#include "modeling/error.h"

namespace palpa::verification {
namespace {

using modeling::ModelingError;
using nlohmann::json;

/// "kelvin_exterior_sphere" of "kelvin_exterior_sphere_nu0.30".
std::string withoutMaterial(const std::string& id) {
  return id.substr(0, id.rfind("_nu"));
}

bool isNamed(const std::string& id, std::string_view name) {
  return id == name || withoutMaterial(id) == name;
}

std::string idOf(const json& entry) {
  return entry.at("id");
}

const AnalyticFamily* familyOf(const std::string& id) {
  for (const AnalyticFamily& family : analyticFamilies())
    if (isNamed(id, family.name)) return &family;
  return nullptr;
}

const OmittedCases* omissionOf(const std::string& id) {
  for (const OmittedCases& omitted : omittedCases())
    if (id.starts_with(omitted.prefix)) return &omitted;
  return nullptr;
}

/// A task that measures its time and reports wrong reference data as a ModelingError.
Task task(const std::string& name, const std::string& engine, const std::string& data,
          std::function<void(Result&, const Job&)> solve) {
  return {name, engine, [=](const Job& job) {
            const auto start = std::chrono::steady_clock::now();
            Result result{name, engine, data, 0, {}, {}, 0};
            try {
              solve(result, job);
            } catch (const json::exception& error) {
              throw ModelingError("the reference data of " + name + ": " + error.what());
            }
            result.seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            return result;
          }};
}

Task triangleTask(const json& entry, const TriangleTolerances& most, BoundaryData data) {
  return task(idOf(entry), nameOf(Engine::kTriangles),
              data == BoundaryData::kMixed ? "mixed" : "stated",
              [=](Result& result, const Job& job) {
                const TriangleErrors errors = solveWithTriangles(AnalyticCase(entry), data, job);
                result.coefficients = errors.nodes;
                result.checks = {{"u at nodes", errors.displacement, most.displacement},
                                 {"u at points", errors.points, most.points},
                                 {"traction", errors.traction, most.traction}};
                if (most.resultant > 0)
                  result.checks.push_back({"reaction", errors.resultant, most.resultant});
              });
}

Task splineTask(const json& entry, double most) {
  return task(idOf(entry), nameOf(Engine::kSplines), "mixed", [=](Result& result, const Job& job) {
    const SplineErrors errors = solveWithSplines(AnalyticCase(entry), job);
    result.coefficients = errors.coefficients;
    result.checks = {{"u at points", errors.points, most}};
  });
}

/// Whether the statements of the file agree with each other: one check, or one for each case where
/// they do not.
Task referenceTask(const std::vector<json>& entries) {
  return task("analytic.json", "-", "-", [=](Result& result, const Job& job) {
    result.coefficients = static_cast<int>(entries.size());
    double most = 0;
    for (const json& entry : entries) {
      job.throwIfCancelled();
      const Check check{idOf(entry), AnalyticCase(entry).inconsistency(), kMaxInconsistency};
      most = worse(most, check.value);
      if (!check.passes()) result.checks.push_back(check);
    }
    if (result.checks.empty())
      result.checks.push_back({"statements agree", most, kMaxInconsistency});
  });
}

void addAnalytic(const std::vector<json>& entries, const Selection& selection, Plan& plan) {
  if (!entries.empty()) plan.tasks.push_back(referenceTask(entries));
  for (const json& entry : entries) {
    const AnalyticCase body(entry);
    const AnalyticFamily& family = *familyOf(body.id());
    if (selection.triangles) {
      if (body.isDetermined())
        plan.tasks.push_back(triangleTask(entry, family.triangles, BoundaryData::kAsStated));
      if (body.anyMixture())
        plan.tasks.push_back(triangleTask(entry, family.triangles, BoundaryData::kMixed));
    }
    if (selection.splines && family.splines)
      plan.tasks.push_back(splineTask(entry, *family.splines));
    else if (selection.splines)
      plan.omitted.push_back({body.id() + " with splines", "there are no hollow solids"});
  }
}

Task femTask(const json& entry, Engine engine, const FemSpecification& how) {
  return task(idOf(entry), nameOf(engine), "stated", [=](Result& result, const Job& job) {
    const FemSolution solution = solveFem(entry, how.mesh, job);
    result.coefficients = solution.coefficients;
    if (entry.contains("load"))
      result.checks.push_back({"u at the load", solution.errors.atLoad, how.atLoad});
    result.checks.push_back({"u at points", solution.errors.anywhere, how.anywhere});
    result.checks.push_back({"reaction", solution.errors.reaction, how.reaction});
    result.checks.push_back({"energy", solution.errors.energy, how.energy});
    result.checks.push_back({"balance", solution.balance, how.balance});
  });
}

void addFiniteElements(const std::vector<json>& entries, const Selection& selection, Plan& plan) {
  for (const json& entry : entries) {
    // The short run leaves out meshes of 2,500 nodes unless they are asked for by name.
    if (selection.triangles && (!selection.isQuick || !selection.names.empty()))
      plan.tasks.push_back(femTask(entry, Engine::kTriangles, femTriangles(entry)));
    if (selection.splines)
      plan.tasks.push_back(femTask(entry, Engine::kSplines, femSplines(selection.isQuick)));
    if (selection.quadratic)
      plan.tasks.push_back(femTask(entry, Engine::kQuadratic, femQuadratic(selection.isQuick)));
  }
}

void addConvergence(const Selection& selection, Plan& plan) {
  const auto add = [&](Engine engine) {
    plan.tasks.push_back(task(kConvergenceName, nameOf(engine), "mixed",
                              [=, isShort = selection.isQuick](Result& result, const Job& job) {
                                result.steps = sphereConvergence(engine, isShort, job);
                                result.coefficients = result.steps.back().coefficients;
                                result.checks = checksOf(result.steps, engine);
                              }));
  };
  if (selection.triangles) add(Engine::kTriangles);
  if (selection.splines) add(Engine::kSplines);
}

/// The named cases of a file; without names all cases, or in a short run the ones that `isQuick`
/// accepts.
template <class IsQuick>
std::vector<json> selected(const json& cases, const Selection& selection, const IsQuick& isQuick) {
  std::vector<json> entries;
  for (const json& entry : cases) {
    const std::string id = idOf(entry);
    const auto isThis = [&](const std::string& name) { return isNamed(id, name); };
    const bool isWanted = selection.names.empty()
                              ? !selection.isQuick || isQuick(id)
                              : std::any_of(selection.names.begin(), selection.names.end(), isThis);
    if (isWanted) entries.push_back(entry);
  }
  return entries;
}

/// Of cases that follow each other and differ in their material alone the last, least compressible
/// one.
void keepOneMaterial(std::vector<json>& entries) {
  std::vector<json> kept;
  for (json& entry : entries) {
    if (!kept.empty() && withoutMaterial(idOf(kept.back())) == withoutMaterial(idOf(entry)))
      kept.pop_back();
    kept.push_back(std::move(entry));
  }
  entries = std::move(kept);
}

void checkNames(const ReferenceData& reference, const Selection& selection) {
  for (const std::string& name : selection.names) {
    const auto has = [&](const json& cases) {
      return std::any_of(cases.begin(), cases.end(),
                         [&](const json& entry) { return isNamed(idOf(entry), name); });
    };
    if (name == kConvergenceName || has(reference.analytic()) || has(reference.finiteElements()))
      continue;
    std::string message = "there is no case '" + name + "'; known are";
    const char* separator = " ";
    for (const std::string& known : knownNames(reference)) {
      message += separator + known;
      separator = ", ";
    }
    throw ModelingError(message + "; behind them may stand the material, as _nu0.30",
                        ModelingError::Kind::kNotFound);
  }
}

}  // namespace

std::vector<std::string> knownNames(const ReferenceData& reference) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const json* cases : {&reference.analytic(), &reference.finiteElements()})
    for (const json& entry : *cases)
      if (const std::string name = withoutMaterial(idOf(entry)); seen.insert(name).second)
        names.push_back(name);
  names.push_back(kConvergenceName);
  return names;
}

Plan makePlan(const ReferenceData& reference, const Selection& selection) {
  checkNames(reference, selection);
  Plan plan;
  std::vector<json> analytic = selected(reference.analytic(), selection, [](const std::string& id) {
    const AnalyticFamily* family = familyOf(id);
    return family && family->isQuick;
  });
  std::erase_if(analytic, [&](const json& entry) {
    const std::string id = idOf(entry);
    if (const OmittedCases* omitted = omissionOf(id)) {
      plan.omitted.push_back({id, std::string(omitted->reason)});
      return true;
    }
    if (!familyOf(id)) throw ModelingError("nobody said what errors the case " + id + " may have");
    return false;
  });
  std::vector<json> finiteElements =
      selected(reference.finiteElements(), selection,
               [](const std::string& id) { return id == "b_cyl_push_nu0.45"; });
  if (selection.isQuick) {
    keepOneMaterial(analytic);
    keepOneMaterial(finiteElements);
  }
  try {
    addAnalytic(analytic, selection, plan);
    addFiniteElements(finiteElements, selection, plan);
  } catch (const json::exception& error) {
    throw ModelingError(std::string("the reference data: ") + error.what());
  }
  const auto& names = selection.names;
  if (names.empty() || std::find(names.begin(), names.end(), kConvergenceName) != names.end())
    addConvergence(selection, plan);
  return plan;
}

}  // namespace palpa::verification

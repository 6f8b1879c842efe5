#include "app/cli/project_input.h"

#include "app/cli/errors.h"
#include "app/cli/values.h"
#include "modeling/project/project_file.h"

namespace palpa::cli {

void ProjectInput::declare(CLI::App& options) {
  options.add_option("file", file_, "Project file (JSON)")->required()->type_name("");
  options
      .add_option("--edge-length", edgeLength_,
                  "Target length of mesh edges in mm, instead of the project's")
      ->type_name("LENGTH");
  options
      .add_option(
          "--engine", engine_,
          "Engine that computes the body: splines (on its patches), quadratic (curved triangles), "
          "triangles (flat, linear) or automatic; "
          "instead of the project's")
      ->type_name("ENGINE");
  options
      .add_option(
          "--accuracy", accuracy_,
          "Relative error to aim at with splines, 0.0001 to 0.1, which sets the size of their "
          "elements; instead of the project's")
      ->type_name("NUMBER");
  options
      .add_option("--element-length", elementLength_,
                  "Size of the spline elements in mm, instead of an accuracy")
      ->type_name("LENGTH");
}

namespace {

modeling::Engine parseEngine(const std::string& text) {
  if (text == "spline" || text == "splines") return modeling::Engine::kSplines;
  if (text == "triangles") return modeling::Engine::kTriangles;
  if (text == "quadratic") return modeling::Engine::kQuadratic;
  if (text == "automatic") return modeling::Engine::kAutomatic;
  throw UsageError("--engine: expected splines, quadratic, triangles or automatic, found '" + text +
                   "'");
}

}  // namespace

modeling::Project ProjectInput::read() const {
  modeling::Project project = modeling::readProject(file_);
  if (!edgeLength_.empty()) {
    project.mesh.edgeLength = parsePositive("--edge-length", edgeLength_);
  }
  if (!accuracy_.empty() && !elementLength_.empty())
    throw UsageError("give either --accuracy or --element-length");
  if (!engine_.empty()) project.mesh.engine = parseEngine(engine_);
  if (!accuracy_.empty()) {
    project.mesh.accuracy = parsePositive("--accuracy", accuracy_);
    project.mesh.splineDensity = 1;
    project.mesh.elementLength.reset();
  }
  if (!elementLength_.empty())
    project.mesh.elementLength = parsePositive("--element-length", elementLength_);
  modeling::checkProject(project);
  return project;
}

}  // namespace palpa::cli

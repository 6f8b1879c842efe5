#include "app/cli/project_input.h"

#include <iostream>

#include "app/cli/errors.h"
#include "app/cli/values.h"
#include "modeling/exchange/file_format.h"
#include "modeling/project/project_file.h"

namespace palpa::cli {

void ProjectInput::declare(CLI::App& options) {
  options
      .add_option("file", file_,
                  "Project, or a CAD or mesh file: " + modeling::endingsText(modeling::isReadable))
      ->required()
      ->type_name("");
  choice_.declare(options);
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

void ProjectInput::declareModel(CLI::App& options) {
  options
      .add_option("--model", model_,
                  "Solved model of the project from palpa-mpi, which is read instead of computed")
      ->type_name("FILE");
}

app::BuildOptions ProjectInput::buildOptions() const {
  // A model that is touched once needs few columns. From about this size on, compressed operators
  // are ready sooner: 2,900 nodes take 17 % and 3,600 nodes 28 % less processor time.
  constexpr int kCompressedFrom = 2500;
  app::BuildOptions options;
  options.compressedFrom = kCompressedFrom;
  options.storedModel = model_;
  options.needsStoredModel = !model_.empty();
  return options;
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

bool ProjectInput::isImported() const {
  const auto format = modeling::fileFormatOf(file_);
  return format && modeling::isImportable(infoOf(*format));
}

modeling::Project ProjectInput::read(const Context& context) const {
  ReadBody read = readWithNotes(context.job());
  context.progress.clear();
  if (!context.options.quiet)
    for (const std::string& note : read.notes)
      std::cerr << "palpa-cli: " << file_ << ": " << note << '\n';
  return std::move(read.project);
}

ReadBody ProjectInput::readWithNotes(const Job& job) const {
  modeling::ImportOptions import;
  choice_.addTo(import);
  if (choice_.isGiven() && !isImported())
    throw UsageError(file_ +
                     " is a project, which has one body in mm; --solid and --unit are for "
                     "CAD and mesh files");
  if (!edgeLength_.empty()) import.edgeLength = parsePositive("--edge-length", edgeLength_);
  ReadBody read = isImported() ? readBody(file_, import, job)
                               : ReadBody{modeling::readProject(file_), 0.0, {}, {}};
  modeling::Project& project = read.project;
  if (import.edgeLength > 0) project.mesh.edgeLength = import.edgeLength;
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
  return read;
}

}  // namespace palpa::cli

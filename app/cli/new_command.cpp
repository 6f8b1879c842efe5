#include <iostream>

#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/shape_options.h"
#include "app/cli/suggestion.h"
#include "app/cli/text.h"
#include "app/cli/values.h"
#include "app/core/session/new_project.h"
#include "modeling/error.h"
#include "modeling/project/material_library.h"
#include "modeling/project/project_file.h"
#include "modeling/project/shore_hardness.h"

namespace palpa::cli {
namespace {

class NewCommand : public Command {
 public:
  std::string name() const override { return "new"; }
  std::string summary() const override { return "Make a project from a shape"; }
  std::string example() const override {
    return "palpa-cli new sphere --radius 25 -o ball.json\n"
           "  palpa-cli new box --size 40,30,20 -o block.json\n"
           "  palpa-cli new cone --bottom-radius 20 --top-radius 0 --height 30 -o cone.json\n"
           "  palpa-cli new cylinder --shore-a 55 -o buffer.json\n"
           "  palpa-cli new revolve --profile vase.curve.json -o vase.json\n"
           "  palpa-cli new extrude --profile bracket.dxf --height 8 -o bracket.json";
  }

  void declare(CLI::App& options) override {
    options.add_option("primitive", shape_, shapeNames())->required()->type_name("");
    shapeOptions_.declare(options);
    options
        .add_option("--edge-length", edgeLength_,
                    "Target length of mesh edges in mm (default: gives about 600 nodes)")
        ->type_name("LENGTH");
    options
        .add_option("--material", material_,
                    "Material of the library by name (see: palpa-cli materials)")
        ->type_name("NAME");
    options
        .add_option("--youngs-modulus", youngsModulus_,
                    "Young's modulus in MPa (default 0.2, a silicone)")
        ->type_name("MPA");
    options
        .add_option("--shore-a", shoreA_,
                    format("Hardness of rubber on Shore's scale A, %g to %g: estimates Young's "
                           "modulus by Gent's relation",
                           modeling::kMinShoreA, modeling::kMaxShoreA))
        ->type_name("S");
    options.add_option("--poisson-ratio", poissonRatio_, "Poisson's ratio (default 0.48)")
        ->type_name("NU");
    options
        .add_option("--density", density_,
                    "Density in kg/m³, for gravity (default 1070 with the default material)")
        ->type_name("DENSITY");
    options.add_option("--name", projectName_, "Name of the project (default: the shape)")
        ->type_name("TEXT");
    output_.declare(options, "Project file to write (default: standard output)");
  }

  void run(const Context& context) override {
    const ShapeOptions::Result chosen = shapeOptions_.primitive(shape_);
    const modeling::Primitive& primitive = chosen.primitive;
    const modeling::MadeSolid made = modeling::makeMeasuredPrimitive(primitive);
    modeling::Project project =
        app::makeProject(primitive, made.solid, projectName_.empty() ? shape_ : projectName_);
    setMaterial(project.material);
    if (!density_.empty()) project.material.densityKgPerM3 = parsePositive("--density", density_);
    if (!edgeLength_.empty()) project.mesh.edgeLength = parsePositive("--edge-length", edgeLength_);
    modeling::checkProject(project);
    if (!output_.isGiven()) {
      std::cout << modeling::toJson(project);
      return;
    }
    modeling::writeProject(project, output_.path());
    report(context, project, made.deviation, chosen.drawingDeviation);
  }

 private:
  void setMaterial(modeling::Material& material) const {
    if (!material_.empty()) {
      if (!youngsModulus_.empty() || !shoreA_.empty() || !poissonRatio_.empty())
        throw UsageError(
            "--material brings its constants; leave out the modulus, the hardness and the ratio");
      try {
        material = modeling::libraryMaterial(material_).material;
      } catch (const modeling::ModelingError&) {
        std::vector<std::string> names;
        for (const auto& each : modeling::materialLibrary()) names.push_back(each.material.name);
        const std::string suggestion = didYouMean(material_, names);
        if (suggestion.empty()) throw;
        throw UsageError("--material: there is no material '" + material_ + "'" + suggestion);
      }
      return;
    }
    if (youngsModulus_.empty() && shoreA_.empty() && poissonRatio_.empty()) return;
    material.name = "custom";
    material.densityKgPerM3.reset();
    if (!shoreA_.empty()) {
      if (!youngsModulus_.empty())
        throw UsageError("--shore-a estimates Young's modulus; leave out --youngs-modulus");
      const double hardness = parseNumber("--shore-a", shoreA_);
      if (hardness < modeling::kMinShoreA || hardness > modeling::kMaxShoreA)
        throw UsageError(format("--shore-a: expected a hardness from %g to %g, found '%s'",
                                modeling::kMinShoreA, modeling::kMaxShoreA, shoreA_.c_str()));
      material.name = format("rubber of %g Shore A, estimated", hardness);
      material.youngsModulus = modeling::estimatedModulusOfShoreA(hardness);
    }
    if (!youngsModulus_.empty())
      material.youngsModulus = parsePositive("--youngs-modulus", youngsModulus_);
    if (!poissonRatio_.empty())
      material.poissonRatio = parseNumber("--poisson-ratio", poissonRatio_);
  }

  void report(const Context& context, const modeling::Project& project, double deviation,
              std::optional<double> drawingDeviation) const {
    const auto names = modeling::patchNames(project.body);
    Json json{{"file", output_.path()},
              {"name", project.name},
              {"primitive", shape_},
              {"patches", names},
              {"control_points", std::get<modeling::Solid>(project.body).controlPoints().size()},
              {"deviation_mm", deviation}};
    if (drawingDeviation) json["drawing_deviation_mm"] = *drawingDeviation;
    std::string material;
    if (!shoreA_.empty()) {
      json["youngs_modulus_MPa"] = project.material.youngsModulus;
      material = format(", Young's modulus %g MPa estimated from its hardness",
                        project.material.youngsModulus);
    }
    const auto [low, high] = modeling::boundingBox(project.body);
    const std::string fit = deviation <= 1e-12 * (high - low).norm()
                                ? "exactly the shape"
                                : format("within %.2g mm of the exact shape", deviation);
    const std::string drawing =
        !drawingDeviation ? ""
        : *drawingDeviation < 1e-9
            ? ", the profile exactly as drawn"
            : format(", the profile within %.2g mm of the drawing", *drawingDeviation);
    context.print(json, format("%s: %s with the patches %s, %s%s, fixed at its base%s\n",
                               output_.path().c_str(), shape_.c_str(),
                               modeling::quotedPatchNames(project.body).c_str(), fit.c_str(),
                               drawing.c_str(), material.c_str()));
  }

  std::string shape_;
  ShapeOptions shapeOptions_;
  std::string edgeLength_;
  std::string material_;
  std::string youngsModulus_;
  std::string shoreA_;
  std::string poissonRatio_;
  std::string density_;
  std::string projectName_;
  OutputOption output_;
};

}  // namespace

std::unique_ptr<Command> makeNewCommand() {
  return std::make_unique<NewCommand>();
}

}  // namespace palpa::cli

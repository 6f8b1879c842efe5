#include <iostream>

#include "app/cli/body_file.h"
#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/text.h"
#include "app/cli/values.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"

namespace palpa::cli {
namespace {

class NewCommand : public Command {
 public:
  std::string name() const override { return "new"; }
  std::string summary() const override { return "Make a project from a primitive"; }
  std::string example() const override {
    return "palpa-cli new sphere --radius 25 -o ball.json\n"
           "  palpa-cli new cylinder --radius 20 --height 60 -o post.json\n"
           "  palpa-cli new box --size 40,30,20 -o block.json";
  }

  void declare(CLI::App& options) override {
    options.add_option("primitive", primitive_, "sphere, cylinder or box")
        ->required()
        ->type_name("");
    options.add_option("--radius", radius_, "Radius in mm (sphere, cylinder; default 25, 20)")
        ->type_name("LENGTH");
    options.add_option("--height", height_, "Height in mm (cylinder; default 60)")
        ->type_name("LENGTH");
    options.add_option("--size", size_, "Edge lengths in mm (box; default 40,30,20)")
        ->type_name("X,Y,Z");
    options
        .add_option("--edge-length", edgeLength_,
                    "Target length of mesh edges in mm (default: gives about 600 nodes)")
        ->type_name("LENGTH");
    options
        .add_option("--youngs-modulus", youngsModulus_,
                    "Young's modulus in MPa (default 0.2, soft silicone)")
        ->type_name("MPA");
    options.add_option("--poisson-ratio", poissonRatio_, "Poisson's ratio (default 0.48)")
        ->type_name("NU");
    options.add_option("--name", projectName_, "Name of the project (default: the primitive)")
        ->type_name("TEXT");
    options.add_option("-o,--output", output_, "Project file to write (default: standard output)")
        ->type_name("FILE");
  }

  void run(const Context& context) override {
    modeling::Project project = makeSolid();
    project.name = projectName_.empty() ? primitive_ : projectName_;
    project.material.name =
        youngsModulus_.empty() && poissonRatio_.empty() ? "soft silicone" : "custom";
    project.material.youngsModulus =
        youngsModulus_.empty() ? 0.2 : parsePositive("--youngs-modulus", youngsModulus_);
    project.material.poissonRatio =
        poissonRatio_.empty() ? 0.48 : parseNumber("--poisson-ratio", poissonRatio_);
    if (!edgeLength_.empty()) {
      project.mesh.edgeLength = parsePositive("--edge-length", edgeLength_);
    }
    modeling::checkProject(project);
    if (output_.empty()) {
      std::cout << modeling::toJson(project);
      return;
    }
    modeling::writeProject(project, output_);
    Json report{
        {"file", output_}, {"name", project.name}, {"patches", modeling::patchNames(project.body)}};
    context.print(report,
                  format("%s: %s with the patches %s, held at its base\n", output_.c_str(),
                         primitive_.c_str(), modeling::quotedPatchNames(project.body).c_str()));
  }

 private:
  /// The solid, clamped at its base, with a mesh that suits its size.
  modeling::Project makeSolid() const {
    using modeling::Region;
    modeling::Project project;
    modeling::Support base;
    base.name = "base";
    if (primitive_ == "sphere") {
      refuse("--height", height_);
      refuse("--size", size_);
      const double radius = radius_.empty() ? 25 : parsePositive("--radius", radius_);
      project.body = modeling::makeSphere(radius);
      base.where = Region::below(Eigen::Vector3d::UnitZ(), -0.8 * radius);
    } else if (primitive_ == "cylinder") {
      refuse("--size", size_);
      const double radius = radius_.empty() ? 20 : parsePositive("--radius", radius_);
      const double height = height_.empty() ? 60 : parsePositive("--height", height_);
      project.body = modeling::makeCylinder(radius, height);
      base.where = Region::ofPatches({"bottom"});
    } else if (primitive_ == "box") {
      refuse("--radius", radius_);
      refuse("--height", height_);
      const Eigen::Vector3d size =
          size_.empty() ? Eigen::Vector3d(40, 30, 20) : parseVector("--size", size_);
      if (!(size.minCoeff() > 0)) throw UsageError("--size: all lengths must be greater than zero");
      project.body = modeling::makeBox(size);
      base.where = Region::ofPatches({"bottom"});
    } else {
      throw UsageError("unknown primitive '" + primitive_ + "'; known are sphere, cylinder, box");
    }
    project.supports = {base};
    project.mesh.edgeLength = suitableEdgeLength(project.body);
    return project;
  }

  void refuse(const std::string& option, const std::string& value) const {
    if (!value.empty()) throw UsageError(option + " has no meaning for a " + primitive_);
  }

  std::string primitive_;
  std::string radius_;
  std::string height_;
  std::string size_;
  std::string edgeLength_;
  std::string youngsModulus_;
  std::string poissonRatio_;
  std::string projectName_;
  std::string output_;
};

}  // namespace

std::unique_ptr<Command> makeNewCommand() {
  return std::make_unique<NewCommand>();
}

}  // namespace palpa::cli

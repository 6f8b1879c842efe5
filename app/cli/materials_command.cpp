#include "app/cli/commands.h"
#include "app/cli/text.h"
#include "modeling/project/json_values.h"
#include "modeling/project/material_library.h"

namespace palpa::cli {
namespace {

class MaterialsCommand : public Command {
 public:
  std::string name() const override { return "materials"; }
  std::string summary() const override {
    return "List the material library with the sources of its constants";
  }
  std::string example() const override { return "palpa-cli materials --json"; }

  void declare(CLI::App&) override {}

  void run(const Context& context) override {
    Json report{{"materials", Json::array()}};
    std::string text;
    for (const auto& [material, note, reference] : modeling::materialLibrary()) {
      Json& entry = report["materials"].emplace_back(modeling::jsonOf(material));
      entry["note"] = note;
      entry["reference"] = reference;
      text += format("%s: E = %.6g MPa, nu = %.6g", material.name.c_str(), material.youngsModulus,
                     material.poissonRatio);
      if (material.densityKgPerM3) text += format(", density %.6g kg/m³", *material.densityKgPerM3);
      text += "\n";
      text += "  " + note + "\n  " + reference + "\n";
    }
    context.print(report, text);
  }
};

}  // namespace

std::unique_ptr<Command> makeMaterialsCommand() {
  return std::make_unique<MaterialsCommand>();
}

}  // namespace palpa::cli

#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/project_input.h"
#include "app/cli/result_file.h"
#include "app/cli/section_options.h"
#include "app/cli/text.h"
#include "app/cli/touch_options.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/section_file.h"
#include "app/core/results/stress_numbers.h"
#include "modeling/exchange/file_format.h"

namespace palpa::cli {
namespace {

/// Largest values of the fields on a section, and where they are.
struct Extremes {
  std::size_t displacement = 0, vonMises = 0, tension = 0, compression = 0;
};

Extremes extremesOf(const std::vector<bem::InteriorState>& states) {
  Extremes found;
  double moved = -1, stress = -1, tension = -1e300, compression = 1e300;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const app::StressNumbers numbers = app::stressNumbers(states[k].stress);
    const auto keep = [k](bool isBetter, double value, double& best, std::size_t& at) {
      if (!isBetter) return;
      best = value;
      at = k;
    };
    const double length = states[k].displacement.norm();
    keep(length > moved, length, moved, found.displacement);
    keep(numbers.vonMises > stress, numbers.vonMises, stress, found.vonMises);
    keep(numbers.principal[0] > tension, numbers.principal[0], tension, found.tension);
    keep(numbers.principal[2] < compression, numbers.principal[2], compression, found.compression);
  }
  return found;
}

class SectionCommand : public Command {
 public:
  std::string name() const override { return "section"; }
  std::string summary() const override {
    return "Displacement, stress and strain on a plane through the body";
  }
  std::string example() const override {
    return "palpa-cli section ball.json --section x=0 -o section.csv\n"
           "  palpa-cli section ball.json --section 1,0,1,5 --at 0,0,25 --displace 0,0,-2 -o "
           "cut.vtp";
  }

  void declare(CLI::App& options) override {
    input_.declare(options);
    section_.declare(options, true);
    touch_.declare(options);
    output_.declare(options, "Table (.csv) or mesh of the section with fields (.vtp)");
  }

  void run(const Context& context) override {
    touch_.validate();
    const modeling::Plane plane = *section_.plane();
    if (output_.isGiven() && output_.ending() != ".csv") {
      const auto format = modeling::requireFormat(output_.path(), modeling::isWritableMesh);
      if (format != modeling::FileFormat::kVtp)
        throw UsageError("--output: a section is written as .csv or .vtp, found '" +
                         output_.path() + "'");
    }
    const modeling::Project project = touch_.touched(input_.read(context));
    const auto model = app::buildTouchModel(project, {}, context.job());
    const bool touched = touch_.isGiven() || !project.touches.empty();
    const app::TouchState state = touched ? touch_.play(*model, project, context) : model->rest();
    const auto body = std::make_shared<const app::DrawnBody>(model);
    const auto section = std::make_shared<const app::BodySection>(body, plane, context.job());
    if (section->isEmpty())
      throw UsageError(
          "--section: the plane does not cut the body; choose an offset between its ends");
    const app::SectionField field(section, context.job());
    const std::vector<bem::InteriorState> states = field.states(state.field, context.job());
    context.progress.clear();
    if (output_.isGiven()) app::writeSection(*section, states, output_.path());
    report(*section, states, context);
  }

 private:
  void report(const app::BodySection& section, const std::vector<bem::InteriorState>& states,
              const Context& context) const {
    const modeling::PlaneSection& mesh = section.mesh();
    double area = 0;
    for (const auto& t : mesh.triangles)
      area += (mesh.positions[static_cast<std::size_t>(t[1])] -
               mesh.positions[static_cast<std::size_t>(t[0])])
                  .cross(mesh.positions[static_cast<std::size_t>(t[2])] -
                         mesh.positions[static_cast<std::size_t>(t[0])])
                  .norm() /
              2;
    const Extremes extremes = extremesOf(states);
    const auto stress = [&](std::size_t k) { return app::stressNumbers(states[k].stress); };
    Json json{{"points", mesh.positions.size()}, {"area_mm2", area}};
    json["normal"] = toJson(section.plane().normal);
    json["offset_mm"] = section.plane().offset;
    std::string text = format("section    %zu points, %.5g mm^2\n", mesh.positions.size(), area);
    const auto add = [&](const char* label, const char* key, double value, const char* unit,
                         std::size_t at) {
      text += format("%-28s %.4g %s at ", label, value, unit) + toText(mesh.positions[at]) + "\n";
      json[key] = {{"value", value}, {"at_mm", toJson(mesh.positions[at])}};
    };
    add("largest displacement", "displacement_mm",
        states[extremes.displacement].displacement.norm(), "mm", extremes.displacement);
    add("largest von Mises stress", "von_mises_MPa", stress(extremes.vonMises).vonMises, "MPa",
        extremes.vonMises);
    add("largest principal stress", "largest_principal_MPa", stress(extremes.tension).principal[0],
        "MPa", extremes.tension);
    add("smallest principal stress", "smallest_principal_MPa",
        stress(extremes.compression).principal[2], "MPa", extremes.compression);
    if (output_.isGiven()) output_.addTo(json, text);
    context.print(json, text);
  }

  ProjectInput input_;
  SectionOptions section_;
  TouchOptions touch_;
  OutputOption output_;
};

}  // namespace

std::unique_ptr<Command> makeSectionCommand() {
  return std::make_unique<SectionCommand>();
}

}  // namespace palpa::cli

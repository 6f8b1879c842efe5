#include <algorithm>
#include <numeric>

#include "app/cli/commands.h"
#include "app/cli/output_option.h"
#include "app/cli/project_input.h"
#include "app/cli/result_file.h"
#include "app/cli/text.h"
#include "app/cli/values.h"
#include "app/core/design/shape_measures.h"
#include "app/core/design/stiffness_gradient.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/error_estimate.h"
#include "app/core/results/touch.h"
#include "modeling/error.h"

namespace palpa::cli {
namespace {

/// Control points that the text names: those with the largest gradients.
constexpr std::size_t kNamedPoints = 5;

Json rowsOf(const Eigen::Matrix3Xd& gradient) {
  Json rows = Json::array();
  for (Eigen::Index k = 0; k < gradient.cols(); ++k)
    rows.push_back(toJson(Eigen::Vector3d(gradient.col(k))));
  return rows;
}

std::string strongest(const Eigen::Matrix3Xd& gradient, const modeling::Solid& solid) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(gradient.cols()));
  std::iota(order.begin(), order.end(), 0);
  const std::size_t count = std::min(kNamedPoints, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](Eigen::Index a, Eigen::Index b) {
                      return gradient.col(a).squaredNorm() > gradient.col(b).squaredNorm();
                    });
  std::string text;
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector3d by = gradient.col(order[k]);
    text += format("           point %d at ", static_cast<int>(order[k])) +
            toText(solid.controlPoints()[static_cast<std::size_t>(order[k])]) +
            format(" mm: (%.3g, %.3g, %.3g) N/mm per mm\n", by.x(), by.y(), by.z());
  }
  return text;
}

class GradientCommand : public Command {
 public:
  std::string name() const override { return "gradient"; }
  std::string summary() const override {
    return "How the stiffness of a project's touches changes with its control points";
  }
  std::string example() const override {
    return "palpa-cli gradient projects/box.json\n"
           "  palpa-cli gradient projects/box.json --json -o gradient.json";
  }

  void declare(CLI::App& options) override {
    input_.declare(options);
    output_.declare(options, "JSON file to write instead of standard output");
  }

  void run(const Context& context) override {
    const modeling::Project project = input_.read(context);
    if (project.touches.empty())
      throw modeling::ModelingError(input_.file() +
                                    ": the project has no touches, so there is no stiffness; "
                                    "record one with edit or in the window");
    const auto model = app::buildTouchModel(project, {}, context.job());
    const app::StiffnessGradients gradients(project, *model, context.job());
    app::TouchState state = app::playTouches(*model, project.touches, 0, context.job());
    app::addErrors(*model, state, context.job());
    const auto& solid = std::get<modeling::Solid>(project.body);

    Json json{{"touches", Json::array()}};
    std::string text;
    for (const app::TouchState::Contact& contact : state.contacts) {
      const app::StiffnessGradient each =
          gradients.of(app::stiffnessRuleOf(contact), context.job());
      Json entry{{"name", each.name},
                 {"stiffness_N_per_mm", each.stiffness},
                 {"gradient_N_per_mm2", rowsOf(each.gradient)}};
      if (contact.errorEstimate) entry["error_estimate"] = *contact.errorEstimate;
      json["touches"].push_back(std::move(entry));
      text += format("touch      %s: stiffness %.4g N/mm, changed most by\n", each.name.c_str(),
                     each.stiffness) +
              strongest(each.gradient, solid);
    }
    Json body;
    const auto add = [&](const char* value, const char* gradient, const char* line,
                         const std::optional<app::ShapeMeasure>& measure) {
      if (!measure) return;
      body[value] = measure->value;
      body[gradient] = rowsOf(measure->gradient);
      text += format(line, measure->value);
    };
    add("volume_mm3", "volume_gradient_mm2", "volume     %.6g mm³\n",
        app::volumeOf(gradients.surface()));
    add("area_mm2", "area_gradient_mm", "surface    %.6g mm²\n", app::areaOf(gradients.surface()));
    add("mass_kg", "mass_gradient_kg_per_mm", "mass       %.4g kg\n",
        app::massOf(gradients.surface(), project.material));
    add("smallest_thickness_mm", "smallest_thickness_gradient", "thinnest   %.4g mm\n",
        app::smallestThickness(solid));
    json["body"] = std::move(body);
    context.progress.clear();
    if (output_.isGiven()) {
      writeText(jsonText(json), output_.path());
      output_.addTo(json, text);
    }
    context.print(json, text);
  }

 private:
  ProjectInput input_;
  OutputOption output_;
};

}  // namespace

std::unique_ptr<Command> makeGradientCommand() {
  return std::make_unique<GradientCommand>();
}

}  // namespace palpa::cli

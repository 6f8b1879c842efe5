#include "app/cli/commands.h"
#include "app/cli/project_input.h"
#include "app/cli/text.h"
#include "app/report/words.h"
#include "base/count_text.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/json_values.h"
#include "modeling/project/mesh_foci.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::cli {
namespace {

/// Corners of the box around the surface, from points on it (the box of the control points is
/// larger than a curved body).
std::array<Eigen::Vector3d, 2> surfaceBox(const modeling::SurfaceEvaluator& surface) {
  constexpr int kSteps = 48;
  Eigen::Vector3d low = surface.position(0, surface.range(0, 0)[0], surface.range(0, 1)[0]);
  Eigen::Vector3d high = low;
  for (int patch = 0; patch < surface.patchCount(); ++patch) {
    const auto u = surface.range(patch, 0);
    const auto v = surface.range(patch, 1);
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        const Eigen::Vector3d p = surface.position(patch, u[0] + (u[1] - u[0]) * i / kSteps,
                                                   v[0] + (v[1] - v[0]) * j / kSteps);
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
  }
  return {low, high};
}

std::array<Eigen::Vector3d, 2> surfaceBox(const modeling::Body& body) {
  const auto* solid = std::get_if<modeling::Solid>(&body);
  return solid ? surfaceBox(modeling::SurfaceEvaluator(*solid)) : modeling::boundingBox(body);
}

/// Adds the parts of the body to the report and returns them as text.
std::string describe(const modeling::Solid& solid, Json& report) {
  report["control_points"] = solid.controlPoints().size();
  report["patches"] = Json::array();
  std::string text =
      format("solid      %zu patches over %s control points\n", solid.patches().size(),
             countText(solid.controlPoints().size()).c_str());
  for (const modeling::Patch& patch : solid.patches()) {
    report["patches"].push_back({{"name", patch.name},
                                 {"degree", {patch.degree[0], patch.degree[1]}},
                                 {"net", {patch.net.size(), patch.net.front().size()}}});
    text += format("  %s: degree %d × %d, net %zu × %zu\n", patch.name.c_str(), patch.degree[0],
                   patch.degree[1], patch.net.size(), patch.net.front().size());
  }
  return text;
}

std::string describe(const modeling::MeshBody& body, Json& report) {
  std::vector<std::size_t> triangles(body.faceNames().size(), 0);
  for (const int face : body.faceOfTriangle()) ++triangles[face];
  report["vertices"] = body.positions().size();
  report["triangles"] = body.triangles().size();
  report["faces"] = Json::array();
  std::string text =
      format("mesh body  %zu %s, %s triangles; it has no control points\n", triangles.size(),
             triangles.size() == 1 ? "face" : "faces", countText(body.triangles().size()).c_str());
  for (std::size_t face = 0; face < triangles.size(); ++face) {
    const std::string& name = body.faceNames()[face];
    report["faces"].push_back({{"name", name}, {"triangles", triangles[face]}});
    text += format("  %s: %s triangles\n", name.c_str(), countText(triangles[face]).c_str());
  }
  return text;
}

std::string describe(const modeling::Body& body, Json& report) {
  return std::visit([&](const auto& one) { return describe(one, report); }, body);
}

/// Of a mesh body the mesh itself, which costs little and is exact where many features are small.
double expectedNodes(const modeling::Project& project, const Job& job) {
  const auto regions = modeling::meshRegions(project);
  const auto foci = modeling::meshFoci(project);
  const double estimate = modeling::estimateNodeCount(project.body, project.mesh, regions, foci);
  constexpr double kMaxMeshed = 50'000;
  if (std::holds_alternative<modeling::Solid>(project.body) || !(estimate < kMaxMeshed))
    return estimate;
  try {
    return static_cast<double>(
        modeling::mesh(project.body, project.mesh, regions, job, foci).positions.size());
  } catch (const modeling::ModelingError&) {
    return estimate;  // `mesh` and `check` say why there is no mesh
  }
}

class InfoCommand : public Command {
 public:
  std::string name() const override { return "info"; }
  std::string summary() const override { return "Show the contents of a project"; }
  std::string example() const override { return "palpa-cli info ball.json"; }

  void declare(CLI::App& options) override { input_.declare(options); }

  void run(const Context& context) override {
    const modeling::Project project = input_.read(context);
    const auto box = surfaceBox(project.body);
    const double volume = modeling::volume(project.body);
    const double area = modeling::area(project.body);
    const double nodes = expectedNodes(project, context.job());

    Json report{{"name", project.name},
                {"material", modeling::jsonOf(project.material)},
                {"bounding_box_mm", {toJson(box[0]), toJson(box[1])}},
                {"volume_mm3", volume},
                {"area_mm2", area},
                {"supports", Json::array()},
                {"loads", Json::array()},
                {"touches", Json::array()},
                {"measurements", Json::array()},
                {"mesh",
                 {{"edge_length_mm", project.mesh.edgeLength},
                  {"estimated_nodes", static_cast<long>(nodes)}}}};

    std::string text = "name       " + project.name + "\n";
    text += format("material   %s, E = %.6g MPa, nu = %.6g", project.material.name.c_str(),
                   project.material.youngsModulus, project.material.poissonRatio);
    if (project.material.densityKgPerM3)
      text += format(", density %.6g kg/m³", *project.material.densityKgPerM3);
    text += "\n";
    text += describe(project.body, report);
    text += "size       " + toText(box[0]) + " … " + toText(box[1]) + " mm\n";
    text += format("volume     %.6g mm³, surface %.6g mm²\n", volume, area);
    for (const modeling::Support& support : project.supports) {
      const char* kind = support.kind == modeling::Support::Kind::kFixed ? "fixed" : "roller";
      report["supports"].push_back({{"name", support.name},
                                    {"kind", kind},
                                    {"where", report::regionText(support.where)},
                                    {"displacement_mm", toJson(support.displacement)}});
      text += "support    " + support.name + ": " + kind + ", " + report::regionText(support.where);
      if (support.displacement.norm() > 0) {
        text += ", moved by " + toText(support.displacement) + " mm";
      }
      text += "\n";
    }
    for (const modeling::Load& load : project.loads) {
      report["loads"].push_back({{"name", load.name}, {"what", report::loadText(load)}});
      text += "load       " + load.name + ": " + report::loadText(load) + "\n";
    }
    for (const modeling::Touch& touch : project.touches) {
      report["touches"].push_back({{"name", touch.name}, {"what", report::touchText(touch)}});
      text += "touch      " + touch.name + ": " + report::touchText(touch) + "\n";
    }
    for (const modeling::Measurement& measurement : project.measurements) {
      const char* kind = modeling::infoOf(measurement.kind).name;
      report["measurements"].push_back({{"name", measurement.name}, {"kind", kind}});
      text += "measured   " + measurement.name + ": " + kind + "\n";
    }
    if (project.design) {
      report["design"] = modeling::jsonOf(*project.design);
      for (const modeling::DesignTarget& target : project.design->targets)
        text += "target     " + target.touch +
                format(target.kind == modeling::DesignTarget::Kind::kForce ? ": %.6g N\n"
                                                                           : ": %.6g N/mm\n",
                       target.value);
    }
    text += format("mesh       edge length %.6g mm, about %s nodes\n", project.mesh.edgeLength,
                   estimateText(nodes).c_str());
    context.print(report, text);
  }

 private:
  ProjectInput input_;
};

}  // namespace

std::unique_ptr<Command> makeInfoCommand() {
  return std::make_unique<InfoCommand>();
}

}  // namespace palpa::cli

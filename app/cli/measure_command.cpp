#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/project_input.h"
#include "app/cli/text.h"
#include "app/cli/values.h"
#include "modeling/error.h"
#include "modeling/measure/measured_body.h"
#include "modeling/project/json_values.h"
#include "modeling/project/project_file.h"

namespace palpa::cli {
namespace {

using modeling::MeasuredBody;
using modeling::MeasuredPlace;
using modeling::MeasuredValue;
using modeling::Measurement;
using modeling::MeasurementKind;
using What = MeasuredPlace::What;

/// Reads places such as "1,2,3", "face:top", "face:0,0,20", "edge:top/u_min", "edge:20,0,20".
class PlaceReader {
 public:
  PlaceReader(const modeling::Project& project, const MeasuredBody& body)
      : project_(project), body_(body), names_(modeling::patchNames(project.body)) {}

  MeasuredPlace read(const std::string& option, const std::string& text) const {
    const auto colon = text.find(':');
    if (colon == std::string::npos) return nearest(parseVector(option, text));
    const std::string what = text.substr(0, colon), where = text.substr(colon + 1);
    if (what == "face") return face(option, where);
    if (what == "edge") return edge(option, where);
    throw UsageError(option + ": expected x,y,z, face:… or edge:…, found '" + text + "'");
  }

 private:
  static bool isPosition(const std::string& text) {
    return std::count(text.begin(), text.end(), ',') == 2;
  }

  int patchNear(const Eigen::Vector3d& x) const {
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int patch = 0; patch < static_cast<int>(names_.size()); ++patch) {
      const double distance = (body_.position(body_.placeNear(patch, x)) - x).norm();
      if (distance >= least) continue;
      least = distance;
      best = patch;
    }
    return best;
  }

  MeasuredPlace nearest(const Eigen::Vector3d& x) const { return body_.placeNear(patchNear(x), x); }

  int patchNamed(const std::string& option, const std::string& name) const {
    const auto found = modeling::findPatch(project_.body, name);
    if (!found)
      throw UsageError(option + ": no patch is named '" + name + "'; the body has " +
                       modeling::quotedPatchNames(project_.body));
    return *found;
  }

  /// A named face is measured at the middle of its box, or at the middle of its parameters.
  MeasuredPlace face(const std::string& option, const std::string& where) const {
    MeasuredPlace place;
    if (isPosition(where)) {
      place = nearest(parseVector(option, where));
    } else {
      const int patch = patchNamed(option, where);
      place.patch = where;
      if (const auto* mesh = std::get_if<modeling::MeshBody>(&project_.body)) {
        Eigen::AlignedBox3d box;
        for (std::size_t t = 0; t < mesh->triangles().size(); ++t)
          if (mesh->faceOfTriangle()[t] == patch)
            for (const int v : mesh->triangles()[t])
              box.extend(mesh->positions()[static_cast<std::size_t>(v)]);
        place = body_.placeNear(patch, box.center());
      }
    }
    place.what = What::kFace;
    return place;
  }

  MeasuredPlace edge(const std::string& option, const std::string& where) const {
    if (isPosition(where)) {
      const Eigen::Vector3d x = parseVector(option, where);
      const auto place = body_.edgeNear(patchNear(x), x);
      if (!place) throw UsageError(option + ": the body has no edges");
      return *place;
    }
    const auto slash = where.rfind('/');
    const auto side =
        std::find_if(modeling::kSides.begin(), modeling::kSides.end(), [&](modeling::Side each) {
          return slash != std::string::npos && modeling::sideKey(each) == where.substr(slash + 1);
        });
    if (side == modeling::kSides.end() || !std::holds_alternative<modeling::Solid>(project_.body))
      throw UsageError(option + ": expected edge:x,y,z" +
                       (std::holds_alternative<modeling::Solid>(project_.body)
                            ? " or edge:PATCH/SIDE with u_min, u_max, v_min or v_max"
                            : "") +
                       ", found '" + where + "'");
    patchNamed(option, where.substr(0, slash));
    return {What::kEdge, where.substr(0, slash), Eigen::Vector2d(0.5, 0.5), *side};
  }

  const modeling::Project& project_;
  const MeasuredBody& body_;
  std::vector<std::string> names_;
};

const char* fitName(MeasuredValue::Fit fit) {
  switch (fit) {
    case MeasuredValue::Fit::kSphere:
      return "sphere";
    case MeasuredValue::Fit::kCylinder:
      return "cylinder";
    case MeasuredValue::Fit::kCircle:
      return "circle";
    case MeasuredValue::Fit::kPolynomial:
      return "polynomial";
    case MeasuredValue::Fit::kNone:
      break;
  }
  return nullptr;
}

/// JSON has no infinity.
Json finite(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string radiusText(double radius) {
  if (!std::isfinite(radius)) return "flat";
  return format("%.8g mm", std::abs(radius)) + (radius < 0 ? " (hollow)" : "");
}

void report(const Measurement& measurement, const MeasuredValue& value, Json& json,
            std::string& text) {
  constexpr double kDegree = 180 / std::numbers::pi;
  double accuracy = value.accuracy;
  const char* unit = "mm";
  switch (measurement.kind) {
    case MeasurementKind::kDistance:
      json["distance_mm"] = value.value;
      text += format("%.8g mm", value.value);
      break;
    case MeasurementKind::kLength:
      json["length_mm"] = value.value;
      text += format("%.8g mm", value.value);
      if (value.second) {
        json["whole_length_mm"] = *value.second;
        text += format(", whole edge %.8g mm", *value.second);
      }
      break;
    case MeasurementKind::kAngle:
      json["angle_deg"] = value.value * kDegree;
      text += format("%.8g°", value.value * kDegree);
      accuracy *= kDegree;
      unit = "deg";
      break;
    case MeasurementKind::kThickness:
      json["thickness_mm"] = value.value;
      json["ball_diameter_mm"] = *value.second;
      text += format("%.8g mm, ball inside %.6g mm", value.value, *value.second);
      break;
    case MeasurementKind::kRadius:
      json["radius_mm"] = finite(value.value);
      text += radiusText(value.value);
      if (value.second) {
        json["other_radius_mm"] = finite(*value.second);
        text += ", across " + radiusText(*value.second);
      }
      break;
  }
  json[std::string("accuracy_") + unit] = accuracy;
  text += format(" (± %.1g %s)", accuracy, unit[0] == 'm' ? "mm" : "°");
  if (const char* fit = fitName(value.fit)) {
    json["fit"] = fit;
    text += std::string(", by a ") + fit + " through the vertices";
  }
  json["points_mm"] = Json::array();
  for (const Eigen::Vector3d& point : value.points) json["points_mm"].push_back(toJson(point));
}

class MeasureCommand : public Command {
 public:
  std::string name() const override { return "measure"; }
  std::string summary() const override {
    return "Distances, lengths, angles, wall thicknesses and radii; volume and area";
  }
  std::string example() const override {
    return "palpa-cli measure box.json --distance face:bottom face:top\n"
           "  palpa-cli measure box.json --thickness 0,0,20 --radius edge:20,0,20 --json\n"
           "  palpa-cli measure box.json --angle face:top face:side_xmin -o measured.json";
  }

  void declare(CLI::App& options) override {
    input_.declare(options);
    const auto add = [&](MeasurementKind kind, const char* option, int least, int most,
                         const char* help) {
      options.add_option(option, texts_[static_cast<std::size_t>(kind)], help)
          ->expected(least, most)
          ->type_name("PLACE");
    };
    add(MeasurementKind::kDistance, "--distance", 2, 2,
        "Shortest distance of two places: x,y,z (the nearest surface point), face:NAME, "
        "face:x,y,z, edge:x,y,z (the nearest edge) or edge:PATCH/SIDE");
    add(MeasurementKind::kLength, "--length", 1, 1, "Length of an edge");
    add(MeasurementKind::kAngle, "--angle", 2, 3,
        "Angle of two faces or edges, or at the second of three points");
    add(MeasurementKind::kThickness, "--thickness", 1, 1,
        "Wall thickness at a point, and the largest ball inside that touches it");
    add(MeasurementKind::kRadius, "--radius", 1, 1,
        "Radii of curvature at a point, or the radius of an edge");
    output_.declare(options, "Project to write with these measurements added to its own");
  }

  void run(const Context& context) override {
    modeling::Project project = input_.read(context);
    const MeasuredBody body(project.body);
    const std::size_t stored = project.measurements.size();
    addRequested(project, body);
    if (output_.isGiven() && project.measurements.size() == stored)
      throw UsageError("--output: there is nothing to add; measure something, or leave it out");

    const auto box = modeling::boundingBox(project.body);
    const double volume = modeling::volume(project.body), area = modeling::area(project.body);
    Json json{{"volume_mm3", volume},
              {"area_mm2", area},
              {"bounding_box_mm", {toJson(box[0]), toJson(box[1])}},
              {"measurements", Json::array()}};
    std::string text = format("volume     %.8g mm³\nsurface    %.8g mm²\n", volume, area);
    text += "size       " + toText(box[0]) + " … " + toText(box[1]) + " mm\n";
    for (std::size_t i = 0; i < project.measurements.size(); ++i) {
      const Measurement& each = project.measurements[i];
      Json& entry = json["measurements"].emplace_back(
          Json{{"name", each.name}, {"kind", modeling::infoOf(each.kind).name}});
      std::string line = each.name + ": ";
      try {
        report(each, body.measure(each), entry, line);
      } catch (const modeling::ModelingError& error) {
        // A measurement of the file whose place is gone is a result; one that was asked for is not.
        if (i >= stored) throw;
        entry["problem"] = error.what();
        line += error.what();
      }
      text += "measured   " + line + "\n";
    }
    if (output_.isGiven()) {
      modeling::writeProject(project, output_.path());
      output_.addTo(json, text);
    }
    context.print(json, text);
  }

 private:
  void addRequested(modeling::Project& project, const MeasuredBody& body) const {
    const PlaceReader reader(project, body);
    for (const modeling::MeasurementKindInfo& info : modeling::kMeasurementKinds) {
      const std::string option = std::string("--") + info.name;
      const std::vector<std::string>& texts = texts_[static_cast<std::size_t>(info.kind)];
      if (texts.empty()) continue;
      Measurement measurement{freeName(project, info.name), info.kind, {}};
      for (const std::string& text : texts) measurement.places.push_back(reader.read(option, text));
      try {
        modeling::checkMeasurement(measurement, option);
      } catch (const modeling::ModelingError& error) {
        throw UsageError(error.what());
      }
      project.measurements.push_back(std::move(measurement));
    }
  }

  static std::string freeName(const modeling::Project& project, const std::string& stem) {
    for (int i = 1;; ++i) {
      std::string name = stem + " " + std::to_string(i);
      if (std::none_of(project.measurements.begin(), project.measurements.end(),
                       [&](const Measurement& each) { return each.name == name; }))
        return name;
    }
  }

  ProjectInput input_;
  std::array<std::vector<std::string>, modeling::kMeasurementKinds.size()> texts_;
  OutputOption output_;
};

}  // namespace

std::unique_ptr<Command> makeMeasureCommand() {
  return std::make_unique<MeasureCommand>();
}

}  // namespace palpa::cli

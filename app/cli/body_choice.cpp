#include "app/cli/body_choice.h"

#include <algorithm>

#include "app/cli/errors.h"
#include "app/cli/text.h"
#include "app/cli/values.h"
#include "base/count_text.h"
#include "modeling/exchange/import_placement.h"

namespace palpa::cli {
namespace {

double parseUnit(const std::string& text) {
  for (const modeling::LengthUnit& unit : modeling::kLengthUnits)
    if (text == unit.name) return unit.mm;
  throw UsageError("--unit: expected " + modeling::lengthUnitsText() + ", found '" + text + "'");
}

modeling::UpAxis parseUp(const std::string& text) {
  const std::string plain = text.starts_with('+') ? text.substr(1) : text;
  const auto& names = modeling::kUpAxisNames;
  const auto found = std::find(names.begin(), names.end(), plain);
  if (found == names.end())
    throw UsageError("--up: expected x, -x, y, -y, z or -z, found '" + text + "'");
  return static_cast<modeling::UpAxis>(found - names.begin());
}

std::string countsText(const modeling::FileBody& body) {
  const int count = body.faces > 0 ? body.faces : body.triangles;
  const std::string kind = body.faces > 0 ? "face" : "triangle";
  return countText(count) + " " + kind + (count == 1 ? "" : "s");
}

}  // namespace

void BodyChoice::declare(CLI::App& options) {
  options
      .add_option("--solid", solid_,
                  "Number or name of the solid in a CAD or mesh file with several; "
                  "'palpa-cli import FILE --list' shows them")
      ->type_name("N|NAME");
  options
      .add_option("--unit", unit_,
                  "Unit of length of a CAD or mesh file: " + modeling::lengthUnitsText() +
                      " (default: the unit that a CAD file states, otherwise mm)")
      ->type_name("UNIT");
}

void BodyChoice::declarePlacement(CLI::App& options) {
  options.add_option("--scale", scale_, "Factor for all lengths of the file (default: 1)")
      ->type_name("NUMBER");
  options
      .add_option("--up", up_,
                  "Axis of the file that becomes +z: x, -x, y, -y, z or -z (default: z)")
      ->type_name("AXIS");
}

void BodyChoice::addTo(modeling::ImportOptions& import) const {
  import.solid = solid_;
  if (!unit_.empty()) import.placement.unit = parseUnit(unit_);
  if (!scale_.empty()) import.placement.scale = parsePositive("--scale", scale_);
  if (!up_.empty()) import.placement.up = parseUp(up_);
}

Json toJson(const modeling::FileBodies& found) {
  Json report{{"unit_mm", found.statesUnit && found.unit > 0 ? Json(found.unit) : Json()},
              {"solids", Json::array()}};
  for (std::size_t i = 0; i < found.bodies.size(); ++i) {
    const modeling::FileBody& body = found.bodies[i];
    Json solid{{"number", i + 1},
               {"name", body.name},
               {"size_mm", toJson(body.size())},
               {"low_mm", toJson(body.low)},
               {"high_mm", toJson(body.high)},
               {"volume_mm3", body.volume}};
    solid[body.faces > 0 ? "faces" : "triangles"] = body.faces > 0 ? body.faces : body.triangles;
    report["solids"].push_back(std::move(solid));
  }
  return report;
}

std::string toText(const modeling::FileBodies& found, const modeling::ImportPlacement& placement) {
  std::string unit = found.unit > 0 ? modeling::lengthUnitText(found.unit) : "several";
  if (!found.statesUnit) unit = "not stated";
  if (placement.unit > 0 || !found.statesUnit)
    unit += ", read as " + modeling::lengthUnitText(placement.unit > 0 ? placement.unit : 1.0);
  std::string text = "unit       " + unit + "\n";
  std::size_t width = 0;
  for (const modeling::FileBody& body : found.bodies) width = std::max(width, body.name.size());
  for (std::size_t i = 0; i < found.bodies.size(); ++i) {
    const modeling::FileBody& body = found.bodies[i];
    text +=
        format("%3zu  %-*s  %s, %s, %.6g mm³\n", i + 1, static_cast<int>(width), body.name.c_str(),
               modeling::sizeText(body.size()).c_str(), countsText(body).c_str(), body.volume);
  }
  for (const modeling::FileBody& body : found.bodies) {
    const std::string warning = modeling::sizeWarning(body.size());
    if (!warning.empty()) text += "note       \"" + body.name + "\": " + warning + "\n";
  }
  return text;
}

}  // namespace palpa::cli

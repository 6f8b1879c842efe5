#include "modeling/exchange/import_placement.h"

#include <cmath>

#include "base/count_text.h"
#include "base/text.h"
#include "modeling/error.h"

namespace palpa::modeling {
namespace {

constexpr double kMaxFactor = 1e9;
constexpr double kMaxCoordinate = 1e7;  // mm, as for control points
constexpr double kSmall = 0.1;          // mm
constexpr double kLarge = 5000.0;       // mm

std::string lengthText(double mm) {
  return mm >= 1000.0 ? countText(mm) : roundedText(mm);
}

void checkFactor(const char* name, double value) {
  if (!std::isfinite(value) || value < 1.0 / kMaxFactor || value > kMaxFactor)
    throw ModelingError(std::string(name) + ": " + numberText(value) +
                        " is out of range; expected 1e-9 to 1e9");
}

}  // namespace

std::string lengthUnitsText() {
  std::string text;
  for (std::size_t i = 0; i < kLengthUnits.size(); ++i)
    text += (i == 0                        ? ""
             : i + 1 < kLengthUnits.size() ? ", "
                                           : " or ") +
            std::string(kLengthUnits[i].name);
  return text;
}

std::string lengthUnitText(double mm) {
  for (const LengthUnit& unit : kLengthUnits)
    if (std::abs(mm - unit.mm) <= 1e-9 * unit.mm) return unit.name;
  return roundedText(mm, 6) + " mm";
}

Eigen::Matrix3d rotationOf(UpAxis up) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  switch (up) {
    case UpAxis::kX:
      rotation << 0, 0, -1, 0, 1, 0, 1, 0, 0;
      break;
    case UpAxis::kMinusX:
      rotation << 0, 0, 1, 0, 1, 0, -1, 0, 0;
      break;
    case UpAxis::kY:
      rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
      break;
    case UpAxis::kMinusY:
      rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
      break;
    case UpAxis::kZ:
      break;
    case UpAxis::kMinusZ:
      rotation << 1, 0, 0, 0, -1, 0, 0, 0, -1;
      break;
  }
  return rotation;
}

double ImportPlacement::factor(double fileUnit) const {
  if (unit == 0.0) return scale;
  if (fileUnit == 0.0)
    throw ModelingError(
        "has parts in different units of length, which were converted; one unit for all would be "
        "wrong: correct the size with a scale");
  return unit / fileUnit * scale;
}

void ImportPlacement::validate() const {
  if (unit != 0.0) checkFactor("unit", unit);
  checkFactor("scale", scale);
}

Body placed(const Body& body, double factor, UpAxis up) {
  if (factor == 1.0 && up == UpAxis::kZ) return body;
  const Eigen::Matrix3d matrix = rotationOf(up);
  const auto move = [&](const std::vector<Eigen::Vector3d>& points) {
    std::vector<Eigen::Vector3d> moved;
    moved.reserve(points.size());
    for (const Eigen::Vector3d& p : points) {
      moved.emplace_back(matrix * (factor * p) + Eigen::Vector3d::Zero());  // no negative zeros
      if (!(moved.back().cwiseAbs().maxCoeff() <= kMaxCoordinate))
        throw ModelingError("reaches " + placeText(moved.back()) + ", farther than " +
                            numberText(kMaxCoordinate) +
                            " mm from the origin; check the unit and the scale");
    }
    return moved;
  };
  if (const auto* solid = std::get_if<Solid>(&body))
    return solid->withControlPoints(move(solid->controlPoints()));
  const MeshBody& mesh = std::get<MeshBody>(body);
  return MeshBody(
      {move(mesh.positions()), mesh.triangles(), mesh.faceOfTriangle(), mesh.faceNames()});
}

std::string sizeWarning(const Eigen::Vector3d& size) {
  const double largest = size.maxCoeff();
  if (largest >= kSmall && largest <= kLarge) return "";
  return "The body is " + std::string(largest < kSmall ? "only " : "") + lengthText(largest) +
         " mm in size: check the unit of the file.";
}

std::string sizeText(const Eigen::Vector3d& size) {
  return lengthText(size.x()) + " × " + lengthText(size.y()) + " × " + lengthText(size.z()) + " mm";
}

}  // namespace palpa::modeling

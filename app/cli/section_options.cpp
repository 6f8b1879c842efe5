#include "app/cli/section_options.h"

#include <Eigen/Core>

#include "app/cli/errors.h"
#include "app/cli/values.h"

namespace palpa::cli {

void SectionOptions::declare(CLI::App& options, bool isRequired) {
  options
      .add_option("--section", plane_,
                  "Cut the body at rest by a plane: x=OFFSET, y=OFFSET or z=OFFSET (mm), -x=OFFSET "
                  "to take away the other side, or nx,ny,nz,OFFSET for the plane n.x = OFFSET. The "
                  "side to which the normal points is taken away")
      ->type_name("PLANE")
      ->required(isRequired);
}

std::optional<modeling::Plane> SectionOptions::plane() const {
  if (plane_.empty()) return std::nullopt;
  const auto refuse = [this] {
    throw UsageError("--section: expected x=OFFSET, -x=OFFSET or nx,ny,nz,OFFSET, found '" +
                     plane_ + "'");
  };
  if (const auto equals = plane_.find('='); equals != std::string::npos) {
    const std::string axis = plane_.substr(0, equals);
    const double sign = axis.starts_with('-') ? -1 : 1;
    const std::string name = axis.substr(axis.starts_with('-') || axis.starts_with('+') ? 1 : 0);
    if (name != "x" && name != "y" && name != "z") refuse();
    return modeling::Plane{sign * Eigen::Vector3d::Unit(name[0] - 'x'),
                           sign * parseNumber("--section", plane_.substr(equals + 1))};
  }
  const auto last = plane_.rfind(',');
  if (last == std::string::npos) refuse();
  const Eigen::Vector3d normal = parseVector("--section", plane_.substr(0, last));
  if (!(normal.norm() > 0)) throw UsageError("--section: the normal is zero");
  return modeling::Plane{normal.normalized(),
                         parseNumber("--section", plane_.substr(last + 1)) / normal.norm()};
}

}  // namespace palpa::cli

#include "app/cli/text.h"

namespace palpa::cli {

Json toJson(const Eigen::Vector3d& vector) {
  return Json::array({vector.x(), vector.y(), vector.z()});
}

}  // namespace palpa::cli

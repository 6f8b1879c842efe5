#include "app/cli/geometry_report.h"

namespace palpa::cli {

Json toJson(const std::vector<modeling::GeometryFinding>& findings) {
  Json list = Json::array();
  for (const modeling::GeometryFinding& finding : findings) {
    list.push_back({{"kind", modeling::faultName(finding.fault)},
                    {"severity", finding.isError ? "error" : "warning"},
                    {"at_mm", {finding.at.x(), finding.at.y(), finding.at.z()}},
                    {"patches", finding.patches},
                    {"triangles", finding.triangles},
                    {"message", finding.message}});
  }
  return list;
}

}  // namespace palpa::cli

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

std::string toText(const std::vector<modeling::GeometryFinding>& findings) {
  std::string text;
  for (const modeling::GeometryFinding& finding : findings) {
    text += (finding.isError ? "error      " : "warning    ") + finding.message + '\n';
  }
  return text;
}

}  // namespace palpa::cli

#include "app/cli/result_file.h"

#include <filesystem>
#include <fstream>

#include "app/cli/errors.h"
#include "app/core/results/state_series.h"
#include "base/atomic_file.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/mesh_writer.h"

namespace palpa::cli {
namespace {

bool isJson(const std::string& path) {
  return std::filesystem::path(path).extension() == ".json";
}

/// A pipe or a device, such as /dev/stdout: cannot be replaced by a file.
bool isStream(const std::filesystem::path& path) {
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  return std::filesystem::is_fifo(status) || std::filesystem::is_character_file(status);
}

bool holdsFields(const modeling::FileFormatInfo& info) {
  return info.format == modeling::FileFormat::kVtp;
}

}  // namespace

std::string resultFileHelp() {
  constexpr auto kHoldsShapeOnly = [](const modeling::FileFormatInfo& info) {
    return isWritableMesh(info) && !holdsFields(info);
  };
  return "Result file: .json (the report), " + modeling::endingsText(holdsFields) +
         " (mesh with fields), " + modeling::endingsText(kHoldsShapeOnly) + " (deformed shape)";
}

void requireResultFileName(const std::string& path) {
  if (!isJson(path)) modeling::requireFormat(path, modeling::isWritableMesh);
}

std::string jsonText(const Json& report) {
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

void writeText(const std::string& text, const std::string& path) {
  if (isStream(path)) {
    std::ofstream stream(path);
    stream << text;
    stream.close();
    if (!stream) throw OutputError("cannot write " + path + "; check that its folder exists");
    return;
  }
  replaceFile(text, path);
}

void writeResult(const app::TouchModel& model, const app::TouchState& state, const Json& report,
                 const std::string& path) {
  if (isJson(path)) {
    writeText(jsonText(report), path);
    return;
  }
  modeling::MeshFile file = app::stateMesh(model, state.field);
  if (!holdsFields(infoOf(modeling::requireFormat(path, modeling::isWritableMesh)))) {
    const std::vector<double>& u = file.pointData.front().values;
    for (std::size_t node = 0; node < file.positions.size(); ++node)
      file.positions[node] += Eigen::Vector3d::Map(&u[3 * node]);
  }
  modeling::writeMesh(file, path);
}

}  // namespace palpa::cli

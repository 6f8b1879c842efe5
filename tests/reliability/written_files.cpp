#include "tests/reliability/written_files.h"

#include <QImage>
#include <algorithm>
#include <fstream>
#include <sstream>

#include "app/core/live/touch_recording_file.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/import.h"
#include "modeling/project/project_file.h"

namespace palpa::reliability {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// True if the last line is complete and all lines have equally many columns.
bool isWholeTable(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const auto columns = std::count(line.begin(), line.end(), ',');
  while (std::getline(lines, line))
    if (std::count(line.begin(), line.end(), ',') != columns) return false;
  return columns > 0 && text.back() == '\n';
}

/// Throws an exception, or returns a fault, unless the file can be read.
std::string faultOf(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".json" || ending == ".bak") {
    const std::string text = contentOf(file);
    if (text.find("\"palpa-recording\"") != std::string::npos)
      app::parseRecording(text, file.string());
    else
      modeling::parseProject(text, file.string());
    return {};
  }
  if (ending == ".csv") return isWholeTable(contentOf(file)) ? "" : "the table is not complete";
  if (ending == ".png")
    return QImage(QString::fromStdString(file.string())).isNull() ? "the picture is broken" : "";
  if (ending == ".vtp")
    return contentOf(file).ends_with("</VTKFile>\n") ? "" : "the mesh is not complete";
  const auto format = modeling::fileFormatOf(file);
  if (format && isImportable(infoOf(*format))) modeling::importBody(file);
  return {};
}

}  // namespace

std::vector<std::string> faultsOf(const fs::path& folder, fs::file_time_type since) {
  std::vector<std::string> faults;
  for (const fs::path& each : {folder, folder / "written"})
    for (const auto& entry : fs::directory_iterator(each)) {
      const fs::path& file = entry.path();
      const std::string name = file.filename().string();
      if (name.find(".palpa") == 0 || name.ends_with(".palpa-new") || name.ends_with(".new"))
        faults.push_back("the hidden file " + name + " stays");
      std::error_code gone;
      if (!entry.is_regular_file() || fs::last_write_time(file, gone) < since || gone) continue;
      try {
        if (const std::string fault = faultOf(file); !fault.empty())
          faults.push_back(name + ": " + fault);
      } catch (const std::exception& error) {
        faults.push_back(name + ": " + error.what());
      }
    }
  return faults;
}

}  // namespace palpa::reliability

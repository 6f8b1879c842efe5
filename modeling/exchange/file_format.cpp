#include "modeling/exchange/file_format.h"

#include <algorithm>
#include <vector>

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

std::vector<std::string> endingsOf(FormatFilter accepts) {
  std::vector<std::string> endings;
  for (const FileFormatInfo& info : kFileFormats)
    for (const char* ending : info.endings)
      if (ending && accepts(info)) endings.emplace_back(ending);
  return endings;
}

}  // namespace

std::optional<FileFormat> fileFormatOf(const std::filesystem::path& path) {
  std::string found = path.extension().string();
  for (char& c : found)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  for (const FileFormatInfo& info : kFileFormats)
    for (const char* ending : info.endings)
      if (ending && found == ending) return info.format;
  return std::nullopt;
}

FileFormat requireFormat(const std::filesystem::path& path, FormatFilter accepts) {
  const auto format = fileFormatOf(path);
  if (!format || !accepts(infoOf(*format)))
    throw ModelingError(path.string() + ": the name must end in " + endingsText(accepts));
  return *format;
}

std::string endingsText(FormatFilter accepts) {
  const std::vector<std::string> endings = endingsOf(accepts);
  std::string text;
  for (std::size_t i = 0; i < endings.size(); ++i)
    text += (i == 0 ? "" : i + 1 < endings.size() ? ", " : " or ") + endings[i];
  return text;
}

std::string endingPatterns(FormatFilter accepts) {
  std::string text;
  for (const std::string& ending : endingsOf(accepts)) text += (text.empty() ? "*" : " *") + ending;
  return text;
}

}  // namespace palpa::modeling

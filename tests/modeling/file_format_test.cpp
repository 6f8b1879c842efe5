#include "modeling/exchange/file_format.h"

#include <gtest/gtest.h>

#include "modeling/error.h"
#include "modeling/project/text_file.h"

namespace palpa::modeling {
namespace {

std::string page(const char* path) {
  return readTextFile(path, 1 << 20);
}

TEST(FileFormats, EndingsInAnyCaseNameTheirFormat) {
  for (const FileFormatInfo& info : kFileFormats)
    for (const char* ending : info.endings) {
      if (!ending) continue;
      std::string name = std::string("/folder.x/A b") + ending;
      EXPECT_EQ(fileFormatOf(name), info.format);
      for (char& c : name) c = static_cast<char>(std::toupper(c));
      EXPECT_EQ(fileFormatOf(name), info.format);
    }
  for (const char* name : {"a", "a.", ".step", "a.step.gz", "step", ""})
    EXPECT_EQ(fileFormatOf(name), std::nullopt) << name;
}

TEST(FileFormats, MessagesListTheEndings) {
  EXPECT_EQ(endingsText(isReadableMesh), ".stl, .obj or .ply");
  EXPECT_EQ(endingPatterns(isWritableMesh), "*.stl *.obj *.ply *.vtp");
  EXPECT_EQ(requireFormat("a.STP", isCad), FileFormat::kStep);
  try {
    requireFormat("a.vtp", isReadableMesh);
    FAIL();
  } catch (const ModelingError& error) {
    EXPECT_STREQ(error.what(), "a.vtp: the name must end in .stl, .obj or .ply");
  }
}

TEST(FileFormats, PagesAndDesktopEntriesNameAll) {
  const std::string exchange = page("../docs/exchange.md");
  const std::string manual = page("../resources/desktop/palpa.1");
  const std::string types = page("../resources/desktop/palpa.xml");
  const auto names = [](const std::string& text, const std::string& what) {
    EXPECT_NE(text.find(what), std::string::npos) << what;
  };
  for (const FileFormatInfo& info : kFileFormats) {
    if (isImportable(info)) names(manual, info.name);
    for (const char* ending : info.endings) {
      if (!ending) continue;
      names(exchange, std::string("`") + ending + "`");
      // Any program may write .json files: the desktop needs the longer ending .palpa.json.
      if (info.kind == FileKind::kProject) names(types, std::string(ending) + "\"");
    }
  }
}

}  // namespace
}  // namespace palpa::modeling

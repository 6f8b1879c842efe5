#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "modeling/error.h"
#include "modeling/project/project_file.h"
#include "tests/fuzz/require.h"

using namespace palpa;

namespace {

std::optional<modeling::Project> parsed(std::string_view text) {
  try {
    return modeling::parseProject(text, "fuzz");
  } catch (const modeling::ModelingError& error) {
    fuzz::require(std::string_view(error.what()).starts_with("fuzz: "), error.what());
    return std::nullopt;
  }
}

}  // namespace

/// Any text is refused with a ModelingError, or it is a project whose text reads back as itself.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto project = parsed({reinterpret_cast<const char*>(data), size});
  if (!project) return 0;
  const std::string text = modeling::toJson(*project);
  const auto again = parsed(text);
  fuzz::require(again.has_value(), "a saved project is refused");
  fuzz::require(modeling::toJson(*again) == text, "a saved project changes when saved again");
  return 0;
}

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "modeling/error.h"
#include "modeling/exchange/cad_import.h"
#include "tests/fuzz/require.h"

using namespace palpa;

/// Any bytes are refused with a ModelingError that names the file, or they are a body with a
/// volume; OpenCASCADE's crashes and endless loops stay in palpa-read-cad, which must be beside
/// this program. The first byte chooses the format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const char* kEndings[] = {".step", ".igs", ".brep"};
  if (size == 0) return 0;
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      ("palpa_fuzz_" + std::to_string(::getpid()) + kEndings[data[0] % 3]);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
  try {
    const modeling::ImportedBody imported = modeling::importCad(file);
    fuzz::require(modeling::volume(imported.body) > 0.0, "a body without volume");
  } catch (const modeling::ModelingError& error) {
    fuzz::require(std::string_view(error.what()).starts_with(file.string() + ": "), error.what());
    fuzz::require(error.kind() != modeling::ModelingError::Kind::kIo, error.what());
  }
  std::filesystem::remove(file);
  return 0;
}

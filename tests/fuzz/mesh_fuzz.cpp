#include <cstdint>
#include <string_view>

#include "modeling/error.h"
#include "modeling/exchange/mesh_reader.h"
#include "tests/fuzz/require.h"

using namespace palpa;

/// Any bytes are refused with a ModelingError, or they are a body that keeps its invariants. The
/// first byte chooses the format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr modeling::FileFormat kFormats[] = {
      modeling::FileFormat::kStl, modeling::FileFormat::kObj, modeling::FileFormat::kPly};
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    const modeling::MeshBody body = modeling::parseMesh(bytes, kFormats[data[0] % 3], "fuzz");
    fuzz::require(modeling::volume(body) > 0.0, "a body without volume");
  } catch (const modeling::ModelingError& error) {
    fuzz::require(std::string_view(error.what()).starts_with("fuzz: "), error.what());
  }
  return 0;
}

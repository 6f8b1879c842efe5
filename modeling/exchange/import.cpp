#include "modeling/exchange/import.h"

#include <algorithm>
#include <cctype>

#include "modeling/error.h"
#include "modeling/exchange/cad_format.h"

namespace palpa::modeling {

ImportedBody importBody(const std::filesystem::path& path, const ImportOptions& options,
                        const Job& job) {
  if (cadFormatOf(path)) return importCad(path, options, job);
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".stl" || ending == ".obj" || ending == ".ply") {
    // MERGE: return {readMeshFile(path, {}, job), {}, 0.0};  (modeling/exchange/mesh_reader.h)
    throw ModelingError(path.string() + ": mesh files cannot be read yet");
  }
  throw ModelingError(path.string() + ": cannot be imported; the name must end in " +
                      kImportFileEndings);
}

}  // namespace palpa::modeling

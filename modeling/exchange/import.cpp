#include "modeling/exchange/import.h"

#include "modeling/error.h"
#include "modeling/exchange/cad_format.h"
#include "modeling/exchange/mesh_reader.h"

namespace palpa::modeling {

ImportedBody importBody(const std::filesystem::path& path, const ImportOptions& options,
                        const Job& job) {
  if (cadFormatOf(path)) return importCad(path, options, job);
  if (!isMeshFile(path))
    throw ModelingError(path.string() + ": cannot be imported; the name must end in " +
                        kImportFileEndings);
  return {readMeshFile(path, {}, job), {}, 0.0};
}

}  // namespace palpa::modeling

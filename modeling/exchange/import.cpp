#include "modeling/exchange/import.h"

#include "modeling/exchange/file_format.h"
#include "modeling/exchange/mesh_reader.h"

namespace palpa::modeling {

ImportedBody importBody(const std::filesystem::path& path, const ImportOptions& options,
                        const Job& job) {
  if (isCad(infoOf(requireFormat(path, isImportable)))) return importCad(path, options, job);
  return {readMeshFile(path, {}, job), {}, 0.0};
}

}  // namespace palpa::modeling

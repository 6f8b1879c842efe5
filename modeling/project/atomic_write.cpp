#include "modeling/project/atomic_write.h"

#include "modeling/error.h"

namespace palpa::modeling {

void writeAtomically(std::string_view text, const std::filesystem::path& path,
                     AtomicWriteOptions options) {
  try {
    palpa::replaceFile(text, path, options);
  } catch (const FileError& error) {
    throw ModelingError(error.what(), ModelingError::Kind::kIo);
  }
}

}  // namespace palpa::modeling

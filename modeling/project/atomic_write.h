#pragma once

#include <filesystem>
#include <string_view>

#include "base/atomic_file.h"

namespace palpa::modeling {

using palpa::AtomicWriteOptions;
using palpa::backupPath;

/// palpa::replaceFile() with the library's errors: throws ModelingError (io).
void writeAtomically(std::string_view text, const std::filesystem::path& path,
                     AtomicWriteOptions options = {});

}  // namespace palpa::modeling

#pragma once

#include <filesystem>
#include <string>

#include "modeling/exchange/cad_import.h"

// Internal to modeling/exchange/.
namespace palpa::modeling {

/// How the rehearsal's program ends, besides crashing: 0, or this plus the kind of the
/// ModelingError whose message it wrote to its standard output.
constexpr int kSandboxFailed = 100;

/// Lets the program palpa-read-cad read the CAD file `path` with content `text` first, and throws
/// when it does not end well there: OpenCASCADE's readers crash, hang or take all memory on some
/// damaged files, and no check of ours can foresee every case. What the program reads is dropped;
/// what succeeded there succeeds here as well, because the work is deterministic.
///
/// The program is looked for beside the running one and in ../libexec/palpa. Stopping the job stops
/// it within 20 ms, whatever it does.
/// @throws ModelingError: the one that reading throws; or one that begins with the file's name when
///         the program crashed, used the processor for longer than `seconds`, is not there, or
///         could not be started. Cancelled.
void readInSandbox(const std::filesystem::path& path, const std::string& text,
                   const ImportOptions& options, double seconds, const Job& job);

}  // namespace palpa::modeling

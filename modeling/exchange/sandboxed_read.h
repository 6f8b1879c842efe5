#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "modeling/error.h"
#include "modeling/exchange/cad_answer.h"
#include "modeling/exchange/cad_import.h"
#include "modeling/exchange/file_bodies.h"

// Reading CAD files in the program palpa-read-cad: OpenCASCADE's readers crash, hang or exhaust the
// memory on some damaged files, and no check in advance can find every case. Internal to
// modeling/exchange/.
//
// The program is searched beside the running program, in ../libexec/palpa and beside the Python
// module that contains this code. Stopping the job stops it within 20 ms in any state. `path` is
// the file's name in messages, `text` its content.
//
// The functions throw the ModelingError of the reading; or ModelingError that begins with the
// file's name if the program crashed, used more than `seconds` of processor time, does not exist,
// or could not be started; Cancelled.
namespace palpa::modeling {

/// The body of importCad().
ImportedBody importInSandbox(const std::filesystem::path& path, const std::string& text,
                             const ImportOptions& options, double seconds, const Job& job);

/// The bodies of importCadBodies(), in one run of the program unless it crashes at one of them or
/// needs longer than `seconds` of processor time for it; then it starts again with the next one.
void importAllInSandbox(const std::filesystem::path& path, const std::string& text,
                        std::size_t count, const ImportOptions& options, const TakeBody& take,
                        double seconds, const Job& job);

using TakeAnswer = std::function<void(CadAnswer answer)>;

/// A run of the program from one solid on. Returns the error if it crashed or took too long.
using RunFrom =
    std::function<std::optional<ModelingError>(std::size_t first, const TakeAnswer& take)>;

/// The repetition in importAllInSandbox(): passes on the bodies of a run, and after a crash at a
/// solid its problem and the bodies of a run from the next one. Throws the error of a crash between
/// solids.
void importBehindCrashes(std::size_t count, const RunFrom& run, const TakeBody& take);

/// The list of listCad().
FileBodies listInSandbox(const std::filesystem::path& path, const std::string& text,
                         ListedSurface surface, double seconds, const Job& job);

}  // namespace palpa::modeling

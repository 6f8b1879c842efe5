#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modeling/exchange/cad_request.h"

// Internal to modeling/exchange/.
namespace palpa::modeling {

/// Exit status of the program palpa-read-cad after an error: this plus the kind of the
/// ModelingError, whose message it writes to its standard output. The status after success is 0.
constexpr int kSandboxFailed = 100;

/// The same if SeveralBodies were found; the list of them goes to standard output.
constexpr int kSandboxSeveral = 90;

/// Reads the CAD file `path` with the content `text` in the program palpa-read-cad. Returns the
/// list of the bodies as text if the request asks for one; otherwise drops the result.
/// OpenCASCADE's readers crash, hang or exhaust the memory on some damaged files, and no check in
/// advance can find every case. Reading is deterministic: a file that the program reads can be read
/// in this process.
///
/// The program is searched beside the running program, in ../libexec/palpa and beside the Python
/// module that contains this code. Stopping the job stops it within 20 ms in any state.
/// Throws the ModelingError of the reading; or ModelingError that begins with the file's name if
/// the program crashed, used more than `seconds` of processor time, does not exist, or could not be
/// started; Cancelled.
std::string readInSandbox(const std::filesystem::path& path, const std::string& text,
                          const CadRequest& request, double seconds, const Job& job);

/// Reads each of `count` solids of the file likewise, all in one run of the program unless it
/// crashes at one of them or needs longer than `seconds` of processor time for it; then it starts
/// again with the next one. Returns the problem of each solid, empty for those that can be read.
std::vector<std::string> readAllInSandbox(const std::filesystem::path& path,
                                          const std::string& text, std::size_t count,
                                          const ImportOptions& options, double seconds,
                                          const Job& job);

}  // namespace palpa::modeling

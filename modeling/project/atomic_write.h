#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace palpa::modeling {

/// Options of writeAtomically().
struct AtomicWriteOptions {
  bool backup = false;  ///< keep the old file as backupPath()
  bool secret = false;  ///< a new file is readable by its owner only
};

/// Replaces the content of a file or creates the file. At every moment, even after a power loss,
/// the name refers to the complete old or the complete new content: the text goes to a hidden file
/// beside the target, which is flushed to the disk and renamed; then the folder is flushed.
///
/// Symbolic links are followed and remain. The new file has the permissions and, if the system
/// allows it, the group of the old file. Hidden files of killed processes beside the target are
/// removed after a day.
///
/// Throws ModelingError (io) if writing fails or the target is read-only, a folder or a device;
/// then the old file is unchanged and no hidden file remains.
void writeAtomically(std::string_view text, const std::filesystem::path& path,
                     AtomicWriteOptions options = {});

/// Path of the backup: `<path>.bak`, with symbolic links resolved; too long names are shortened.
std::filesystem::path backupPath(const std::filesystem::path& path);

}  // namespace palpa::modeling

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace palpa::modeling {

struct AtomicWriteOptions {
  bool backup = false;  ///< keep the old file as backupPath()
  bool secret = false;  ///< a new file is readable by its owner only
};

/// Replaces the content of a file, or makes it: at every moment, power loss included, the name
/// stands for the complete old or the complete new content. The text goes to a hidden file beside
/// the target, is flushed to the disk and renamed; the folder is flushed as well.
///
/// Symbolic links are followed, the link stays. The new file has the permissions and, where the
/// system allows it, the group of the old one. Files that are not writable, folders and devices are
/// refused. What a killed process left beside the target is removed a day later.
///
/// @throws ModelingError (io); the old file is unchanged then and nothing is left behind
void writeAtomically(std::string_view text, const std::filesystem::path& path,
                     AtomicWriteOptions options = {});

/// `<path>.bak`, beside the file a link stands for; a name too long for that is shortened.
std::filesystem::path backupPath(const std::filesystem::path& path);

}  // namespace palpa::modeling

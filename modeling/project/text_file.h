#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace palpa::modeling {

/// The bytes of a file. Throws ModelingError that begins with the path if there is no such file
/// (notFound), if it is a folder or device or cannot be read (io), or if it has more than `most`
/// bytes (tooLarge; before reading).
std::string readTextFile(const std::filesystem::path& path, std::size_t most);

}  // namespace palpa::modeling

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace palpa::modeling {

/// The bytes of a file. @throws ModelingError whose message begins with the path: there is no such
/// file (notFound), it is a folder or device or cannot be read (io), it has more than `most` bytes
/// (tooLarge, before anything is read)
std::string readTextFile(const std::filesystem::path& path, std::size_t most);

}  // namespace palpa::modeling

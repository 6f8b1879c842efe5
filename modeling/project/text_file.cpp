#include "modeling/project/text_file.h"

#include <fstream>
#include <system_error>

#include "modeling/error.h"

namespace palpa::modeling {

std::string readTextFile(const std::filesystem::path& path, std::size_t most) {
  const std::string name = path.string();
  std::error_code code;
  if (!std::filesystem::exists(path, code))
    throw ModelingError(name + ": there is no such file", ModelingError::Kind::kNotFound);
  if (!std::filesystem::is_regular_file(path, code))
    throw ModelingError(name + ": this is not a file", ModelingError::Kind::kIo);
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (!code && size > most)
    throw ModelingError(name + ": the file has " + std::to_string(size) + " bytes; at most " +
                            std::to_string(most) + " are accepted",
                        ModelingError::Kind::kTooLarge);
  std::ifstream file(path, std::ios::binary);
  std::string text(code ? 0 : size, '\0');
  if (!file || code || !file.read(text.data(), static_cast<std::streamsize>(text.size())))
    throw ModelingError(name + ": the file cannot be read", ModelingError::Kind::kIo);
  return text;
}

}  // namespace palpa::modeling

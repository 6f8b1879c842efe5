#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "base/byte_stream.h"
#include "base/job.h"

namespace palpa::app {

class ContentHash;

/// Identity of the content of a model file.
struct ModelKey {
  std::uint64_t high = 0, low = 0;
  bool operator==(const ModelKey&) const = default;
};
/// The first bytes of a file: its kind.
using ModelMagic = std::array<char, 8>;

ModelKey keyOfContent(const ContentHash& hash);

/// Writes a new file that its owner alone can read: a header with a checksum, then what `content`
/// writes. Throws std::system_error, also if the file exists, Cancelled and what `content` throws;
/// then no part of it remains.
void writeModelFile(const std::filesystem::path& path, const ModelMagic& magic, const ModelKey& key,
                    const std::function<void(const ByteSink&)>& content, const Job& job);

/// Lets `content` read a file to its end. False if it cannot be opened. Throws DamagedData if it is
/// not such a file with this key or not as it was written (what `content` has read is void then),
/// and Cancelled.
bool readModelFile(const std::filesystem::path& path, const ModelMagic& magic, const ModelKey& key,
                   const std::function<void(const ByteSource&)>& content, const Job& job);

}  // namespace palpa::app

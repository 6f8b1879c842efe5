#pragma once

#include <cstddef>
#include <string>

#include "modeling/exchange/file_format.h"

namespace palpa::modeling {

inline constexpr std::size_t kMaxCadFile = 256UL << 20;  // bytes
inline constexpr int kMaxCadFaces = 20'000;

/// Checks the text of a CAD file before OpenCASCADE reads it, because its readers crash or loop
/// endlessly on some damaged files. The text must be complete, its sections and statements well
/// formed, its references defined and free of cycles, and its counts possible for its length.
/// Linear time. Throws ModelingError that begins with `source`.
void checkCadText(const std::string& text, FileFormat format, const std::string& source);

// The parts of checkCadText(), one per format.
void checkStepText(const std::string& text, const std::string& source);
void checkIgesText(const std::string& text, const std::string& source);
void checkBrepText(const std::string& text, const std::string& source);

}  // namespace palpa::modeling

#pragma once

#include <cstddef>
#include <string>

#include "modeling/exchange/cad_format.h"

namespace palpa::modeling {

inline constexpr std::size_t kMaxCadFile = 256UL << 20;  // bytes
inline constexpr int kMaxCadFaces = 20'000;

/// Checks the text of a CAD file before OpenCASCADE sees it, whose readers crash or work without
/// end on some damaged files: complete, sections and statements well formed, references defined and
/// without circles, counts that the file can hold. `source` begins the message. Linear time.
/// @throws ModelingError
void checkCadText(const std::string& text, CadFormat format, const std::string& source);

// The parts of checkCadText().
void checkStepText(const std::string& text, const std::string& source);
void checkIgesText(const std::string& text, const std::string& source);
void checkBrepText(const std::string& text, const std::string& source);

}  // namespace palpa::modeling

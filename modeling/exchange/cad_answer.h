#pragma once

#include <cstddef>
#include <string>
#include <variant>

#include "base/phase.h"
#include "modeling/error.h"
#include "modeling/exchange/cad_import.h"
#include "modeling/exchange/file_bodies.h"

// What the program palpa-read-cad answers, one line of JSON for each message. Internal to
// modeling/exchange/.
namespace palpa::modeling {

struct ReadProgress {
  Phase phase = Phase::kRead;
  double fraction = 0.0;
};

/// The program begins with one of several solids. If no SolidEnded follows, it crashed there.
struct SolidBegun {
  std::size_t index = 0;
};

struct SolidEnded {
  std::size_t index = 0;
  BodyOutcome outcome;
};

/// The file has these solids and none was chosen.
struct SolidsToChooseFrom {
  FileBodies found;
};

struct ReadFailed {
  std::string message;
  ModelingError::Kind kind{};
};

using CadAnswer = std::variant<ReadProgress, SolidBegun, SolidEnded, ImportedBody, FileBodies,
                               SolidsToChooseFrom, ReadFailed>;

/// The message with a line feed at its end. Numbers are exact; what is not UTF-8 in names is
/// replaced.
std::string toLine(const CadAnswer& answer);

/// Message of a line of toLine(), with or without its line feed. Throws ModelingError if it is
/// damaged.
CadAnswer answerFrom(const std::string& line);

}  // namespace palpa::modeling

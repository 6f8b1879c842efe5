#include <iostream>
#include <new>

#include "app/cli/errors.h"
#include "app/core/device/device_protocol.h"
#include "app/view/files/errors.h"
#include "base/atomic_file.h"
#include "base/job.h"
#include "bem/base/error.h"
#include "modeling/error.h"
#include "modeling/exchange/file_bodies.h"

namespace palpa::cli {
namespace {

Failure failureOf(const modeling::ModelingError& error) {
  if (error.kind() == modeling::ModelingError::Kind::kTooLarge) {
    return {kCannotBeSolved, "cannot_be_solved", error.what()};
  }
  return {kBadInput, "bad_input", error.what()};
}

Failure failureOf(const bem::SolverError& error) {
  using Kind = bem::SolverError::Kind;
  switch (error.kind()) {
    case Kind::kBadMesh:
    case Kind::kBadMaterial:
    case Kind::kBadCondition:
      return {kBadInput, "bad_input", error.what()};
    case Kind::kNotFixed:
    case Kind::kIncompressible:
    case Kind::kTooLarge:
    case Kind::kSingular:
    case Kind::kNotConverged:
      break;
  }
  return {kCannotBeSolved, "cannot_be_solved", error.what()};
}

}  // namespace

Failure currentFailure() {
  try {
    throw;
  } catch (const Cancelled&) {
    return {kCancelled, "cancelled", "cancelled"};
  } catch (const UsageError& error) {
    return {kUsage, "usage", error.what()};
  } catch (const ReportedFailure& error) {
    return {error.code(), error.code() == kBadInput ? "bad_input" : "cannot_be_solved",
            error.what(), true};
  } catch (const modeling::SeveralBodies& several) {
    return {kBadInput, "bad_input",
            several.what() + std::string("; give --solid N, or import them all with 'palpa-cli "
                                         "import FILE --all -o FOLDER'")};
  } catch (const modeling::ModelingError& error) {
    return failureOf(error);
  } catch (const bem::SolverError& error) {
    return failureOf(error);
  } catch (const view::ViewError& error) {
    return {kBadInput, "bad_input", error.what()};
  } catch (const app::DeviceError& error) {
    return {kBadInput, "bad_input", error.what()};
  } catch (const OutputError& error) {
    return {kBadInput, "bad_input", error.what()};
  } catch (const FileError& error) {
    return {kBadInput, "bad_input", error.what()};
  } catch (const std::bad_alloc&) {
    return {kCannotBeSolved, "cannot_be_solved",
            "out of memory; a larger --edge-length needs less"};
  } catch (const std::exception& error) {
    return {kInternalError, "internal", std::string("internal error: ") + error.what()};
  }
}

void noteFormerName(const std::string& former, const std::string& present) {
  std::cerr << "palpa-cli: " << former << " is the former name of " << present << '\n';
}

}  // namespace palpa::cli

#pragma once

#include <Message_ProgressIndicator.hxx>
#include <Message_SequenceOfPrinters.hxx>
#include <mutex>
#include <string>

#include "base/job.h"

// Locking, progress and errors of OpenCASCADE's file exchange. Internal to modeling/exchange/: only
// .cpp files include this header.
namespace palpa::modeling {

/// Exclusive use of OpenCASCADE's readers and writers by this thread, as long as the object exists:
/// their settings (Interface_Static) and message printers are shared by the whole process.
/// Meanwhile OpenCASCADE writes nothing to standard output.
class OpenCascadeSession {
 public:
  OpenCascadeSession();
  ~OpenCascadeSession();
  OpenCascadeSession(const OpenCascadeSession&) = delete;
  OpenCascadeSession& operator=(const OpenCascadeSession&) = delete;

 private:
  std::unique_lock<std::mutex> lock_;
  Message_SequenceOfPrinters printers_;
};

/// Progress indicator that stops OpenCASCADE's algorithms with the job and reports their progress
/// to it; pass makeProgress(job, phase)->Start() to an algorithm. A stopped algorithm returns early
/// between faces or entities, so callers must then call job.throwIfCancelled().
Handle(Message_ProgressIndicator) makeProgress(const Job& job, Phase phase);

/// Inside a catch block: rethrows an exception of OpenCASCADE or std::bad_alloc as a ModelingError
/// that begins with `where`, and other exceptions (ModelingError, Cancelled, …) unchanged.
[[noreturn]] void rethrowAsModelingError(const std::string& where);

}  // namespace palpa::modeling

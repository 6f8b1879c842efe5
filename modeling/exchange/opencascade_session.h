#pragma once

#include <Message_ProgressIndicator.hxx>
#include <Message_SequenceOfPrinters.hxx>
#include <mutex>
#include <string>

#include "base/job.h"

// What every use of OpenCASCADE's file exchange needs. Internal to modeling/exchange/: only .cpp
// files include this header.
namespace palpa::modeling {

/// While it lives, this thread alone uses OpenCASCADE's readers and writers, whose settings
/// (Interface_Static) and message printers are shared by the whole process; and OpenCASCADE writes
/// nothing to standard output.
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

/// Tells OpenCASCADE when to stop, and the job how far it is. The algorithms look between faces or
/// entities; they return early then, so callers follow up with job.throwIfCancelled().
/// Made by makeProgress(job, phase)->Start().
Handle(Message_ProgressIndicator) makeProgress(const Job& job, const char* phase);

/// Inside a catch block: turns an exception of OpenCASCADE or a lack of memory into a ModelingError
/// that begins with `where`; others (ModelingError, Cancelled, …) pass.
[[noreturn]] void rethrowAsModelingError(const std::string& where);

}  // namespace palpa::modeling

#include "modeling/exchange/opencascade_session.h"

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <new>

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

std::mutex& sessionMutex() {
  static std::mutex mutex;
  return mutex;
}

/// Progress of one OpenCASCADE algorithm, reported in steps of one per cent.
class JobIndicator : public Message_ProgressIndicator {
 public:
  JobIndicator(const Job& job, Phase phase) : job_(job), phase_(phase) {}

  Standard_Boolean UserBreak() override { return job_.stop.stop_requested(); }

  void Show(const Message_ProgressScope&, const Standard_Boolean) override {
    const double fraction = std::min(GetPosition(), 1.0);
    if (fraction < shown_ + 0.01) return;
    shown_ = fraction;
    job_.report(phase_, fraction);
  }

 private:
  Job job_;
  Phase phase_;
  double shown_ = 0.0;
};

}  // namespace

OpenCascadeSession::OpenCascadeSession() : lock_(sessionMutex()) {
  const Handle(Message_Messenger)& messenger = Message::DefaultMessenger();
  printers_ = messenger->Printers();
  messenger->ChangePrinters().Clear();
}

OpenCascadeSession::~OpenCascadeSession() {
  Message::DefaultMessenger()->ChangePrinters() = printers_;
}

Handle(Message_ProgressIndicator) makeProgress(const Job& job, Phase phase) {
  return new JobIndicator(job, phase);
}

void rethrowAsModelingError(const std::string& where) {
  try {
    throw;
  } catch (const Standard_OutOfMemory&) {
    throw ModelingError(where + ": there is not enough memory for this; close other programs",
                        ModelingError::Kind::kTooLarge);
  } catch (const std::bad_alloc&) {
    throw ModelingError(where + ": there is not enough memory for this; close other programs",
                        ModelingError::Kind::kTooLarge);
  } catch (const Standard_Failure& failure) {
    const std::string text = failure.GetMessageString();
    throw ModelingError(where + ": OpenCASCADE failed (" + failure.DynamicType()->Name() +
                        (text.empty() ? "" : ": " + text) +
                        "); export the file again, or in another format");
  }
}

}  // namespace palpa::modeling

// palpa-mpi: computes a model on several processes or machines; see docs/cluster.md.
#include <mpi.h>
#include <petscsys.h>

#include <chrono>
#include <iostream>
#include <new>
#include <optional>
#include <thread>

#include "app/cli/exit_code.h"
#include "app/cli/interrupt.h"
#include "app/core/system/memory.h"
#include "app/mpi/rank_run.h"
#include "base/atomic_file.h"
#include "bem/base/error.h"
#include "modeling/error.h"

namespace palpa::mpi {
namespace {

struct Failure {
  int code;
  std::string message;
};

/// Of the current exception.
Failure currentFailure() {
  try {
    throw;
  } catch (const Cancelled&) {
    return {cli::kCancelled, "cancelled"};
  } catch (const bem::SolverError& error) {
    return {cli::kCannotBeSolved, error.what()};
  } catch (const Error& error) {
    return {cli::kBadInput, error.what()};
  } catch (const std::bad_alloc&) {
    return {cli::kCannotBeSolved,
            "out of memory; start fewer ranks on each machine, or take a longer edge length"};
  } catch (const std::exception& error) {
    return {cli::kInternalError, std::string("internal error: ") + error.what()};
  }
}

/// Ends all ranks, which may wait for this one, with one message.
void endAll(const MpiTeam& team, const Failure& failure) {
  if (team.index() > 0) {
    // Most errors occur on all ranks: then rank 0 speaks and ends them.
    std::this_thread::sleep_for(std::chrono::seconds(1));
    std::cerr << "palpa-mpi: rank " << team.index() << ": " << failure.message << std::endl;
  } else {
    std::cerr << "palpa-mpi: " << failure.message << std::endl;
  }
  MPI_Abort(team.communicator(), failure.code);
}

/// Lines on standard error, at most one per tenth of a phase.
class ProgressLines {
 public:
  void show(Phase phase, double fraction) {
    const int tenths = static_cast<int>(10 * fraction);
    if (phase == phase_ && tenths <= tenths_) return;
    phase_ = phase;
    tenths_ = tenths;
    std::cerr << "palpa-mpi: " << nameOf(phase) << ' ' << 10 * tenths << " %" << std::endl;
  }

 private:
  std::optional<Phase> phase_;
  int tenths_ = 0;
};

int run(const MpiTeam& team, const RankOptions& options) {
  const bool speaks = team.index() == 0 && !options.quiet;
  try {
    const cli::Interrupt interrupt;
    ProgressLines lines;
    Job job{interrupt.token(), {}, options.threads};
    if (speaks) job.progress = [&](Phase phase, double done) { lines.show(phase, done); };
    RankRun run(options, team, job);
    run.run();
    if (speaks) std::cout << (options.json ? run.json().dump(2) + "\n" : run.text()) << std::flush;
    return cli::kDone;
  } catch (...) {
    const Failure failure = currentFailure();
    endAll(team, failure);
    return failure.code;
  }
}

int start(int argc, char** argv) {
  const MpiTeam team(MPI_COMM_WORLD);
  const ParsedOptions parsed = parseOptions(argc, argv);
  if (!parsed.options) {
    if (team.index() == 0) (parsed.code == 0 ? std::cout : std::cerr) << parsed.text << std::flush;
    return parsed.code;
  }
  PetscInitializeNoArguments();
  // Errors become exceptions of this program, signals end it as any other.
  PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr);
  PetscPopSignalHandler();
  const int code = run(team, *parsed.options);
  PetscFinalize();
  return code;
}

}  // namespace
}  // namespace palpa::mpi

int main(int argc, char** argv) {
  palpa::app::reuseFreedMemory();
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  const int code = palpa::mpi::start(argc, argv);
  MPI_Finalize();
  return code;
}

#pragma once

#include <optional>
#include <string>

namespace palpa::mpi {

/// The command line of palpa-mpi.
struct RankOptions {
  std::string project, model;
  double tolerance = 0;              ///< of the blocks, relative; 0: chosen
  std::optional<double> edgeLength;  ///< mm
  int columns = 128;                 ///< nodes at each touch whose columns are stored
  int threads = 1;                   ///< of each rank
  bool json = false, quiet = false;
};

/// What to do: run, or print a text and end with a code.
struct ParsedOptions {
  std::optional<RankOptions> options;
  std::string text;  ///< for standard output if the code is 0, otherwise for standard error
  int code = 0;
};

ParsedOptions parseOptions(int argc, char** argv);

}  // namespace palpa::mpi

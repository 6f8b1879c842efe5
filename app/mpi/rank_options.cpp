#include "app/mpi/rank_options.h"

#include <CLI/CLI.hpp>

#include "app/cli/exit_code.h"

namespace palpa::mpi {

ParsedOptions parseOptions(int argc, char** argv) {
  RankOptions options;
  CLI::App app(
      "Computes the model of a project on several processes or machines and stores it in a file,\n"
      "which the window and 'palpa-cli touch --model' read. Start it with mpirun.");
  app.name("palpa-mpi");
  app.set_help_flag("-h,--help", "Show this help");
  app.set_version_flag("-V,--version", "palpa-mpi " PALPA_VERSION, "Show the version");
  app.add_option("project", options.project, "Project file, of curved triangles")
      ->required()
      ->type_name("PROJECT");
  app.add_option("-o,--output", options.model,
                 "File to write. The window looks for PROJECT with the ending .model")
      ->required()
      ->type_name("MODEL");
  app.add_option("--tolerance", options.tolerance,
                 "Relative error of the compressed operators, 1e-6 to 1e-3 (default 3e-5, with "
                 "thin parts or below 10,000 nodes 3e-6)")
      ->check(CLI::Range(1e-6, 1e-3).description(""))
      ->type_name("NUMBER");
  app.add_option("--edge-length", options.edgeLength,
                 "Length of mesh edges in mm, instead of the project's")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("LENGTH");
  app.add_option("--columns", options.columns,
                 "Nodes at each touch of the project whose columns are stored, so that it answers "
                 "at once (default 128)")
      ->check(CLI::Range(0, 100000).description(""))
      ->type_name("N");
  app.add_option("--threads", options.threads, "Threads of each process (default 1)")
      ->check(CLI::Range(1, 1024).description(""))
      ->type_name("N");
  app.add_flag("--json", options.json, "Write one JSON object instead of text");
  app.add_flag("-q,--quiet", options.quiet, "Write neither text nor progress");
  app.footer("Example:\n  mpirun -n 4 palpa-mpi bracket.json -o bracket.model");
  try {
    app.parse(argc, argv);
    return {options, {}, cli::kDone};
  } catch (const CLI::CallForHelp&) {
    return {std::nullopt, app.help(), cli::kDone};
  } catch (const CLI::CallForVersion& version) {
    return {std::nullopt, std::string(version.what()) + "\n", cli::kDone};
  } catch (const CLI::ParseError& error) {
    return {std::nullopt,
            "palpa-mpi: " + std::string(error.what()) + "; 'palpa-mpi --help' lists the options\n",
            cli::kUsage};
  }
}

}  // namespace palpa::mpi

// Palpa beside others on the same bodies and the same surface meshes: what an edit costs until the
// body can be touched, what touches cost, memory, and errors against solutions that are known.
// Every measurement runs in a separate process, so that memory is measured separately.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "app/core/system/memory.h"
#include "bench/peers/external_program.h"
#include "bench/peers/peer_row.h"

namespace {

using namespace palpa;
using bench::PeerCase;
using bench::PeerRow;

struct Method {
  std::string name;
  std::function<PeerRow(const PeerCase&, double)> measure;
  std::vector<std::string> programs;  ///< it needs
};

const std::vector<Method>& methods() {
  const auto finiteElements = [](bool isQuadratic) {
    return [=](const PeerCase& body, double size) {
      return bench::measureFiniteElements(body, size, isQuadratic);
    };
  };
  static const std::vector<Method> all{
      {"Palpa, triangles", bench::measureTriangles, {}},
      {"Palpa, quadratic", bench::measureQuadratic, {}},
      {"Palpa, splines", bench::measureSplines, {}},
      {"plain dense", bench::measurePlain, {}},
      {"tetrahedra, linear", finiteElements(false), {"tetgen"}},
      {"tetrahedra, quadratic", finiteElements(true), {"tetgen"}},
      {"CalculiX, quadratic", bench::measureCalculix, {"tetgen", "ccx"}}};
  return all;
}

/// Resident memory now or at most so far ("VmRSS", "VmHWM"), bytes.
double residentMemory(const std::string& which) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(which + ":")) return 1024 * std::stod(line.substr(which.size() + 1));
  return 0;
}

/// In the process of one measurement: prints its row for the process that started it.
void measureOne(const Method& method, const PeerCase& body, double size) {
  app::reuseFreedMemory();
  const double before = residentMemory("VmRSS");
  PeerRow row = method.measure(body, size);
  row.values["memory"] = std::max(residentMemory("VmHWM") - before, row.values["program memory"]);
  row.values["size"] = size;
  row.values.erase("program memory");
  for (const auto& [name, value] : row.values) std::printf("%s;%.6g\n", name.c_str(), value);
  std::printf("note;%s\n", row.note.c_str());
}

class PeerBench {
 public:
  PeerBench(std::string references, const std::string& table) : references_(std::move(references)) {
    if (table.empty()) return;
    table_.open(table);
    if (!table_) throw std::runtime_error("cannot write " + table);
    table_ << "body;method;size;round;name;value\n";
  }

  void measure(const std::string& body, const Method& method, double size, int rounds) {
    for (const std::string& program : method.programs)
      if (bench::findProgram(program).empty()) {
        std::printf("%-22s left out: %s is not installed\n", method.name.c_str(), program.c_str());
        return;
      }
    for (int round = 0; round < rounds; ++round) {
      const bench::ExchangeFolder folder;
      std::ostringstream length;
      length << size;
      // This program, even if it was rebuilt meanwhile.
      bench::runProgram({"/proc/self/exe", "--references", references_, "--one", method.name,
                         "--body", body, "--size", length.str()},
                        folder.path(), "row.txt");
      std::ifstream file(folder.path() / "row.txt");
      PeerRow row;
      for (std::string line; std::getline(file, line);) {
        const auto split = line.find(';');
        if (split == std::string::npos) continue;
        const std::string name = line.substr(0, split), value = line.substr(split + 1);
        if (table_.is_open())
          table_ << body << ';' << method.name << ';' << size << ';' << round << ';' << name << ';'
                 << value << std::endl;
        if (name == "note")
          row.note = value;
        else
          row.values[name] = std::stod(value);
      }
      print(method.name, row);
    }
  }

  static void head(const std::string& body) {
    std::printf("\n%s\n%-22s %6s %8s %8s %8s %8s %8s %8s %8s %8s %8s %8s %8s %9s %9s\n",
                body.c_str(), "method", "n", "unknowns", "mesh s", "assem. s", "fact. s", "edit s",
                "touch ms", "move ms", "kept ms", "field ms", "col. ms", "MiB", "err u",
                "err force");
    std::fflush(stdout);
  }

 private:
  static void print(const std::string& method, const PeerRow& row) {
    std::printf("%-22s", method.c_str());
    const auto cell = [&](const char* name, const char* format, double factor) {
      const auto found = row.values.find(name);
      char text[32] = "-";
      if (found != row.values.end())
        std::snprintf(text, sizeof text, format, factor * found->second);
      std::printf(" %8s", text);
    };
    std::printf(" ");
    cell("n", "%.0f", 1);
    cell("unknowns", "%.0f", 1);
    for (const char* name : {"mesh", "assemble", "factorise", "setup"}) cell(name, "%.3f", 1);
    for (const char* name : {"touch", "move", "move_kept", "field", "column"})
      cell(name, "%.3g", 1e3);
    cell("memory", "%.0f", 1.0 / (1 << 20));
    for (const char* name : {"kelvin", "stiffness"}) cell(name, "%.2e", 1);
    std::printf("  %s\n", row.note.c_str());
    std::fflush(stdout);
  }

  std::string references_;
  std::ofstream table_;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"Palpa beside finite elements, CalculiX and a plain dense program."};
  std::string one, references = PALPA_REFERENCES, table, body = "sphere";
  std::vector<double> sizes{4, 3.2, 2}, accuracies{0.03, 0.01, 0.003};
  std::vector<std::string> bodies{"sphere", "cylinder"}, names;
  double size = 4;
  int rounds = 1;
  options.add_option("--bodies", bodies, "sphere, cylinder");
  options.add_option("--methods", names, "names as printed; all when absent");
  options.add_option("--sizes", sizes, "edge lengths of the surface mesh, mm");
  options.add_option("--accuracies", accuracies, "relative errors asked of splines");
  options.add_option("--rounds", rounds, "measurements of each")->check(CLI::Range(1, 20));
  options.add_option("--table", table, "all numbers as lines body;method;size;round;name;value");
  options.add_option("--references", references, "the file fem.json");
  options.add_option("--one", one, "internal: measure this method alone and print its numbers");
  options.add_option("--body", body, "internal");
  options.add_option("--size", size, "internal");
  CLI11_PARSE(options, argc, argv);
  try {
    if (!one.empty()) {
      for (const Method& method : methods())
        if (method.name == one) measureOne(method, bench::makePeerCase(body, references), size);
      return 0;
    }
    PeerBench run(references, table);
    for (const std::string& each : bodies) {
      PeerBench::head(each);
      for (const Method& method : methods()) {
        if (!names.empty() && std::find(names.begin(), names.end(), method.name) == names.end())
          continue;
        for (const double length : method.name.ends_with("splines") ? accuracies : sizes)
          run.measure(each, method, length, rounds);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "palpa-peer-bench: %s\n", error.what());
    return 1;
  }
  return 0;
}

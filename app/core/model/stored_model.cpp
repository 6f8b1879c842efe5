#include "app/core/model/stored_model.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "app/core/model/content_hash.h"
#include "app/core/model/model_file.h"
#include "base/atomic_file.h"
#include "base/byte_reader.h"
#include "bem/compressed/make_problem.h"

namespace palpa::app {
namespace {

namespace fs = std::filesystem;

constexpr ModelMagic kMagic{'P', 'A', 'L', 'P', 'A', 'S', 'L', 'V'};
/// Changes with everything that makes older files wrong: the bytes of compressed problems, or the
/// equations.
constexpr ModelKey kVersion{0, 7};
/// Nodes on another machine may differ by so much of the size of the body, which is rounding.
constexpr double kRounding = 1e-10;

/// Thrown within readModelFile() for a file that belongs to another problem.
struct Other {};

/// Everything but the nodes that the equations depend on.
ModelKey keyOfRest(const bem::Discretisation& discretisation, const bem::ProblemInputs& inputs) {
  ContentHash hash;
  const bem::BoundaryMesh& mesh = discretisation.mesh();
  hash.addList(mesh.triangles);
  hash.addList(mesh.smoothingGroups);
  hash.addList(mesh.tags);
  hash.addList(inputs.conditions);
  const auto& [youngsModulus, poissonRatio] = inputs.material;  // all fields
  hash.addValue(youngsModulus);
  hash.addValue(poissonRatio);
  hash.addValue(inputs.assembly.tolerance);
  return keyOfContent(hash);
}

void writeIdentity(const bem::Discretisation& discretisation, const bem::ProblemInputs& inputs,
                   const ByteSink& sink) {
  writeValue(sink, keyOfRest(discretisation, inputs));
  writeList(sink, discretisation.mesh().nodes);
}

/// Throws Other.
void checkIdentity(const bem::Discretisation& discretisation, const bem::ProblemInputs& inputs,
                   const ByteSource& source) {
  if (bem::effectivePrecision(discretisation, bem::Precision::kCompressed) !=
      bem::Precision::kCompressed)
    throw Other{};
  if (readValue<ModelKey>(source) != keyOfRest(discretisation, inputs)) throw Other{};
  const auto stored = readList<Eigen::Vector3d>(source);
  const std::vector<Eigen::Vector3d>& nodes = discretisation.mesh().nodes;
  if (stored.size() != nodes.size()) throw Other{};
  double size = 0, difference = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    size = std::max(size, (nodes[k] - nodes.front()).norm());
    difference = std::max(difference, (nodes[k] - stored[k]).norm());
  }
  if (!(difference <= kRounding * size)) throw Other{};
}

bem::ProblemInputs compressed(bem::ProblemInputs inputs) {
  inputs.precision = bem::Precision::kCompressed;
  return inputs;
}

}  // namespace

fs::path storedModelBeside(const fs::path& project) {
  return fs::path(project).replace_extension(".model");
}

void writeStoredModel(const fs::path& path, const bem::Discretisation& discretisation,
                      const bem::ProblemInputs& inputs, const bem::ReferenceProblem& problem,
                      const Job& job) {
  AtomicFile file(path);
  try {
    writeModelFile(
        file.freshPath(), kMagic, kVersion,
        [&](const ByteSink& sink) {
          writeIdentity(discretisation, inputs, sink);
          problem.write(sink);
        },
        job);
  } catch (const std::system_error& error) {
    throw FileError(path.string() + ": cannot be written: " + error.code().message());
  }
  file.commit();
}

StoredModel readStoredModel(const fs::path& path, const bem::Discretisation& discretisation,
                            const bem::ProblemInputs& inputs, const Job& job) {
  StoredModel model;
  try {
    const bool isThere = readModelFile(
        path, kMagic, kVersion,
        [&](const ByteSource& source) {
          checkIdentity(discretisation, inputs, source);
          model.problem = bem::readReferenceProblem(discretisation, compressed(inputs), source);
        },
        job);
    model.fit = isThere ? StoredModelFit::kFits : StoredModelFit::kMissing;
  } catch (const DamagedData&) {
    model = {StoredModelFit::kDamaged, nullptr};
  } catch (const Other&) {
    model = {StoredModelFit::kOther, nullptr};
  }
  return model;
}

}  // namespace palpa::app

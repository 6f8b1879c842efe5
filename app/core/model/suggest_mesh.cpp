#include "app/core/model/suggest_mesh.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "app/core/model/geometry_error.h"
#include "app/core/model/model_builder.h"
#include "app/core/model/model_memory.h"
#include "base/text.h"

namespace palpa::app {
namespace {

constexpr int kMaxMeshes = 20;
constexpr double kStep = 1.2;      // between two sizes that are tried
constexpr double kSmallest = 0.2;  // of the present size
constexpr double kLargest = 1e4;   // of the present size
constexpr double kMaxEdge = 0.3;   // of the body's diagonal: longer edges lose any shape
constexpr double kCoarsest = 0.1;  // accuracy, the limit of project files

enum class Outcome { kFits, kTooLarge, kNoBody, kFails };

struct Attempt {
  Outcome outcome = Outcome::kFails;
  double excess = 1;  // of memory, if it is too large
};

Attempt attempt(const modeling::Project& project, const BuildOptions& options, const Job& job) {
  try {
    ModelBuilder builder(project, options, job);
    builder.prepare();
    return {Outcome::kFits};
  } catch (const ModelTooLarge& error) {
    return {Outcome::kTooLarge, error.excess()};
  } catch (const GeometryError&) {
    return {Outcome::kNoBody};
  } catch (const modeling::ModelingError& error) {
    using Kind = modeling::ModelingError::Kind;
    return {error.kind() == Kind::kTooLarge ? Outcome::kTooLarge : Outcome::kFails};
  } catch (const Error&) {
    return {};
  }
}

/// The number that sets the size of a project's elements.
class ElementSize {
 public:
  explicit ElementSize(modeling::Project& project)
      : mesh_(project.mesh), usesSplines_(app::usesSplines(project)) {
    const auto [low, high] = modeling::boundingBox(project.body);
    longest_ = kMaxEdge * (high - low).norm();
  }

  double value() const {
    if (!usesSplines_) return mesh_.edgeLength;
    return mesh_.elementLength.value_or(mesh_.accuracy);
  }
  /// Rounds to two digits; false if the value is out of range.
  bool set(double value) {
    const std::string text = roundedText(value, 2);
    std::from_chars(text.data(), text.data() + text.size(), value);
    const bool isLength = !usesSplines_ || mesh_.elementLength;
    if (!(value > 0) || value > (isLength ? longest_ : kCoarsest)) return false;
    if (!usesSplines_)
      mesh_.edgeLength = value;
    else if (mesh_.elementLength)
      mesh_.elementLength = value;
    else
      mesh_.accuracy = value;
    return true;
  }

 private:
  modeling::MeshSettings& mesh_;
  bool usesSplines_;
  double longest_ = 0;
};

}  // namespace

std::optional<modeling::MeshSettings> suggestMesh(const modeling::Project& project,
                                                  const BuildOptions& options, const Job& job) {
  const Job quiet{job.stop, {}, job.threads};
  modeling::Project tried = project;
  ElementSize size(tried);
  const double present = size.value();
  int meshes = 0;
  // Tries one size after the other, each `step` times the one before.
  const auto search = [&](double first, double step) -> std::optional<modeling::MeshSettings> {
    for (double factor = first; factor >= kSmallest && factor <= kLargest; factor *= step) {
      job.throwIfCancelled();
      if (!size.set(factor * present) || ++meshes > kMaxMeshes) return std::nullopt;
      const Attempt now = attempt(tried, options, quiet);
      if (now.outcome == Outcome::kFits) return tried.mesh;
      if (now.outcome == Outcome::kFails) return std::nullopt;
      if (now.outcome == Outcome::kNoBody) continue;
      if (step < 1) return std::nullopt;  // smaller ones need even more memory
      // The memory falls at most with the fourth power of the size.
      factor *= std::max(1.0, std::pow(now.excess, 0.25) / step);
    }
    return std::nullopt;
  };
  const Attempt asIs = attempt(tried, options, quiet);
  if (asIs.outcome == Outcome::kTooLarge)
    return search(std::max(1.05, std::pow(asIs.excess, 0.25)), kStep);
  // A solid of patches is mended by its control points.
  if (asIs.outcome != Outcome::kNoBody || std::holds_alternative<modeling::Solid>(project.body))
    return std::nullopt;
  if (auto finer = search(1 / kStep, 1 / kStep)) return finer;
  return search(kStep, kStep);
}

}  // namespace palpa::app

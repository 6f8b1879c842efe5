#include "app/core/results/comparison.h"

#include <algorithm>
#include <cmath>

#include "app/core/results/error_estimate.h"
#include "base/text.h"
#include "bem/base/error.h"
#include "modeling/body/body.h"

namespace palpa::app {
namespace {

constexpr double kGramsPerKg = 1e3, kCubicMetresPerMm3 = 1e-9;

double largestOf(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, value);
  return largest;
}

/// A name as a field of a table.
std::string quotedField(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

/// Collects rows of two states.
class Rows {
 public:
  Rows(const VariantState& a, const VariantState& b) : states_{&a, &b} {}

  using Value = std::optional<double>;
  void add(ComparisonRow::Part part, const std::string& name, ComparedFigure figure, Value a,
           Value b, bool hasError) {
    ComparisonRow row{part, name, figure, {a, b}, {}};
    for (std::size_t k = 0; k < 2; ++k)
      if (hasError && row.values[k] && states_[k]->state.errorEstimate)
        row.errors[k] = *states_[k]->state.errorEstimate;
    rows_.push_back(std::move(row));
  }
  std::vector<ComparisonRow> take() { return std::move(rows_); }

 private:
  std::array<const VariantState*, 2> states_;
  std::vector<ComparisonRow> rows_;
};

void addContacts(const TouchState& a, const TouchState& b, Rows& rows) {
  using enum ComparedFigure;
  for (std::size_t k = 0; k < std::min(a.contacts.size(), b.contacts.size()); ++k) {
    const TouchState::Contact &ofA = a.contacts[k], &ofB = b.contacts[k];
    const auto add = [&](ComparedFigure figure, double valueA, double valueB) {
      rows.add(ComparisonRow::Part::kContact, ofA.name, figure, valueA, valueB, true);
    };
    add(kForce, ofA.force.norm(), ofB.force.norm());
    add(kNormalForce, ofA.normalForce(), ofB.normalForce());
    add(kStiffness, ofA.stiffness, ofB.stiffness);
    add(kMoved, ofA.displacement.norm(), ofB.displacement.norm());
  }
}

void addSupports(const TouchState& a, const TouchState& b, Rows& rows) {
  const auto find = [](const TouchState& state, const std::string& name) {
    const auto found = std::find_if(state.supports.begin(), state.supports.end(),
                                    [&](const auto& each) { return each.name == name; });
    return found == state.supports.end() ? std::nullopt
                                         : std::optional(found->resultant.force.norm());
  };
  for (const auto& support : a.supports)
    rows.add(ComparisonRow::Part::kSupport, support.name, ComparedFigure::kReaction,
             support.resultant.force.norm(), find(b, support.name), true);
  for (const auto& support : b.supports)
    if (!find(a, support.name))
      rows.add(ComparisonRow::Part::kSupport, support.name, ComparedFigure::kReaction, std::nullopt,
               support.resultant.force.norm(), true);
}

}  // namespace

VariantPlayer::VariantPlayer(Variant variant, const modeling::DisplaySettings& settings,
                             const Job& job)
    : VariantPlayer(variant, std::make_shared<const DrawnBody>(variant.model, settings, job)) {}

VariantPlayer::VariantPlayer(Variant variant, std::shared_ptr<const DrawnBody> drawn)
    : variant_(std::move(variant)),
      drawn_(std::move(drawn)),
      player_(*variant_.model),
      volume_(modeling::volume(variant_.model->body())) {}

std::vector<modeling::Touch> VariantPlayer::touchesOf(std::span<const LiveContact> contacts,
                                                      const Job& job) {
  if (!surface_)
    surface_ = variant_.model->setup().discretisation->makeContactSurface(
        variant_.model->problem()->dofs());
  try {
    return app::touchesOf(contacts, *surface_, player_, job);
  } catch (const bem::SolverError& error) {
    throw bem::SolverError(error.kind(), variant_.name + ": " + error.what());
  }
}

VariantState VariantPlayer::play(std::span<const modeling::Touch> touches, const Job& job) {
  VariantState result;
  try {
    result.state = player_.play(touches, 0, job);
  } catch (const bem::SolverError& error) {
    throw bem::SolverError(error.kind(), variant_.name + ": " + error.what());
  }
  result.largestDisplacement =
      largestOf(drawn_->values(SurfaceQuantity::kDisplacement, result.state.field));
  result.largestStress = largestOf(drawn_->values(SurfaceQuantity::kVonMises, result.state.field));
  result.volume = volume_;
  if (variant_.densityKgPerM3)
    result.mass = kGramsPerKg * kCubicMetresPerMm3 * *variant_.densityKgPerM3 * volume_;
  return result;
}

std::optional<double> ComparisonRow::difference() const {
  if (!values[0] || !values[1]) return std::nullopt;
  return *values[1] - *values[0];
}

std::optional<double> ComparisonRow::relativeDifference() const {
  const auto by = difference();
  if (!by || *values[0] == 0) return std::nullopt;
  return *by / std::abs(*values[0]);
}

bool ComparisonRow::isWithinErrors() const {
  const auto by = difference();
  if (!by || !errors[0] || !errors[1]) return false;
  return std::abs(*by) <= *errors[0] * std::abs(*values[0]) + *errors[1] * std::abs(*values[1]);
}

std::vector<ComparisonRow> Comparison::rows() const {
  using enum ComparedFigure;
  const auto& [a, b] = states;
  Rows rows(a, b);
  addContacts(a.state, b.state, rows);
  addSupports(a.state, b.state, rows);
  const auto add = [&](ComparedFigure figure, std::optional<double> ofA, std::optional<double> ofB,
                       bool hasError = false) {
    rows.add(ComparisonRow::Part::kBody, "", figure, ofA, ofB, hasError);
  };
  add(kMaxDisplacement, a.largestDisplacement, b.largestDisplacement, true);
  add(kMaxStress, a.largestStress, b.largestStress);
  add(kEnergy, a.state.energy, b.state.energy);
  add(kVolume, a.volume, b.volume);
  if (a.mass || b.mass) add(kMass, a.mass, b.mass);
  return rows.take();
}

Comparison compareVariants(VariantPlayer& a, VariantPlayer& b,
                           std::span<const modeling::Touch> touches, const Job& job) {
  const TouchModel &modelA = *a.variant().model, &modelB = *b.variant().model;
  Comparison result;
  result.carried = carryTouches(touches, modelA, modelB);
  std::vector<modeling::Touch> onB;
  for (std::size_t k = 0; k < touches.size(); ++k) {
    onB.push_back(result.carried[k].touch);
    result.touches.push_back(touches[k]);
    result.touches.back().radius = onB.back().radius;
  }
  result.states = {a.play(result.touches, job), b.play(onB, job)};
  return result;
}

void estimateErrors(const VariantPlayer& a, const VariantPlayer& b, Comparison& comparison,
                    const Job& job) {
  const std::array players{&a, &b};
  for (std::size_t k = 0; k < 2; ++k) {
    TouchState& state = comparison.states[k].state;
    addErrors(*players[k]->variant().model, state, job);
  }
}

const char* nameOf(ComparisonRow::Part part) {
  using enum ComparisonRow::Part;
  return part == kContact ? "contact" : part == kSupport ? "support" : "body";
}

void writeComparison(std::span<const ComparisonRow> rows, std::ostream& out) {
  out << "part,name,figure,a,b,difference,relative_difference,relative_error_a,relative_error_b\n";
  const auto number = [&out](const std::optional<double>& value) {
    out << ',';
    if (value) out << numberText(*value);
  };
  for (const ComparisonRow& row : rows) {
    out << nameOf(row.part) << ',' << quotedField(row.name) << ',' << infoOf(row.figure).name;
    for (const auto& value : row.values) number(value);
    number(row.difference());
    number(row.relativeDifference());
    for (const auto& error : row.errors) number(error);
    out << '\n';
  }
}

}  // namespace palpa::app

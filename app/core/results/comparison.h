#pragma once

#include <array>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "app/core/results/carried_touch.h"
#include "app/core/results/drawn_body.h"
#include "app/core/results/touch.h"

// Comparison of two variants of a project under the same touches.
namespace palpa::app {

/// A variant of a project: its model, and the density, which models do not store.
struct Variant {
  std::string name;
  std::shared_ptr<const TouchModel> model;
  std::optional<double> densityKgPerM3{};
};

/// Figures of a variant under touches.
struct VariantState {
  TouchState state;
  double largestDisplacement = 0;  ///< mm
  double largestStress = 0;        ///< MPa, von Mises, on the surface
  double volume = 0;               ///< mm^3
  std::optional<double> mass;      ///< g; none without a density
};

/// Plays touches on a variant and describes its state; keeps what later plays need. One thread at a
/// time.
class VariantPlayer {
 public:
  /// `settings`: of drawn(). Throws Cancelled.
  explicit VariantPlayer(Variant variant, const modeling::DisplaySettings& settings = {1, 1},
                         const Job& job = {});

  /// `drawn`: of the variant's model.
  VariantPlayer(Variant variant, std::shared_ptr<const DrawnBody> drawn);

  const Variant& variant() const { return variant_; }
  const std::shared_ptr<const DrawnBody>& drawn() const { return drawn_; }

  /// The touches of contacts of the touch loop on this variant.
  std::vector<modeling::Touch> touchesOf(std::span<const LiveContact> contacts, const Job& job);
  /// Throws SolverError as TouchPlayer::play(), with a message that begins with the variant's name;
  /// Cancelled.
  VariantState play(std::span<const modeling::Touch> touches, const Job& job);

 private:
  Variant variant_;
  std::shared_ptr<const DrawnBody> drawn_;
  TouchPlayer player_;
  std::unique_ptr<bem::ContactSurface> surface_;  // for touchesOf()
  double volume_;
};

/// Figure of a row of a comparison.
enum class ComparedFigure {
  // of a contact
  kForce,
  kNormalForce,  ///< TouchState::Contact::normalForce()
  kStiffness,
  kMoved,  ///< displacement of the middle of the contact, from all causes
  // of a support
  kReaction,
  // of the body
  kMaxDisplacement,
  kMaxStress,  ///< von Mises, on the surface
  kEnergy,     ///< strain energy
  kVolume,
  kMass,
};

/// Names of a figure.
struct ComparedFigureInfo {
  ComparedFigure figure;
  const char* name;   ///< in tables and reports, ends in the unit
  const char* label;  ///< for users, to be translated
  const char* unit;   ///< of its numbers
};

inline constexpr std::array kComparedFigures{
    ComparedFigureInfo{ComparedFigure::kForce, "force_N", "Force", "N"},
    ComparedFigureInfo{ComparedFigure::kNormalForce, "normal_force_N", "Force into the body", "N"},
    ComparedFigureInfo{ComparedFigure::kStiffness, "stiffness_N_per_mm", "Stiffness", "N/mm"},
    ComparedFigureInfo{ComparedFigure::kMoved, "moved_mm", "Moved", "mm"},
    ComparedFigureInfo{ComparedFigure::kReaction, "reaction_N", "Reaction", "N"},
    ComparedFigureInfo{ComparedFigure::kMaxDisplacement, "largest_displacement_mm",
                       "Largest displacement", "mm"},
    ComparedFigureInfo{ComparedFigure::kMaxStress, "largest_von_mises_MPa",
                       "Largest von Mises stress", "MPa"},
    ComparedFigureInfo{ComparedFigure::kEnergy, "energy_mJ", "Strain energy", "mJ"},
    ComparedFigureInfo{ComparedFigure::kVolume, "volume_mm3", "Volume", "mm³"},
    ComparedFigureInfo{ComparedFigure::kMass, "mass_g", "Mass", "g"},
};

constexpr const ComparedFigureInfo& infoOf(ComparedFigure figure) {
  return kComparedFigures[static_cast<std::size_t>(figure)];
}

static_assert(kComparedFigures.size() == 1 + static_cast<std::size_t>(ComparedFigure::kMass));
static_assert([] {
  for (const ComparedFigureInfo& info : kComparedFigures)
    if (infoOf(info.figure).name != info.name) return false;
  return true;
}());

/// One figure of both variants, A and B.
struct ComparisonRow {
  /// Owner of the figure: a touch, a support, or the whole body.
  enum class Part { kContact, kSupport, kBody };
  Part part = Part::kBody;
  std::string name;  ///< of the touch or support
  ComparedFigure figure = ComparedFigure::kForce;
  std::array<std::optional<double>, 2> values;  ///< none: that variant has no such figure
  /// Estimated relative errors of the values; none: not estimated, or no estimate exists.
  std::array<std::optional<double>, 2> errors;

  /// B - A.
  std::optional<double> difference() const;
  /// difference() over |A|; none if A is 0.
  std::optional<double> relativeDifference() const;
  /// True if the difference is smaller than the sum of both estimated errors.
  bool isWithinErrors() const;
};

/// Two variants, A and B, under the same touches.
struct Comparison {
  std::vector<modeling::Touch> touches;  ///< on A, with their radii
  std::vector<CarriedTouch> carried;     ///< on B
  std::array<VariantState, 2> states;

  /// Rows of all contacts, the supports and the body. Supports are paired by their names.
  std::vector<ComparisonRow> rows() const;
};

/// Plays touches of A on A, and on B where carryTouches() puts them. Throws as
/// VariantPlayer::play().
Comparison compareVariants(VariantPlayer& a, VariantPlayer& b,
                           std::span<const modeling::Touch> touches, const Job& job);

/// Fills in the estimated errors of both states. Costs about as much as assembling both models.
/// Throws Cancelled.
void estimateErrors(const VariantPlayer& a, const VariantPlayer& b, Comparison& comparison,
                    const Job& job);

/// Writes rows as comma-separated values: a line of names, then a line for every row, numbers with
/// all their digits, empty where there is none.
void writeComparison(std::span<const ComparisonRow> rows, std::ostream& out);

/// Name of a part in tables and reports.
const char* nameOf(ComparisonRow::Part part);

}  // namespace palpa::app

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bem/compressed/compressed_order.h"
#include "bem/element/element_rows.h"

namespace palpa::bem {

/// Integrals of Kelvin's kernels at points over the functions of a cluster: parts of the rows of
/// [-H G]. All references must outlive the object; const use from several threads is safe.
class ExactRows {
 public:
  ExactRows(const ElementSurface& surface, const ElementQuadrature& quadrature,
            const KelvinConstants& constants, const CompressedOrder& order);

  struct Scratch {
    std::unique_ptr<ElementQuadrature::Workspace> quadrature;
    std::vector<double> T, U;
    std::vector<int> places;
  };
  Scratch makeScratch() const;

  /// Elements with functions of a cluster, ascending.
  std::span<const int> elements(int cluster) const { return elements_[cluster]; }

  /// The three rows of a point at the columns of a cluster, row by row; without the elements
  /// `leftOut` (ascending).
  void compute(const CollocationPlace& point, int cluster, std::span<const int> leftOut,
               Scratch& scratch, float* rows) const;

 private:
  const ElementSurface& surface_;
  const ElementQuadrature& quadrature_;
  const KelvinConstants constants_;
  const CompressedOrder& order_;
  KelvinSumLoops loops_;
  std::vector<std::vector<int>> elements_;
};

}  // namespace palpa::bem

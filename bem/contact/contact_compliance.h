#pragma once

#include <memory>
#include <vector>

#include "bem/contact/contact_surface.h"
#include "bem/problem/greens_columns.h"

namespace palpa::bem {

/// Masks on a body and the compliance D = Ψ^T Xi Φ between them, kept up to date while masks come,
/// go and slide, from whatever columns of Xi are there. Masks keep their place in the list.
///
/// Not thread-safe. After the first few calls nothing is allocated as long as masks do not grow.
///
/// A mask that is placed elsewhere before the columns of the new place are there stays where it is
/// until they come: what slides ahead of the columns does not lose its force.
class ContactCompliance {
 public:
  /// `base`: the field without contacts. All three must outlive the set.
  ContactCompliance(const ContactSurface& surface, const GreensColumns& columns,
                    const BoundaryField& base);

  int size() const { return static_cast<int>(masks_.size()); }
  void resize(int count);
  /// Those behind move forward.
  void remove(int first, int count);

  /// Puts a mask at a surface point. False, and the mask is empty, when a support holds the place.
  bool place(int index, const SurfacePoint& point, double radius);
  void clear(int index);
  bool isPlaced(int index) const { return masks_[index].isPlaced; }
  /// Were the columns there that the mask needs, at the last update()? Only then was it included.
  bool isReady(int index) const { return masks_[index].isReady; }
  /// Displacement coefficients whose columns place() has missed since the last forgetMissing();
  /// some appear twice.
  const std::vector<int>& missing() const { return missing_; }
  void forgetMissing() { missing_.clear(); }
  const ContactMask& mask(int index) const { return masks_[index].mask; }

  /// Brings the compliance up to date. Masks that are empty or not ready have zero blocks.
  void update();
  /// 3 x 3 per mask, mm/N, symmetrised.
  const Eigen::MatrixXd& compliance() const { return compliance_; }
  /// Displacements of the masks without any contact force, mm.
  const Eigen::VectorXd& freeDisplacements() const { return free_; }
  /// Largest |D_ab - D_ba^T| over |D_aa| at the last update.
  double reciprocityDefect() const { return defect_; }

 private:
  struct Entry {
    ContactMask mask;
    bool isPlaced = false;
    bool isReady = false;
    bool isCurrent = false;  // its blocks of raw_ belong to the mask
    bool isZero = true;      // its blocks of raw_ are zero
  };
  /// Adds those of a mask's nodes to missing_ that have no columns; are there any?
  bool misses(const ContactMask& mask);
  /// The union of the measure nodes of some masks, as rows.
  void collectRows(bool onlyChanged);
  /// Xi Φ of a mask in these rows.
  void respond(int index);
  void measureBase(int index);
  void symmetrise();
  /// Ψ^T of a mask applied to the response.
  Eigen::Matrix3d measure(int index) const;

  const ContactSurface& surface_;
  const GreensColumns& columns_;
  const BoundaryField& base_;
  std::unique_ptr<ContactSurface::Workspace> workspace_;
  std::vector<Entry> masks_;
  ContactMask spare_;
  std::vector<int> missing_;
  Eigen::MatrixXd raw_, compliance_;
  Eigen::VectorXd free_;
  double defect_ = 0;
  bool isStale_ = true;             // compliance_ does not belong to raw_
  std::vector<int> rows_;           // displacement coefficients
  std::vector<unsigned> rowStamp_;  // per displacement coefficient
  std::vector<int> rowOfNode_;
  unsigned stamp_ = 0;
  Eigen::Matrix<float, Eigen::Dynamic, 3>
      response_;  // more rows than needed, so that it seldom grows
};

}  // namespace palpa::bem

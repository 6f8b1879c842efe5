#pragma once

#include <memory>
#include <vector>

#include "bem/contact/contact_surface.h"
#include "bem/problem/greens_columns.h"

namespace palpa::bem {

/// Masks on a body and the compliance D = Ψ^T Xi Φ between them. The compliance is updated from the
/// available columns of Xi, or responses of whole masks, while masks are added, removed and slide.
/// Masks keep their index in the list.
///
/// Not thread-safe. After the first few calls no memory is allocated as long as masks do not grow.
///
/// A mask placed at a point whose columns are not yet available stays at its previous point until
/// they are: a contact that slides faster than the columns arrive keeps its force.
class ContactCompliance {
 public:
  /// `base`: the field without contacts. All three arguments must outlive this object.
  ContactCompliance(const ContactSurface& surface, const GreensColumns& columns,
                    const BoundaryField& base);

  int size() const { return static_cast<int>(masks_.size()); }
  void resize(int count);
  /// Removes `count` masks; the masks after them move forward.
  void remove(int first, int count);

  /// Places a mask of `radius` (mm) at a surface point. Returns false and leaves the mask empty if
  /// a support fixes the place.
  bool place(int index, const SurfacePoint& point, double radius);
  void clear(int index);
  bool isPlaced(int index) const { return masks_[index].isPlaced; }
  /// True if all Green's columns of the mask, or its response, were available at the last update().
  /// Only such masks are included in the compliance.
  bool isReady(int index) const { return masks_[index].isReady; }
  /// isReady() of the next update().
  bool isAvailable(int index) const { return isAvailable(masks_[index].mask); }
  /// Displacement coefficients whose columns were not available to place() since the last
  /// forgetMissing(), not even rough ones, of masks without a response; some appear twice.
  const std::vector<int>& missing() const { return missing_; }
  void forgetMissing() { missing_.clear(); }
  const ContactMask& mask(int index) const { return masks_[index].mask; }

  /// Updates the compliance. Masks that are empty or not ready have zero blocks.
  void update();
  /// Compliance, 3 x 3 per mask, mm/N, symmetrised.
  const Eigen::MatrixXd& compliance() const { return compliance_; }
  /// Displacements of the masks without contact forces, 3 per mask, mm.
  const Eigen::VectorXd& freeDisplacements() const { return free_; }
  /// Error indicator: the largest |D_ab - D_ba^T| over |D_aa| at the last update.
  double reciprocityDefect() const { return defect_; }

 private:
  struct Entry {
    ContactMask mask;
    bool isPlaced = false;
    bool isReady = false;
    bool isCurrent = false;  // its blocks of raw_ are computed for the present mask
    bool isZero = true;      // its blocks of raw_ are zero
    bool isRough = false;    // they come from a rough response or rough columns
  };
  const MaskResponses::Response* responseTo(const ContactMask& mask) const {
    return columns_.responses().find(mask.point, mask.radius);
  }
  bool isAvailable(const ContactMask& mask) const {
    return columns_.hasAllRough(mask.nodes) || responseTo(mask);
  }
  /// True if columns or a response are available that are not rough.
  bool isExact(const ContactMask& mask) const {
    const MaskResponses::Response* response = responseTo(mask);
    return (response && !response->isRough) || columns_.hasAll(mask.nodes);
  }
  /// Adds the nodes of a mask without columns to missing_ and returns true, unless the mask is
  /// available.
  bool misses(const ContactMask& mask);
  /// Collects the union of the measured nodes of some masks in rows_.
  void collectRows(bool onlyChanged);
  /// Computes Xi Φ of a mask in these rows. True if it is rough.
  bool respond(int index);
  void sumColumns(const ContactMask& mask);
  void measureBase(int index);
  void symmetrise();
  /// Applies Ψ^T of a mask to the response.
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
  bool isStale_ = true;             // compliance_ is older than raw_
  std::vector<int> rows_;           // displacement coefficients
  std::vector<unsigned> rowStamp_;  // per displacement coefficient
  std::vector<int> rowOfNode_;
  unsigned stamp_ = 0;
  Eigen::Matrix<float, Eigen::Dynamic, 3> response_;  // with spare rows, so that it seldom grows
};

}  // namespace palpa::bem

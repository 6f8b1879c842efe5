#pragma once

#include <QString>
#include <functional>
#include <vector>

#include "modeling/shapes/primitive.h"

// Shapes of the dialog for new solids: titles, lengths, example profiles.
namespace palpa::gui {

/// Length of a shape.
struct PrimitiveLength {
  QString label;        ///< label in the form, with &
  std::string inWords;  ///< name in messages of modeling: "the radius"
  bool mayBeZero = false;
  std::function<double&(modeling::Primitive&)> in;
};

struct PrimitiveKind {
  QString title;
  QString icon;                   ///< name in resources/icons
  modeling::Primitive primitive;  ///< with its initial sizes
  std::vector<PrimitiveLength> lengths;
  /// Example shapes with a profile; empty for shapes without profiles.
  struct Profile {
    QString title;
    decltype(modeling::Primitive::shape) shape;
  };
  std::vector<Profile> profiles;
};

const std::vector<PrimitiveKind>& primitiveKinds();
/// By the place in this list.
inline const PrimitiveKind& primitiveKind(int index) {
  return primitiveKinds()[static_cast<std::size_t>(index)];
}

}  // namespace palpa::gui

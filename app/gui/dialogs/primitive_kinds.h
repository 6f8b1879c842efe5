#pragma once

#include <QString>
#include <functional>
#include <vector>

#include "modeling/shapes/primitive.h"

// The shapes as the dialog for new solids offers them: names, numbers, example profiles.
namespace palpa::gui {

/// A length of a shape.
struct PrimitiveLength {
  QString label;        ///< with & for the form
  std::string inWords;  ///< as messages of modeling name it: "the radius"
  bool mayBeZero = false;
  std::function<double&(modeling::Primitive&)> in;
};

struct PrimitiveKind {
  QString title;
  QString icon;                   ///< name in resources/icons
  modeling::Primitive primitive;  ///< with the sizes to begin with
  std::vector<PrimitiveLength> lengths;
  /// Shapes that begin with a profile, for those made from one; empty for the others.
  struct Profile {
    QString title;
    decltype(modeling::Primitive::shape) shape;
  };
  std::vector<Profile> profiles;
};

const std::vector<PrimitiveKind>& primitiveKinds();

/// Replaces the profile of a revolve, extrude or loft shape by the one in a file.
/// @throws ModelingError
void readProfileInto(modeling::Primitive& primitive, const QString& file);

}  // namespace palpa::gui

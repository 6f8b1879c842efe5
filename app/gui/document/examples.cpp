#include "app/gui/document/examples.h"

#include <QFile>
#include <QObject>

#include "modeling/error.h"
#include "modeling/project/project_file.h"

namespace palpa::gui {

std::vector<Example> examples() {
  const auto tr = [](const char* text) { return QObject::tr(text); };
  return {{"sphere", tr("Sphere"), tr("A ball on a fixed base")},
          {"box", tr("Box"), tr("A block with flat faces and sharp edges")},
          {"cylinder", tr("Cylinder"), tr("A round bar, fixed at its bottom")},
          {"fingertip-pad", tr("Fingertip pad"), tr("A soft pad as on a robot's finger")},
          {"gripper-finger", tr("Gripper finger"), tr("A finger that bends when it is pressed")},
          {"torus-seal", tr("Seal"), tr("A rubber ring, pressed from above")},
          {"sole-cushion", tr("Sole cushion"), tr("The cushion of a shoe, from an outline")},
          {"liver-phantom", tr("Liver phantom"), tr("A very soft organ to palpate")}};
}

std::vector<Example> designExamples() {
  const auto tr = [](const char* text) { return QObject::tr(text); };
  return {{"design/two-stiffness-pad", tr("Pad with two stiffnesses"),
           tr("A pad that is to feel softer on one side than on the other")},
          {"design/one-newton-finger", tr("Finger that bends at 1 N"),
           tr("A finger that is to give way to a force of 1 N")},
          {"design/seal-bead", tr("Bead of a seal"),
           tr("A bead that is to press with a given force when it is compressed")}};
}

modeling::Project readExample(const QString& name) {
  QFile file(":/projects/" + name + ".json");
  if (!file.open(QIODevice::ReadOnly))
    throw modeling::ModelingError("there is no example named \"" + name.toStdString() + "\"",
                                  modeling::ModelingError::Kind::kNotFound);
  return modeling::parseProject(file.readAll().toStdString(), name.toStdString());
}

}  // namespace palpa::gui

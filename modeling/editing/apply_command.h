#pragma once

#include "modeling/editing/command.h"

// One function per kind of command. It checks the fields of the command and throws ModelingError;
// apply() checks the resulting project.
namespace palpa::modeling {

// edit_points.cpp
Edited applyTo(const MovePoints& command, const Project& project);
Edited applyTo(const ScalePoints& command, const Project& project);
Edited applyTo(const RotatePoints& command, const Project& project);
Edited applyTo(const AlignPoints& command, const Project& project);

// edit_knots.cpp
Edited applyTo(const InsertKnot& command, const Project& project);
Edited applyTo(const RemoveKnot& command, const Project& project);
Edited applyTo(const ElevateDegree& command, const Project& project);
Edited applyTo(const SetEdge& command, const Project& project);

// edit_body.cpp
Edited applyTo(const TransformSolid& command, const Project& project);

// edit_primitive.cpp
Edited applyTo(const MakePrimitive& command, const Project& project);

// edit_conditions.cpp
Edited applyTo(const AddSupport& command, const Project& project);
Edited applyTo(const SetSupport& command, const Project& project);
Edited applyTo(const RemoveSupport& command, const Project& project);
Edited applyTo(const AddLoad& command, const Project& project);
Edited applyTo(const SetLoad& command, const Project& project);
Edited applyTo(const RemoveLoad& command, const Project& project);
Edited applyTo(const AddTouch& command, const Project& project);
Edited applyTo(const SetTouch& command, const Project& project);
Edited applyTo(const RemoveTouch& command, const Project& project);
Edited applyTo(const AddMeasurement& command, const Project& project);
Edited applyTo(const SetMeasurement& command, const Project& project);
Edited applyTo(const RemoveMeasurement& command, const Project& project);
Edited applyTo(const SetMaterial& command, const Project& project);
Edited applyTo(const SetMesh& command, const Project& project);
Edited applyTo(const SetDesign& command, const Project& project);
Edited applyTo(const RenameProject& command, const Project& project);
Edited applyTo(const RenamePatch& command, const Project& project);

// take_overlap.cpp
Edited applyTo(const TakeOverlap& command, const Project& project);

/// The project with another body and without a primitive. `deviation` in mm, see Edited.
Edited withBody(const Project& project, Body body, double deviation = 0.0);

}  // namespace palpa::modeling

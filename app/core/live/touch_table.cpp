#include "app/core/live/touch_table.h"

#include "app/core/model/contact_kind.h"
#include "base/text.h"

namespace palpa::app {

const char* nameOf(TouchSnapshot::Status status) {
  using Status = TouchSnapshot::Status;
  switch (status) {
    case Status::kWaiting:
      return "waiting";
    case Status::kFixed:
      return "held";
    case Status::kOpen:
      return "open";
    case Status::kGrabbed:
      return "holding";
    case Status::kSticking:
      return "sticking";
    case Status::kSlipping:
      return "slipping";
  }
  return "";
}

TouchTable::TouchTable(std::ostream& out) : out_(out) {
  out_ << "time_s,contact,kind,status,at_x_mm,at_y_mm,at_z_mm,force_x_N,force_y_N,force_z_N,"
          "force_N,displacement_x_mm,displacement_y_mm,displacement_z_mm,stiffness_N_per_mm,"
          "converged,deflection_x_mm,deflection_y_mm,deflection_z_mm\n";
}

void TouchTable::add(const TouchSnapshot& snapshot, std::uint64_t step) {
  const auto write = [this](const Eigen::Vector3d& vector) {
    for (int k = 0; k < 3; ++k) out_ << ',' << numberText(vector[k]);
  };
  for (const TouchSnapshot::Contact& contact : snapshot.touched()) {
    out_ << numberText(1e-3 * static_cast<double>(step)) << ',' << contact.id << ','
         << infoOf(contact.tool.kind).name << ',' << nameOf(contact.status);
    write(contact.point.position);
    write(contact.force);
    out_ << ',' << numberText(contact.force.norm());
    write(contact.displacement);
    out_ << ',' << numberText(contact.stiffness) << ',' << (snapshot.isConverged ? "yes" : "no");
    write(contact.deflection);
    out_ << '\n';
  }
}

}  // namespace palpa::app

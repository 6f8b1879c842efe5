#include "app/core/results/section_file.h"

#include <array>

#include "app/core/results/stress_numbers.h"
#include "base/atomic_file.h"
#include "base/text.h"

namespace palpa::app {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// xx, yy, zz, xy, yz, zx.
std::array<double, 6> components(const Matrix3d& tensor) {
  return {tensor(0, 0), tensor(1, 1), tensor(2, 2), tensor(0, 1), tensor(1, 2), tensor(2, 0)};
}

}  // namespace

std::string sectionTable(const BodySection& section,
                         const std::vector<bem::InteriorState>& states) {
  const bem::Material& material = section.body().model().setup().material;
  std::string table =
      "x_mm,y_mm,z_mm,displacement_x_mm,displacement_y_mm,displacement_z_mm,"
      "stress_xx_MPa,stress_yy_MPa,stress_zz_MPa,stress_xy_MPa,stress_yz_MPa,stress_zx_MPa,"
      "strain_xx,strain_yy,strain_zz,strain_xy,strain_yz,strain_zx,"
      "principal_1_MPa,principal_2_MPa,principal_3_MPa,mean_stress_MPa,von_Mises_MPa\n";
  for (std::size_t k = 0; k < states.size(); ++k) {
    bool isFirst = true;
    const auto add = [&](const auto& numbers) {
      for (const double number : numbers) {
        if (!isFirst) table += ',';
        isFirst = false;
        table += numberText(number);
      }
    };
    const StressNumbers numbers = stressNumbers(states[k].stress);
    add(section.mesh().positions[k]);
    add(states[k].displacement);
    add(components(states[k].stress));
    add(components(bem::strainOf(states[k].stress, material)));
    add(numbers.principal);
    add(std::array{numbers.mean, numbers.vonMises});
    table += '\n';
  }
  return table;
}

modeling::MeshFile sectionMesh(const BodySection& section,
                               const std::vector<bem::InteriorState>& states) {
  const bem::Material& material = section.body().model().setup().material;
  modeling::MeshData displacement{"displacement_mm", 3, {}}, stress{"stress_MPa", 9, {}},
      strain{"strain", 9, {}}, principal{"principal_stress_MPa", 3, {}},
      mean{"mean_stress_MPa", 1, {}}, vonMises{"von_Mises_MPa", 1, {}};
  for (const bem::InteriorState& state : states) {
    const StressNumbers numbers = stressNumbers(state.stress);
    const Matrix3d strains = bem::strainOf(state.stress, material);
    const auto add = [](modeling::MeshData& data, const auto& values) {
      for (Eigen::Index k = 0; k < values.size(); ++k) data.values.push_back(values.data()[k]);
    };
    add(displacement, state.displacement);
    add(stress, state.stress);
    add(strain, strains);
    add(principal, numbers.principal);
    mean.values.push_back(numbers.mean);
    vonMises.values.push_back(numbers.vonMises);
  }
  return {section.mesh().positions,
          section.mesh().triangles,
          {displacement, stress, strain, principal, mean, vonMises},
          {}};
}

void writeSection(const BodySection& section, const std::vector<bem::InteriorState>& states,
                  const std::filesystem::path& path) {
  if (path.extension() == ".csv")
    replaceFile(sectionTable(section, states), path);
  else
    modeling::writeMesh(sectionMesh(section, states), path);
}

}  // namespace palpa::app

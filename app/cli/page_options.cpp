#include "app/cli/page_options.h"

#include "app/cli/errors.h"
#include "app/cli/text.h"
#include "app/cli/values.h"
#include "app/core/page/touch_page_file.h"

namespace palpa::cli {

void PageOptions::declare(CLI::App& options) {
  const app::TouchPageSettings standard;
  options
      .add_option("--places", places_,
                  format("Of a page: touch places whose displacements it holds, %d to %d "
                         "(default %d)",
                         app::TouchPageSettings::kMinPlaces, app::TouchPageSettings::kMaxPlaces,
                         standard.places))
      ->type_name("N");
  options
      .add_option("--page-size", size_,
                  format("Of a page: most size of the file in MB, %g to %g (default %g)",
                         app::TouchPageSettings::kMinSize, app::TouchPageSettings::kMaxSize,
                         standard.megabytes))
      ->type_name("MB");
  options
      .add_option("--radius", radius_,
                  "Of a page: radius of its touches in mm (default: as palpa-cli touch, or more if "
                  "the mesh is too coarse for that); a smaller one "
                  "makes the mesh finer")
      ->type_name("LENGTH");
}

app::TouchPageSettings PageOptions::settings() const {
  using Limits = app::TouchPageSettings;
  Limits settings;
  if (!places_.empty()) {
    settings.places = parseCount("--places", places_, Limits::kMaxPlaces);
    if (settings.places < Limits::kMinPlaces)
      throw UsageError(format("--places: expected %d to %d, found '%s'", Limits::kMinPlaces,
                              Limits::kMaxPlaces, places_.c_str()));
  }
  if (!size_.empty()) {
    settings.megabytes = parsePositive("--page-size", size_);
    if (settings.megabytes < Limits::kMinSize || settings.megabytes > Limits::kMaxSize)
      throw UsageError(format("--page-size: expected %g to %g MB, found '%s'", Limits::kMinSize,
                              Limits::kMaxSize, size_.c_str()));
  }
  if (!radius_.empty()) settings.radius = parsePositive("--radius", radius_);
  return settings;
}

Json toJson(const app::TouchPage& page, double bytes) {
  Json json{{"bytes", bytes},
            {"places", page.places.size()},
            {"vertices", page.positions.size()},
            {"radius_mm", page.radius},
            {"errors", app::toJson(page.errors)}};
  if (!page.notice.empty()) json["notice"] = page.notice;
  return json;
}

std::string toText(const app::TouchPage& page, double bytes) {
  std::string text =
      format("page       %.1f MB, %zu touch places of radius %.4g mm, %zu vertices\n", bytes / 1e6,
             page.places.size(), page.radius, page.positions.size());
  const app::TouchPage::Errors& errors = page.errors;
  text += format(
      "errors     of the force of a touch: by the model (estimate) %.2g %%, at the worst "
      "place %.2g %%; by the page %.2g %%, at the worst place %.2g %%;\n"
      "           of displacements at other touches, within two radii %.2g %% of the touch's, "
      "within four %.2g %%, beyond %.2g %%;\n"
      "           of drawn displacements %.2g %% (worst %.2g %%)\n",
      100 * errors.typicalModel, 100 * errors.model, 100 * errors.typicalForce, 100 * errors.force,
      100 * errors.coupling[0], 100 * errors.coupling[1], 100 * errors.coupling[2],
      100 * errors.typicalField, 100 * errors.field);
  if (!page.notice.empty()) text += "note       " + page.notice + "\n";
  return text;
}

}  // namespace palpa::cli

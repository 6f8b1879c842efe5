#pragma once

#include "modeling/exchange/profile_fit.h"

// Profiles from drawings, for `palpa-cli new` and for the profile editor.
namespace palpa::modeling {

/// A drawing with its paths joined to loops.
struct ProfileDrawing {
  std::string source;
  std::vector<DrawnPath> paths;  ///< as joinedPaths() sorts them
  std::vector<std::string> layers;
  std::map<std::string, int> skipped;
  std::string unit;
  double tolerance = 0.0;  ///< mm, of joining, and the usual one for the fit
};

/// Reads a drawing, keeps the paths of one layer (all for an empty name) and joins them. Without a
/// tolerance (0) it is 1e-4 of the extent of the drawing, at least 1e-6 mm. Throws ModelingError
/// that begins with the file's name if nothing is left; Cancelled.
ProfileDrawing readProfileDrawing(const std::filesystem::path& path, const std::string& layer = {},
                                  double tolerance = 0.0, const Job& job = {});

/// "closed, 40 × 30 mm, layer "cut", line 12: LWPOLYLINE", for lists of paths.
std::string describePath(const DrawnPath& path);

/// Number (from 0) of the path to use: the only one, or the only closed one if `mustBeClosed`.
/// Throws ModelingError that lists the paths, numbered from 1, if there is a choice.
std::size_t onlyPath(const ProfileDrawing& drawing, bool mustBeClosed);

/// fitProfile() with messages that name the file and the path.
FittedProfile fitPath(const ProfileDrawing& drawing, std::size_t path, const FitOptions& options,
                      const Job& job = {});

/// SVG file with a profile: one path in mm, y upwards from the lower edge of the page, x from its
/// left edge; parts below or beside the page are drawn, too. Curves of degree 4 and 5 are
/// approximated by cubic ones within 1e-6 of their size, all others are exact.
std::string toSvg(const ProfileCurve& curve);
/// Writes it to a file. Throws ModelingError (io).
void writeProfileSvg(const ProfileCurve& curve, const std::filesystem::path& path);

}  // namespace palpa::modeling

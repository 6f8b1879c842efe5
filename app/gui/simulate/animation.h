#pragma once

#include <QString>
#include <filesystem>

#include "base/job.h"

namespace palpa::gui {

constexpr int kAnimationRate = 30;  // pictures per second

/// Program that makes a video of pictures; empty if none is installed.
QString videoProgram();

/// Name of a picture of an animation, 0, 1, …: a video is made of pictures with these names.
std::filesystem::path pictureName(std::size_t number);

/// Makes a video of the pictures in a folder. Throws Cancelled, FileError, or std::runtime_error
/// with the program's output; then, and if it is cancelled, an existing file is unchanged.
void makeVideo(const std::filesystem::path& folder, const std::filesystem::path& file,
               const Job& job);

/// Moves the pictures 0 … count - 1 into another folder of the same disk, where they replace
/// pictures of the same names. Throws FileError.
void movePictures(const std::filesystem::path& from, const std::filesystem::path& to,
                  std::size_t count);

}  // namespace palpa::gui

#pragma once

#include <gtest/gtest.h>

#include <TopoDS_Shape.hxx>
#include <filesystem>
#include <string>

#include "modeling/error.h"

namespace palpa::modeling::tests {

/// Temporary folder, removed with its contents by the destructor.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path file(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Writes a shape as another program would: without Palpa's writer.
void writeForeign(const TopoDS_Shape& shape, const std::filesystem::path& path,
                  const std::string& stepUnit = "MM");

std::string readText(const std::filesystem::path& path);
void writeText(const std::filesystem::path& path, const std::string& text);

/// Message of the ModelingError that `work` throws; "accepted" if it throws none.
template <class Work>
std::string errorOf(const Work& work) {
  try {
    work();
  } catch (const ModelingError& error) {
    return error.what();
  }
  return "accepted";
}

testing::AssertionResult says(const std::string& message, const std::string& words);

double volumeOf(const TopoDS_Shape& shape);
double areaOf(const TopoDS_Shape& shape);

}  // namespace palpa::modeling::tests

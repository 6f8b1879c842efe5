#include "study_series.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace palpa::bem::test {

double StudySeries::order(std::size_t i) const {
  if (i == 0) return kNotMeasured;
  return std::log(steps[i - 1].error / steps[i].error) /
         std::log(steps[i - 1].size / steps[i].size);
}

double StudySeries::fittedOrder(std::size_t i) const {
  if (i == 0) return kNotMeasured;
  double meanSize = 0, meanError = 0;
  for (std::size_t k = 0; k <= i; ++k) {
    meanSize += std::log(steps[k].size) / static_cast<double>(i + 1);
    meanError += std::log(steps[k].error) / static_cast<double>(i + 1);
  }
  double both = 0, square = 0;
  for (std::size_t k = 0; k <= i; ++k) {
    const double size = std::log(steps[k].size) - meanSize;
    both += size * (std::log(steps[k].error) - meanError);
    square += size * size;
  }
  return both / square;
}

void report(const StudySeries& series) {
  const char* path = std::getenv("PALPA_STUDY_CSV");
  std::FILE* file = path ? std::fopen(path, "a") : nullptr;
  if (path && !file) throw std::runtime_error(std::string("cannot write ") + path);
  if (file) std::fseek(file, 0, SEEK_END);
  if (file && std::ftell(file) == 0)
    std::fprintf(file,
                 "body;engine;n;elements;h_mm;error;best;at_load;reaction;order;fit;assemble_s;"
                 "factorise_s\n");
  std::printf("%s, %s\n", series.body.c_str(), series.engine.c_str());
  for (std::size_t i = 0; i < series.steps.size(); ++i) {
    const StudyStep& s = series.steps[i];
    std::printf(
        "  n %5d  h %6.2f mm  error %.2e  best %.2e  reaction %.1e  order %5.2f  fit %5.2f  "
        "%.3f + %.3f s\n",
        s.coefficients, s.size, s.error, s.best, s.reaction, series.order(i), series.fittedOrder(i),
        s.assemble, s.factorise);
    if (file)
      std::fprintf(file, "%s;%s;%d;%d;%.4f;%.4e;%.4e;%.4e;%.4e;%.3f;%.3f;%.4f;%.4f\n",
                   series.body.c_str(), series.engine.c_str(), s.coefficients, s.elements, s.size,
                   s.error, s.best, s.atLoad, s.reaction, series.order(i), series.fittedOrder(i),
                   s.assemble, s.factorise);
  }
  if (file) std::fclose(file);
}

}  // namespace palpa::bem::test

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::string input;  // that runs

void run(std::string bytes) {
  input = std::move(bytes);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

/// Keeps the input that ended the program.
extern "C" void keepInput(int number) {
  const int file = ::open("finding", O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file >= 0 && ::write(file, input.data(), input.size()) >= 0) ::close(file);
  std::signal(number, SIG_DFL);
  std::raise(number);
}

/// One of the files with some bytes changed, digits and pieces exchanged, doubled, cut out, or with
/// a piece of another file.
std::string changed(const std::vector<std::string>& files, std::mt19937_64& random) {
  std::string bytes = files[random() % files.size()];
  for (auto changes = 1 + random() % 6; changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = random() % bytes.size();
    const std::size_t length = std::min<std::size_t>(1 + random() % 40, bytes.size() - at);
    switch (random() % 7) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(random() % bytes.size(), bytes.substr(at, length));
        break;
      case 3: {
        const std::string& other = files[random() % files.size()];
        if (!other.empty()) bytes.insert(at, other, random() % other.size(), length);
        break;
      }
      case 4:
        bytes.resize(std::max(at, bytes.size() / 2));
        break;
      default: {
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        if (digit == std::string::npos) break;
        constexpr const char* kNumbers[] = {"0",     "1",   "-1", "7", "99999999999",
                                            "1e308", "nan", ".",  "9"};
        bytes.replace(digit, 1, kNumbers[random() % std::size(kNumbers)]);
      }
    }
  }
  return bytes;
}

}  // namespace

/// corpus-folder [seconds [seed]]: runs the target once per file of the folder, and then on changed
/// ones for some seconds. The input of a crash is left in the file `finding`.
int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    std::fprintf(stderr, "usage: %s corpus-folder [seconds [seed]]\n", argv[0]);
    return 2;
  }
  for (const int number : {SIGABRT, SIGSEGV, SIGFPE}) std::signal(number, keepInput);
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) paths.push_back(entry);
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> files;
  for (const std::filesystem::path& path : paths) {
    std::ifstream file(path, std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    std::printf("%s (%zu bytes)\n", path.filename().c_str(), files.back().size());
    std::fflush(stdout);
    run(files.back());
  }
  if (files.empty()) return 1;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 0;
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  std::mt19937_64 random(seed);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  long count = 0;
  for (; std::chrono::steady_clock::now() < end; ++count) run(changed(files, random));
  std::printf("%s: changed inputs %ld, seconds %g, seed %llu, failures 0\n",
              std::filesystem::path(argv[0]).filename().c_str(), count, seconds,
              static_cast<unsigned long long>(seed));
  return 0;
}

// What libFuzzer calls, with the name of the function in PLEXWAY_LIBFUZZER; or what stands in for
// it: replay NAME FILE... runs the function of that name once on each file given, folders with all
// they hold.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz_entry.hpp"

#ifdef PLEXWAY_LIBFUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto fuzzer = fuzz::fuzzers().at(PLEXWAY_LIBFUZZER);
  return fuzzer(data, size);
}
#else
namespace {

using Fuzzer = int (*)(const std::uint8_t*, std::size_t);

bool replay(Fuzzer fuzzer, const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) {
    std::cerr << "cannot read " << file.string() << '\n';
    return false;
  }
  // A copy of its own size, so that a sanitizer sees a read past its end.
  const std::vector<std::uint8_t> exact(bytes.begin(), bytes.end());
  fuzzer(exact.data(), exact.size());
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const auto known = fuzz::fuzzers().find(argc > 1 ? argv[1] : "");
  if (known == fuzz::fuzzers().end()) {
    std::cerr << "no such fuzzer\n";
    return 1;
  }
  std::size_t files = 0;
  bool good = true;
  for (int i = 2; i < argc; ++i) {
    if (std::filesystem::is_directory(argv[i])) {
      for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i])) {
        if (!entry.is_regular_file()) continue;
        good = replay(known->second, entry.path()) && good;
        ++files;
      }
    } else {
      good = replay(known->second, argv[i]) && good;
      ++files;
    }
  }
  std::cout << files << " files replayed\n";
  return good && files != 0 ? 0 : 1;
}
#endif

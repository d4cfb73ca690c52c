#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

/// PLEXWAY_FUZZER(name)(data, size) { ... } in fuzz_<name>.cpp: what libFuzzer calls where that is
/// there, otherwise one of the functions that the replay of all corpora knows by their names.
#ifdef PLEXWAY_LIBFUZZER
#define PLEXWAY_FUZZER(name) extern "C" int LLVMFuzzerTestOneInput
#else
#define PLEXWAY_FUZZER(name)                                                                  \
  static int fuzz_##name(const std::uint8_t*, std::size_t);                                   \
  static const bool fuzz_##name##_known = fuzz::fuzzers().emplace(#name, fuzz_##name).second; \
  static int fuzz_##name

namespace fuzz {

inline std::map<std::string, int (*)(const std::uint8_t*, std::size_t)>& fuzzers() {
  static std::map<std::string, int (*)(const std::uint8_t*, std::size_t)> known;
  return known;
}

}  // namespace fuzz
#endif

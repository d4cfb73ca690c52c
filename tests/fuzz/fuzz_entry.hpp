#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

/// PLEXWAY_FUZZER(name)(data, size) { ... }: a function that the replay of all corpora, and a
/// fuzzer of that name, know by it.
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

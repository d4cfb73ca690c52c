#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "complexes/jittered.hpp"
#include "mpi/running.hpp"

namespace mpi_testing {

/// Hills of more triangles than a single piece has.
inline std::string hills() {
  auto s = plexway::testing::jittered(130, 7);
  std::ostringstream text;
  text << "OFF\n" << s.positions.size() + 1 << ' ' << s.faces.size() << " 0\n";
  for (const auto& p : s.positions)
    text << p[0] << ' ' << p[1] << ' ' << 0.1 * std::sin(9 * p[0]) * std::cos(7 * p[1]) << '\n';
  text << "2 2 2\n";  // a vertex of no triangle
  for (const auto& f : s.faces) text << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
  return text.str();
}

/// The arrays of a .vtu that the tool wrote.
struct Vtu {
  explicit Vtu(const fs::path& file) : bytes(content(file)) {
    begin = bytes.find("<AppendedData encoding=\"raw\">");
    REQUIRE(begin != std::string::npos);
    begin = bytes.find('_', begin) + 1;
  }
  template <class Value>
  [[nodiscard]] std::vector<Value> array(const std::string& name) const {
    const std::size_t tag = bytes.find("Name=\"" + name + "\"");
    if (tag == std::string::npos) return {};
    const std::size_t at = bytes.find("offset=\"", tag) + 8;
    const char* const block = bytes.data() + begin + std::stoull(bytes.substr(at, 20));
    std::uint64_t size = 0;
    std::memcpy(&size, block, sizeof size);
    std::vector<Value> values(size / sizeof(Value));
    if (size > 0) std::memcpy(values.data(), block + sizeof size, size);
    return values;
  }
  std::string bytes;
  std::size_t begin;
};

}  // namespace mpi_testing

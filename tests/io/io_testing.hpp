#pragma once

#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>

#include "folder.hpp"
#include "io/readers.hpp"
#include "io/solid/cells.hpp"
#include "message_of.hpp"

namespace io_testing {

using plexway::testing::message_of;
using testing::Folder;

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

using Reader = plexway::io::Mixed(std::string_view bytes, std::string_view name);
/// What a reader finds, as what has triangles, tetrahedra or lines only.
template <Reader parse>
plexway::io::Triangles triangles(std::string_view bytes, std::string_view name) {
  return triangles_of(parse(bytes, name), name);
}
template <Reader parse>
plexway::io::Tets tets(std::string_view bytes, std::string_view name) {
  return tets_of(parse(bytes, name), name);
}
template <Reader parse>
plexway::io::Edges edges(std::string_view bytes, std::string_view name) {
  return edges_of(parse(bytes, name), name);
}

/// The message of the InputError that `parse(bytes, "mesh")` must throw.
template <class Parser>
std::string complaint(Parser parse, std::string_view bytes) {
  return message_of([&] { parse(bytes, "mesh"); });
}

/// The message of the InputError that reading `file` must throw.
template <class Reader>
std::string complaint_of(Reader read, const std::filesystem::path& file) {
  return message_of([&] { static_cast<void>(read(file)); });
}

/// `text` with its first `from`, which must be there, changed to `to`.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// A Python that has `module`; empty if there is none. Debian's need not be the first on the path.
inline std::string python_with(const std::string& module) {
  for (const char* name : {"/usr/bin/python3", "python3"}) {
    const std::string probe = std::string(name) + " -c 'import " + module + "' >/dev/null 2>&1";
    if (std::system(probe.c_str()) == 0) return name;
  }
  return {};
}

/// Whether a script of tests/io ends well.
inline bool run_peer(const std::string& python, const std::string& script,
                     const std::string& arguments, const Folder& folder) {
  const std::string log = (folder.path() / "log.txt").string();
  const std::string command = python + " -B '" PLEXWAY_SOURCE_DIR "/tests/io/" + script + "' " +
                              arguments + " >'" + log + "' 2>&1";
  const bool good = std::system(command.c_str()) == 0;
  if (!good) UNSCOPED_INFO(bytes_of(log));
  return good;
}

/// The bytes of numbers in little or big endian order, one after the other, as declared.
class Packer {
 public:
  explicit Packer(bool big_endian) : big_(big_endian) {}

  template <class Number>
  Packer& put(Number value) {
    std::string bytes(sizeof value, '\0');
    std::uint64_t bits = 0;
    static_assert(sizeof value <= sizeof bits);
    if constexpr (std::is_same_v<Number, float>)
      bits = std::bit_cast<std::uint32_t>(value);
    else if constexpr (std::is_same_v<Number, double>)
      bits = std::bit_cast<std::uint64_t>(value);
    else
      bits = static_cast<std::uint64_t>(value);
    for (std::size_t i = 0; i < sizeof value; ++i) {
      const auto byte = static_cast<char>((bits >> (8 * i)) & 0xFF);
      bytes[big_ ? sizeof value - 1 - i : i] = byte;
    }
    bytes_ += bytes;
    return *this;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  bool big_;
  std::string bytes_;
};

using Positions = std::vector<std::array<double, 3>>;
using Faces = std::vector<std::array<std::uint32_t, 3>>;

}  // namespace io_testing

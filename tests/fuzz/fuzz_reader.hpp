#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

#include <plexway/error.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

#include "fuzz_entry.hpp"

namespace fuzz {

inline void require(bool holds, std::string_view what) {
  if (holds) return;
  std::cerr << "broken promise: " << what << '\n';
  std::abort();
}

/// What users are told: one printable line, which begins with the file's name where it has one.
inline void require_line(std::string_view message, std::string_view file = {}) {
  require(!message.empty() && message.starts_with(file), "a message names the file");
  for (const char c : message) require(c >= ' ' && c <= '~', "a message is one printable line");
}

/// Runs `read`, which may refuse what it is given, with an InputError that begins with the file's
/// name where there is one, or with a NotBuiltError where this build lacks a library.
template <class Read>
int check_input(std::string_view file, Read read) {
  try {
    read();
  } catch (const plexway::InputError& error) {
    require_line(error.what(), file);
  } catch (const plexway::NotBuiltError& error) {
    require_line(error.what());
  }
  return 0;
}

template <class Rows>
void require_finite(const Rows& rows) {
  for (const auto& row : rows)
    for (const double c : row) require(std::isfinite(c), "coordinates are finite");
}

template <class Rows>
void require_in_range(const Rows& rows, std::size_t vertices) {
  for (const auto& row : rows)
    for (const auto vertex : row) require(vertex < vertices, "indices are in range");
}

/// What every reader of a surface, a solid or of cells of any kind promises for any bytes: points,
/// simplices of them where it is to be of one kind, or an InputError.
template <class Parser>
int check_reader(Parser parse, const std::uint8_t* data, std::size_t size) {
  return check_input("input", [&] {
    const auto cells = parse({reinterpret_cast<const char*>(data), size}, "input");
    require_finite(cells.positions);
    constexpr bool mixed = requires { cells.edges; };
    if constexpr (mixed) require_in_range(cells.edges, cells.positions.size());
    if constexpr (requires { cells.triangles; }) {
      require(mixed || !cells.positions.empty(), "there are points");
      require(mixed || !cells.triangles.empty(), "a surface has faces");
      require_in_range(cells.triangles, cells.positions.size());
    }
    if constexpr (requires { cells.tets; }) {
      require(mixed || !cells.tets.empty(), "a solid has tetrahedra");
      require_in_range(cells.tets, cells.positions.size());
    }
  });
}

/// Bytes as a file, for readers that want a name.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : file_(::memfd_create("input", 0)) {
    require(file_ >= 0, "a file in memory");
    const ssize_t written = ::write(file_, data, size);
    require(written == static_cast<ssize_t>(size), "all bytes in memory");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(file_); }
  [[nodiscard]] std::string name() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

}  // namespace fuzz

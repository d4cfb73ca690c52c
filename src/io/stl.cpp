// STL, ascii and binary. The format has no vertices, only corners, so identical coordinates
// become one vertex. No tolerance: what differs in the last bit stays apart.

#include <bit>
#include <string>

#include <plexway/io/triangles.hpp>

#include "bytes.hpp"
#include "surface_checks.hpp"
#include "text_scanner.hpp"

namespace plexway::io {
namespace {

/// Numbers distinct positions in order of first appearance: a hash table of vertex numbers with
/// linear probing, never more than half full.
class VertexMerger {
 public:
  explicit VertexMerger(std::vector<std::array<double, 3>>& positions)
      : positions_(positions), slots_(1024, empty) {}

  std::uint32_t number_of(std::array<double, 3> position) {
    for (double& c : position) c += 0.0;  // -0 becomes 0, which it equals
    if (positions_.size() * 2 >= slots_.size()) grow();
    std::size_t slot = hash(position) & (slots_.size() - 1);
    while (slots_[slot] != empty) {
      if (positions_[slots_[slot]] == position) return slots_[slot];
      slot = (slot + 1) & (slots_.size() - 1);
    }
    if (positions_.size() == most_vertices) return empty;
    const auto number = static_cast<std::uint32_t>(positions_.size());
    slots_[slot] = number;
    positions_.push_back(position);
    return number;
  }

  static constexpr std::uint32_t empty = 0xFFFFFFFFU;

 private:
  static std::size_t hash(const std::array<double, 3>& position) {
    std::uint64_t h = 0;
    for (double c : position) {
      h = (h ^ std::bit_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;
      h ^= h >> 29;
    }
    h *= 0xD6E8FEB86659FD93ULL;
    return static_cast<std::size_t>(h ^ (h >> 32));
  }

  void grow() {
    std::vector<std::uint32_t> larger(slots_.size() * 2, empty);
    for (const std::uint32_t number : slots_) {
      if (number == empty) continue;
      std::size_t slot = hash(positions_[number]) & (larger.size() - 1);
      while (larger[slot] != empty) slot = (slot + 1) & (larger.size() - 1);
      larger[slot] = number;
    }
    slots_ = std::move(larger);
  }

  std::vector<std::array<double, 3>>& positions_;
  std::vector<std::uint32_t> slots_;
};

constexpr std::size_t preamble = 84;  // 80 bytes of anything, then the number of facets
constexpr std::size_t facet_size = 50;

bool same_word(std::string_view field, std::string_view lower) {
  if (field.size() != lower.size()) return false;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const char c = field[i];
    if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c) != lower[i]) return false;
  }
  return true;
}

/// Binary if the size fits the number of facets it states, whatever it starts with: binary files
/// that start with "solid" are common. Otherwise "solid" decides, unless there are zero bytes.
bool is_binary(std::string_view bytes) {
  if (bytes.size() >= preamble) {
    const std::uint64_t facets = load<std::uint32_t>(bytes.data() + 80, std::endian::little);
    if (bytes.size() == preamble + facets * facet_size) return true;
  }
  const auto word = bytes.find_first_not_of(" \t\r\n");
  const bool solid = word != std::string_view::npos && same_word(bytes.substr(word, 5), "solid");
  return !solid || bytes.substr(0, 512).find('\0') != std::string_view::npos;
}

Triangles read_binary(std::string_view bytes, std::string_view name) {
  const auto fail = [&](const std::string& cause) {
    throw InputError(std::string(name) + ": " + cause);
  };
  if (bytes.size() < preamble)
    fail("neither ascii STL (no 'solid' at its start) nor binary (" + std::to_string(bytes.size()) +
         " bytes; the header alone takes 84)");
  const std::uint64_t facets = load<std::uint32_t>(bytes.data() + 80, std::endian::little);
  const std::uint64_t expected = preamble + facets * facet_size;
  if (bytes.size() != expected)
    fail("binary STL of " + std::to_string(facets) + " facets takes " + std::to_string(expected) +
         " bytes, but the file has " + std::to_string(bytes.size()));

  Triangles surface;
  surface.triangles.reserve(facets);
  VertexMerger merger(surface.positions);
  for (std::uint64_t f = 0; f < facets; ++f) {
    const std::size_t corners = preamble + f * facet_size + 12;  // behind the normal
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t c = 0; c < 3; ++c) {
      std::array<double, 3> position{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = corners + 12 * c + 4 * k;
        position[k] = static_cast<double>(load<float>(bytes.data() + at, std::endian::little));
        if (!std::isfinite(position[k]))
          fail("facet " + std::to_string(f) + " (byte " + std::to_string(at) + "): coordinate " +
               "xyz"[k] + " is not finite");
      }
      triangle[c] = merger.number_of(position);
      if (triangle[c] == VertexMerger::empty) fail("more vertices than 32 bits count");
    }
    surface.triangles.push_back(triangle);
  }
  return surface;
}

/// Takes the words `expected` (lower case), on this line or a later one.
template <class... Words>
void expect(TextScanner& scanner, Words... expected) {
  const auto one = [&](std::string_view word) {
    if (!scanner.to_content())
      scanner.fail("the file ends where '" + std::string(word) + "' should be");
    const auto field = scanner.field();
    if (!same_word(field, word))
      scanner.fail("expected '" + std::string(word) + "', found " + quote(field));
  };
  (one(expected), ...);
}

/// From behind `facet` to behind `endfacet`.
void read_facet(TextScanner& scanner, std::size_t facet, VertexMerger& merger, Triangles& surface) {
  scanner.next_line();  // the normal follows from the corners and is often nan
  expect(scanner, "outer", "loop");
  Fan fan(surface);
  for (;;) {
    if (!scanner.to_content()) scanner.fail("the file ends inside facet " + std::to_string(facet));
    const auto word = scanner.field();
    if (same_word(word, "endloop")) break;
    if (!same_word(word, "vertex"))
      scanner.fail("expected 'vertex' or 'endloop', found " + quote(word));
    const double x = scanner.number("coordinate x");
    const double y = scanner.number("coordinate y");
    const double z = scanner.number("coordinate z");
    const std::uint32_t vertex = merger.number_of({x, y, z});
    if (vertex == VertexMerger::empty) scanner.fail("more vertices than 32 bits count");
    fan.corner(vertex);
  }
  if (fan.corners() < 3) scanner.fail(too_few_corners(facet, fan.corners()));
  expect(scanner, "endfacet");
}

Triangles read_ascii(std::string_view text, std::string_view name) {
  TextScanner scanner(text, name);
  Triangles surface;
  VertexMerger merger(surface.positions);
  std::size_t facets = 0;
  while (scanner.to_content()) {  // several solids may follow each other
    expect(scanner, "solid");
    scanner.next_line();  // its name
    for (;;) {
      if (!scanner.to_content()) scanner.fail("the file ends before 'endsolid'");
      const auto word = scanner.field();
      if (same_word(word, "endsolid")) break;
      if (!same_word(word, "facet"))
        scanner.fail("expected 'facet' or 'endsolid', found " + quote(word));
      read_facet(scanner, facets++, merger, surface);
    }
    scanner.next_line();  // the name again
  }
  return surface;
}

}  // namespace

Triangles parse_stl(std::string_view bytes, std::string_view name) {
  Triangles surface = is_binary(bytes) ? read_binary(bytes, name) : read_ascii(bytes, name);
  require_faces(surface, name);
  return surface;
}

}  // namespace plexway::io

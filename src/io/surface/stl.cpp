// STL, ascii and binary. The format has no vertices, only corners, so identical coordinates
// become one vertex. No tolerance: what differs in the last bit stays apart.

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "io/numbers.hpp"
#include "io/readers.hpp"
#include "io/surface/polygons.hpp"
#include "io/text_scanner.hpp"

namespace plexway::io {
namespace {

/// Numbers distinct positions in order of first appearance: a hash table of vertex numbers with
/// linear probing, never more than half full.
class VertexMerger {
 public:
  using Position = std::array<double, 3>;

  /// `expected`: about so many will be distinct.
  explicit VertexMerger(std::vector<Position>& positions, std::size_t expected = 512)
      : positions_(positions), slots_(std::bit_ceil(2 * std::max<std::size_t>(expected, 512))) {}

  /// -0 is 0, which it equals.
  static Position rounded(Position position) {
    for (double& c : position) c += 0.0;
    return position;
  }
  static std::uint64_t hash(const Position& position) {
    std::uint64_t h = 0;
    for (double c : position) {
      h = (h ^ std::bit_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;
      h ^= h >> 29;
    }
    h *= 0xD6E8FEB86659FD93ULL;
    return h ^ (h >> 32);
  }
  /// The two reads that miss the cache, fetched ahead, one call each.
  void prefetch_slot(std::uint64_t hash) const { fetch(&slots_[slot_of(hash)]); }
  void prefetch_position(std::uint64_t hash) const {
    const std::uint32_t number = slots_[slot_of(hash)].number;
    if (number != empty) fetch(&positions_[number]);
  }

  /// Of a rounded position with its hash.
  std::uint32_t number_of(const Position& position, std::uint64_t hash) {
    if (positions_.size() * 2 >= slots_.size()) grow();
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    std::size_t slot = slot_of(hash);
    while (slots_[slot].number != empty) {
      if (slots_[slot].tag == tag && positions_[slots_[slot].number] == position)
        return slots_[slot].number;
      slot = (slot + 1) & (slots_.size() - 1);
    }
    if (positions_.size() == most_vertices) return empty;
    const auto number = static_cast<std::uint32_t>(positions_.size());
    slots_[slot] = {tag, number};
    positions_.push_back(position);
    return number;
  }
  std::uint32_t number_of(Position position) {
    position = rounded(position);
    return number_of(position, hash(position));
  }

  static constexpr std::uint32_t empty = 0xFFFFFFFFU;

 private:
  struct Slot {
    std::uint32_t tag = 0;  ///< of the hash, so that others' positions are seldom looked at
    std::uint32_t number = empty;
  };

  [[nodiscard]] std::size_t slot_of(std::uint64_t hash) const {
    return static_cast<std::size_t>(hash) & (slots_.size() - 1);
  }
  static void fetch(const void* address) {
#ifdef __GNUC__
    __builtin_prefetch(address);
#else
    static_cast<void>(address);
#endif
  }

  void grow() {
    std::vector<Slot> larger(slots_.size() * 2);
    for (const Slot& old : slots_) {
      if (old.number == empty) continue;
      std::size_t slot = hash(positions_[old.number]) & (larger.size() - 1);
      while (larger[slot].number != empty) slot = (slot + 1) & (larger.size() - 1);
      larger[slot] = old;
    }
    slots_ = std::move(larger);
  }

  std::vector<Position>& positions_;
  std::vector<Slot> slots_;
};

constexpr std::size_t preamble = 84;  // 80 bytes of anything, then the number of facets
constexpr std::size_t facet_size = 50;

bool same_word(std::string_view field, std::string_view lower) {
  return std::equal(field.begin(), field.end(), lower.begin(), lower.end(),
                    [](char a, char b) { return lower_case(a) == b; });
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
  // As many bytes more as facets take are facets that the header does not count.
  if (bytes.size() < expected ||
      (bytes.size() > expected && (bytes.size() - expected) % facet_size == 0))
    fail("binary STL of " + std::to_string(facets) + " facets takes " + std::to_string(expected) +
         " bytes, but the file has " + std::to_string(bytes.size()));

  Triangles surface;
  if (bytes.size() > expected)
    surface.report.notes.push_back(std::to_string(bytes.size() - expected) +
                                   " bytes behind the last of " + std::to_string(facets) +
                                   " facets are passed over");
  surface.triangles.reserve(facets);
  surface.positions.reserve(facets / 2 + 2);  // of closed surfaces exactly (Euler), but for handles
  VertexMerger merger(surface.positions, facets / 2);

  // Block by block, so that what is looked up is on its way before it is requested.
  constexpr std::size_t block = 64;
  std::array<VertexMerger::Position, 3 * block> positions;
  std::array<std::uint64_t, 3 * block> hashes;
  for (std::uint64_t first = 0; first < facets; first += block) {
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(block, facets - first));
    for (std::size_t i = 0; i < 3 * size; ++i) {
      const std::uint64_t facet = first + i / 3;
      const std::size_t corner =
          preamble + facet * facet_size + 12 + 12 * (i % 3);  // past the normal
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = corner + 4 * k;
        positions[i][k] = static_cast<double>(load<float>(bytes.data() + at, std::endian::little));
        if (!std::isfinite(positions[i][k]))
          fail("facet " + std::to_string(facet) + " (byte " + std::to_string(at) +
               "): coordinate " + "xyz"[k] + " is not finite");
      }
      positions[i] = VertexMerger::rounded(positions[i]);
      hashes[i] = VertexMerger::hash(positions[i]);
      merger.prefetch_slot(hashes[i]);
    }
    for (std::size_t i = 0; i < 3 * size; ++i) merger.prefetch_position(hashes[i]);
    for (std::size_t f = 0; f < size; ++f) {
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t c = 0; c < 3; ++c) {
        triangle[c] = merger.number_of(positions[3 * f + c], hashes[3 * f + c]);
        if (triangle[c] == VertexMerger::empty) fail("more vertices than 32 bits count");
      }
      surface.triangles.push_back(triangle);
    }
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
void read_facet(TextScanner& scanner, std::size_t facet, VertexMerger& merger, Faces& face) {
  scanner.next_line();  // the normal follows from the corners and is often nan
  expect(scanner, "outer", "loop");
  for (;;) {
    if (!scanner.to_content()) scanner.fail("the file ends inside facet " + std::to_string(facet));
    const auto word = scanner.field();
    if (same_word(word, "endloop")) break;
    if (!same_word(word, "vertex"))
      scanner.fail("expected 'vertex' or 'endloop', found " + quote(word));
    const std::uint32_t vertex = merger.number_of(scanner.position3());
    if (vertex == VertexMerger::empty) scanner.fail("more vertices than 32 bits count");
    face.corner(vertex);
  }
  if (face.corners() < 3) scanner.fail(too_few_corners(facet, face.corners()));
  face.end_face();
  expect(scanner, "endfacet");
}

Triangles read_ascii(std::string_view text, std::string_view name) {
  TextScanner scanner(text, name);
  Triangles surface;
  VertexMerger merger(surface.positions);
  Faces faces(surface.triangles);
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
      read_facet(scanner, facets++, merger, faces);
    }
    scanner.next_line();  // the name again
  }
  surface.report.split_polygons = faces.cut(surface.positions);
  return surface;
}

}  // namespace

Triangles parse_stl(std::string_view bytes, std::string_view name) {
  Triangles surface = is_binary(bytes) ? read_binary(bytes, name) : read_ascii(bytes, name);
  require_faces(surface, name);
  return surface;
}

}  // namespace plexway::io

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <plexway/common/detail/storage.hpp>
#include <plexway/common/ids.hpp>

#include "complexes/surface/intrinsic/planar.hpp"

namespace plexway::detail {

/// A point of a triangle in a slot.
struct SlotPoint {
  Index slot = none;
  std::array<double, 3> at = {0, 0, 0};  ///< barycentric
};

/// Which of a triangle's corners stand where in a patch: corner (first +- k) mod 3 is the patch's
/// k-th, minus where the triangle is turned over.
struct CornerOrder {
  std::uint8_t first = 0;
  std::uint8_t mirrored = 0;  ///< or 1
  [[nodiscard]] std::size_t operator()(std::size_t k) const {
    return (mirrored ? first + 3u - k : first + k) % 3;
  }
};

/// Remembers every change of a triangulation, so that points find their way from the first to the
/// last and back.
///
/// A change is a planar *patch*, a few triangles before and a few after it over the same points; a
/// slot's patches are a list in both directions. A point goes through the patches of the slots it
/// is in, each one look at which triangle of the patch it falls into: the directed graph by which
/// Guibas, Knuth and Sharir (Randomized incremental construction of Delaunay and Voronoi diagrams,
/// 1992) locate points. Nothing is traced across triangles, so nothing can miss: signposts (Sharp,
/// Soliman, Crane: Navigating intrinsic triangulations, 2019) accumulate angles along a path, and
/// normal coordinates (Gillespie, Sharp, Crane: Integer coordinates for intrinsic geometry
/// processing, 2021) are there to make that robust. Here each step is off by a rounding error of
/// the patch at most, thin triangles included.
class PatchHistory {
 public:
  /// What a patch's triangles are over its points a, b, c, d or p. a is the origin, b on the x
  /// axis.
  enum class Kind : std::uint8_t {
    flip,         ///< abc, bad become adc, bcd
    split,        ///< abc becomes abp, bcp, cap
    split_border  ///< abc becomes apc, pbc
  };
  /// A patch as it is told.
  struct Change {
    Kind kind = Kind::flip;
    std::array<Index, 2> slot = {none, none};  ///< of the triangles after, in order; a split's
                                               ///< third is the one behind its second
    double length = 0;                         ///< from a to b
    Planar c, other;                           ///< `other`: d of a flip, else p
    std::array<CornerOrder, 2> order;  ///< of the triangles before; after they are as listed
  };

  explicit PatchHistory(std::size_t slots = 0) : last_(std::vector<Index>(slots, none)) {}

  /// Slots beyond those known are new.
  void add(const Change& change);

  /// Gives back what was room for more. Cost: linear.
  void trim() { patches_.own().shrink_to_fit(); }

  /// From the first triangulation to the last.
  [[nodiscard]] SlotPoint forward(SlotPoint point) const;
  /// And back.
  [[nodiscard]] SlotPoint back(SlotPoint point) const;

  /// A straight line in a triangle of the last triangulation, from `from` to `to`, in pieces that
  /// each lie in one triangle of the first.
  struct Piece {
    Index slot;
    std::array<double, 3> from, to;
  };
  void back(const Piece& line, std::vector<Piece>& pieces) const;

  [[nodiscard]] std::size_t size() const { return patches_.size(); }
  /// Slots of the last triangulation.
  [[nodiscard]] std::size_t slots() const { return last_.size(); }
  /// For one that comes from a file: do all ways through it stay within it, and end? `first_slots`:
  /// of the first triangulation.
  [[nodiscard]] bool sound(std::size_t first_slots) const;
  /// Has anything happened to a slot of the first triangulation?
  [[nodiscard]] bool changed(Index slot) const { return last_[slot] != none; }
  [[nodiscard]] std::size_t bytes() const {
    return patches_.capacity() * sizeof(Patch) + last_.capacity() * sizeof(Index);
  }

 private:
  friend struct KeptParts;

  // In 64 bytes, as there are many.
  struct Patch {
    double length;
    Planar c, other;
    std::array<Index, 4> link;    // the patches before it of the slots that were, then those behind
                                  // it of the slots that are
    std::array<Index, 2> packed;  // slot << 4 | bit of the kind << 3 | order

    [[nodiscard]] std::size_t kind() const { return (packed[0] >> 3 & 1) | (packed[1] >> 2 & 2); }
    [[nodiscard]] Index slot(std::size_t k) const {
      return k == 2 ? (packed[1] >> 4) + 1 : packed[k] >> 4;
    }
    [[nodiscard]] CornerOrder order(std::size_t k) const {
      return {static_cast<std::uint8_t>(packed[k] & 3),
              static_cast<std::uint8_t>(packed[k] >> 2 & 1)};
    }
  };
  struct Form;
  static const std::array<Form, 3> forms;
  static const Form& form_of(const Patch& patch);
  static std::array<Planar, 3> points_of(const Patch& patch,
                                         const std::array<std::uint8_t, 3>& corners);
  static std::size_t place_of(const Patch& patch, Index slot);
  [[nodiscard]] Index first_of(Index slot) const;

  Rows<Patch> patches_;
  Rows<Index> last_;  // the last patch of each slot
};

}  // namespace plexway::detail

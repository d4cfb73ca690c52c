#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

#include "labels/mixed/bent_ways.hpp"
#include "labels/mixed/mixed_piece.hpp"

namespace plexway {

/// Whole ways as labels in solids tell them: each label is a string, each crossing knows the string
/// that it was made for, and that may begin at the crossing before.
template <class Real>
class WholeWays {
 public:
  using Domain = MixedComplex<Real>;
  using Member = typename Domain::Member;
  using Piece = MixedPiece<Real>;
  using Pieces = std::vector<std::unique_ptr<Piece>>;
  using Point = Vector3<Real>;
  using Taut = TautCrossings<Real>;
  using Step = typename Taut::Step;

  struct Way {
    Point eye;
    Real sigma = infinity;
    Index source;  // a label's, perhaps a crossing's number
    std::vector<Step> steps;
    [[nodiscard]] bool known() const { return sigma < infinity; }
  };

  WholeWays(const Domain& domain, const Pieces& pieces) : domain_(domain), pieces_(pieces) {
    for (const auto& piece : pieces)
      bends_ |= piece->bend_edges() > 0 || (piece->is_solid() && !piece->sees_all());
  }
  /// Is any more to tell than in solids in which every point sees every other?
  [[nodiscard]] bool any() const { return bends_; }

  /// The crossings are numbered from here on.
  void start(Index first) { first_ = first; }
  /// The next crossing: over a hinge to `start` in the domain's unit, by the label of member m.
  void add(Index hinge, std::uint8_t side, const HingePlace<Real>& place, const Point& start,
           Index m) {
    if (!bends_) return;
    Part& part = parts_.emplace_back(Part{{hinge, side, place}, start, {}, false});
    const auto& h = domain_.hinges()[hinge];
    part.known = pieces_[h.piece[1 - side]]->is_solid() &&
                 pieces_[h.piece[side]]->string_of(domain_.members()[m], part.string);
  }
  /// One that nothing is known of.
  void skip() {
    if (bends_) parts_.emplace_back();
  }

  /// The way that labels around a vertex inside a piece tell.
  void find(Index piece, Index vertex, const BentWays<Real>& bent, Way& way) const {
    way.sigma = infinity;
    way.steps.clear();
    if (String string; pieces_[piece]->string_to(vertex, string)) {
      lead_to(string, bent, way);
      bent.append(piece, string, way.steps);
    }
  }
  /// And that of a crossing, it included.
  void find(Index number, const BentWays<Real>& bent, Way& way) const {
    way.sigma = infinity;
    way.steps.clear();
    const Part* const part = at(number);
    if (part == nullptr || !part->known) return;
    const Index piece = domain_.hinges()[part->step.hinge].piece[part->step.side];
    lead_to(part->string, bent, way);
    bent.append(piece, part->string, way.steps);
    way.steps.push_back(part->step);
  }

 private:
  using String = typename Piece::String;
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  struct Part {
    Step step;
    Point start;
    String string;  // before the crossing
    bool known = false;
  };
  [[nodiscard]] const Part* at(Index number) const {
    return number == none || number < first_ ? nullptr : &parts_[number - first_];
  }
  // Where a string begins: at the crossing of its label, or at a point that the label was put to.
  void lead_to(const String& string, const BentWays<Real>& bent, Way& way) const {
    const Part* const before = at(string.source);
    const auto same = [](const Point& a, const Point& b) {
      return a.x == b.x && a.y == b.y && a.z == b.z;
    };
    if (before != nullptr && before->known && same(before->start, string.from)) {
      find(string.source, bent, way);
      return;
    }
    // A place of several vertices is seen on its side alone, and does not tell which that is: ways
    // from there went through cracks (up to 73 % too short).
    if (string.torn) return;
    way.eye = string.from;
    way.sigma = string.sigma;
    way.source = string.source;
  }

  const Domain& domain_;
  const Pieces& pieces_;
  bool bends_ = false;
  Index first_ = 0;
  std::vector<Part> parts_;  // by crossing
};

}  // namespace plexway

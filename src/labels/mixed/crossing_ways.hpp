#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

#include "labels/mixed/bent_ways.hpp"
#include "labels/mixed/mixed_piece.hpp"
#include "labels/mixed/taut_crossings.hpp"

namespace plexway {

/// The ways of vertices in solids, handed on from vertex to vertex and over hinges. A tetrahedron
/// keeps one label, so of the ways that cross it most are lost; a vertex that is nearer by the way
/// of another one takes that, pulled taut. It only gets nearer.
///
/// In rounds: in each a piece looks at its own vertices only, then letters go over the hinges. So
/// pieces may be several at once, and the result is the same.
template <class Real>
class CrossingWays {
 public:
  using Domain = MixedComplex<Real>;
  using Piece = MixedPiece<Real>;
  using Taut = TautCrossings<Real>;
  using Step = typename Taut::Step;
  using Point = Vector3<Real>;

  struct Way {
    Point eye;  // what it comes from, in the piece that it starts in and the domain's unit
    Real sigma = infinity;  // and the way to that; +inf: no way is known
    Index source;
    std::uint64_t kin;  // alike for ways from one eye over the same pieces
    std::vector<Step> steps;
    [[nodiscard]] bool known() const { return sigma < infinity; }
  };

  CrossingWays(const Domain& domain, const std::vector<std::unique_ptr<Piece>>& pieces,
               const Taut& taut, const BentWays<Real>& bent, Real radius)
      : domain_(domain),
        pieces_(pieces),
        taut_(taut),
        bent_(bent),
        radius_(radius),
        held_(pieces.size()) {
    for (const auto& piece : domain.pieces())
      if (std::holds_alternative<TetMesh<Real>>(domain.complex(piece)))
        held_[piece.number].ways.resize(piece.vertices);
    find_links();
  }

  /// The way that a vertex's distance is the length of. By one thread for each piece.
  void keep(Index piece, Index v, const Point& eye, Real sigma, std::span<const Step> steps,
            Index source) {
    Held& own = held_[piece];
    if (own.ways.empty()) return;
    Way& way = own.ways[v];
    way.eye = eye;
    way.sigma = sigma;
    way.source = source;
    way.steps.assign(steps.begin(), steps.end());
    find_kin(way);
  }
  void forget(Index piece, Index v) {
    if (!held_[piece].ways.empty()) held_[piece].ways[v].sigma = infinity;
  }
  [[nodiscard]] bool known(Index piece, Index v) const {
    return !held_[piece].ways.empty() && held_[piece].ways[v].known();
  }

  /// Hands on what is new in a piece, as far as that goes inside.
  void hand_on(Index piece, std::span<Real> distance, std::span<Index> label) {
    Held& own = held_[piece];
    if (own.ways.empty() || (own.begun && own.letters.empty())) return;
    Work work(*this, piece, distance, label);
    if (!own.begun) {
      own.begun = true;
      own.waits.assign(own.ways.size(), 0);
      own.changed.assign(own.ways.size(), 0);
      for (Index v = 0; v < own.ways.size(); ++v)
        if (own.ways[v].known()) work.add(v);
    }
    for (const Letter& letter : own.letters) work.receive(letter);
    own.letters.clear();
    work.run();
    for (const Index v : own.sent) {
      own.changed[v] = 0;
      work.send(v);
    }
    own.sent.clear();
  }
  /// What crosses hinges. True if there is any.
  bool deliver() {
    bool any = false;
    for (Held& own : held_)
      for (auto& [to, letter] : std::exchange(own.letters_out, {})) {
        held_[to].letters.push_back(std::move(letter));
        any = true;
      }
    if (any && ++rounds_ >= most_rounds) held_[0].cut_short = true;
    return any && rounds_ < most_rounds;
  }
  /// A piece's vertices were looked at more often than is any use: some may be nearer.
  void cut_short(Index piece) { held_[piece].cut_short = true; }
  [[nodiscard]] bool is_cut_short() const {
    return std::any_of(held_.begin(), held_.end(), [](const Held& own) { return own.cut_short; });
  }

 private:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();
  static constexpr std::size_t most_rounds = 4096;

  /// A welded vertex, the one beyond, and a hinge at both; the first of several such stands for
  /// all.
  struct Link {
    Index vertex, piece, other;
    Step step;
  };
  struct Letter {
    Index vertex;
    Real time;
    Way way;
  };
  struct Held {
    std::vector<Way> ways;
    std::vector<Link> links;  // by vertex
    std::vector<char> waits, changed;
    std::vector<Index> front, sent;
    std::size_t looked_at = 0;
    std::vector<Letter> letters;
    std::vector<std::pair<Index, Letter>> letters_out;
    bool begun = false, cut_short = false;
  };

  static std::uint64_t mixed(std::uint64_t kin, std::uint64_t more) {
    kin = (kin ^ more) * 0x9E3779B97F4A7C15ULL;
    return kin ^ (kin >> 29);
  }
  static std::uint64_t mixed(std::uint64_t kin, Real number) {
    return mixed(kin, std::bit_cast<std::uint64_t>(static_cast<double>(number)));
  }
  void find_kin(Way& way) const {
    way.kin = mixed(mixed(mixed(mixed(0, way.eye.x), way.eye.y), way.eye.z), way.sigma);
    for (const Step& step : way.steps) way.kin = longer(way.kin, step);
  }
  [[nodiscard]] std::uint64_t longer(std::uint64_t kin, const Step& step) const {
    if (taut_.is_bend(step)) return mixed(kin, std::uint64_t{step.hinge} << 32);
    const auto& hinge = domain_.hinges()[step.hinge];
    return mixed(
        mixed(kin, std::uint64_t{hinge.piece[step.side]} << 32 | hinge.piece[1 - step.side]),
        std::uint64_t{hinge.dimension});
  }

  void find_links() {
    std::vector<std::vector<Index>> outside(pieces_.size());
    for (const auto& piece : domain_.pieces()) {
      if (held_[piece.number].ways.empty()) continue;
      const auto& solid = std::get<TetMesh<Real>>(domain_.complex(piece));
      auto& of = outside[piece.number];
      of.resize(piece.vertices);
      for (Index v = 0; v < piece.vertices; ++v) of[solid.inside_vertex(v)] = v;
    }
    for (Index n = 0; n < domain_.hinges().size(); ++n) {
      const auto& hinge = domain_.hinges()[n];
      if (hinge.dimension != 2) continue;
      if (outside[hinge.piece[0]].empty() || outside[hinge.piece[1]].empty()) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        Index at[2];
        for (const std::size_t side : {0, 1}) {
          const auto& member = domain_.members()[hinge.begin[side]];
          at[side] = outside[hinge.piece[side]][pieces_[hinge.piece[side]]->vertex_of(
              member.simplex, member.corner[i])];
        }
        for (const std::size_t side : {0, 1})
          held_[hinge.piece[side]].links.push_back(
              {at[side],
               hinge.piece[1 - side],
               at[1 - side],
               {n, static_cast<std::uint8_t>(side), {i == 1 ? Real(1) : 0, i == 2 ? Real(1) : 0}}});
      }
    }
    for (Held& own : held_) {
      const auto by = [](const Link& link) {
        return std::array{link.vertex, link.piece, link.other, link.step.hinge};
      };
      std::sort(own.links.begin(), own.links.end(),
                [&](const Link& a, const Link& b) { return by(a) < by(b); });
    }
  }

  /// On one piece.
  class Work {
   public:
    Work(CrossingWays& ways, Index piece, std::span<Real> distance, std::span<Index> label)
        : all_(ways),
          own_(ways.held_[piece]),
          number_(piece),
          piece_(*ways.pieces_[piece]),
          solid_(std::get<TetMesh<Real>>(ways.domain_.complex(ways.domain_.pieces()[piece]))),
          distance_(distance),
          label_(label),
          outside_(distance.size()) {
      for (Index v = 0; v < distance.size(); ++v) outside_[solid_.inside_vertex(v)] = v;
    }

    void add(Index v) {
      if (!own_.waits[v]) own_.front.push_back(v);
      own_.waits[v] = 1;
      if (!own_.changed[v]) own_.sent.push_back(v);
      own_.changed[v] = 1;
    }
    void run() {
      const std::size_t most = 64 * distance_.size();  // some may win by less and less, in turns
      for (std::size_t i = 0; i < own_.front.size(); ++i) {
        const Index v = own_.front[i];
        own_.waits[v] = 0;
        if (own_.looked_at++ > most) {
          own_.cut_short = true;
          continue;
        }
        const Way way = own_.ways[v];
        offer_around(v, way, distance_[v]);
      }
      own_.front.clear();
    }
    void receive(const Letter& letter) {
      const Index v = letter.vertex;
      if (take_if(v, letter.way, letter.time)) return;
      if (own_.ways[v].known() && own_.ways[v].kin == letter.way.kin) return;
      offer_around(v, letter.way, letter.time);
      if (!(letter.time > letter.way.sigma) && piece_.sees_all()) offer_to_straight(v, letter.way);
      send(v, letter.way, letter.time);
    }
    /// A vertex's way to the pieces beyond.
    void send(Index v) {
      if (own_.ways[v].known()) send(v, own_.ways[v], distance_[v]);
    }

   private:
    void send(Index v, const Way& way, Real time) {
      // What has just come over this hinge does not go back, but once around a crack that ends
      // there.
      const bool arrives = !way.steps.empty() && all_.ends_at(way, place(v));
      if (arrives && all_.turns(way)) return;
      auto link = std::lower_bound(own_.links.begin(), own_.links.end(), v,
                                   [](const Link& l, Index vertex) { return l.vertex < vertex; });
      const Link* before = nullptr;
      for (; link != own_.links.end() && link->vertex == v; ++link) {
        const bool first =
            before == nullptr || before->piece != link->piece || before->other != link->other;
        before = &*link;
        const bool back = !all_.pieces_[link->piece]->sees_all() && arrives &&
                          way.steps.back().hinge != link->step.hinge;
        if (arrives ? !back : !first) continue;
        Letter letter = {link->other, time, way};
        letter.way.steps.push_back(link->step);
        letter.way.kin = all_.longer(way.kin, link->step);
        own_.letters_out.push_back({link->piece, std::move(letter)});
      }
    }

    [[nodiscard]] Point place(Index v) const {
      return piece_.unit() * piece_.place(solid_.inside_vertex(v));
    }
    // To neighbours, where a bound from below says that they may gain.
    void offer_around(Index v, const Way& way, Real time) {
      const Point at = place(v);
      const Point from = all_.taut_.last_place(way.eye, way.steps);
      const auto slope = all_.taut_.slope(way.eye, way.steps, at);
      const Real before = time - norm(at - from);
      piece_.vertices_around(solid_.inside_vertex(v), around_);
      for (const Index inner : around_) {
        const Index w = outside_[inner];
        const Point there = piece_.unit() * piece_.place(inner);
        // One whose way is not known may take what explains its distance.
        const bool known = own_.ways[w].known();
        const Real enough = distance_[w] * (1 + (known ? -1 : 1) * Piece::crossing_gain);
        if (!(before + norm(there - from) < enough)) {
          if (known && own_.ways[w].kin == way.kin) continue;
          if (!(time + slope.least(there - at) < enough)) continue;
        }
        offer(w, inner, way, enough);
      }
    }
    // From a source on a hinge, at v: to all that see it straight, and their neighbours. Beside a
    // faster piece it is nearer along that, and none in between need keep that way.
    void offer_to_straight(Index v, const Way& way) {
      if (!own_.ways[v].known() || !own_.ways[v].steps.empty()) return;
      const std::uint64_t straight = own_.ways[v].kin;
      std::vector<Index> front = {v};
      seen_.resize(own_.ways.size(), 0);
      seen_[v] = ++looks_;
      for (std::size_t i = 0; i < front.size(); ++i) {
        piece_.vertices_around(solid_.inside_vertex(front[i]), around_);
        for (const Index inner : around_) {
          const Index w = outside_[inner];
          if (std::exchange(seen_[w], looks_) == looks_) continue;
          const bool known = own_.ways[w].known();
          if (known && own_.ways[w].kin == straight) front.push_back(w);
          offer(w, inner, way, distance_[w] * (1 + (known ? -1 : 1) * Piece::crossing_gain));
        }
      }
    }
    void offer(Index w, Index inner, const Way& way, Real enough) {
      path_.assign(way.steps.begin(), way.steps.end());
      const Real length = all_.bent_.pull(way.eye, way.sigma, path_, number_, inner, enough, room_);
      if (!(length < enough) || length > all_.radius_) return;
      take(w, way, length);
      own_.ways[w].steps = path_;
      all_.find_kin(own_.ways[w]);
    }
    bool take_if(Index v, const Way& way, Real time) {
      const Real gain = (own_.ways[v].known() ? -1 : 1) * Piece::crossing_gain;
      if (!(time < distance_[v] * (1 + gain)) || time > all_.radius_) return false;
      take(v, way, time);
      return true;
    }
    void take(Index v, const Way& way, Real time) {
      own_.ways[v] = way;
      if (time < distance_[v]) distance_[v] = time, label_[v] = way.source;
      add(v);
    }

    CrossingWays& all_;
    Held& own_;
    Index number_;
    const Piece& piece_;
    const TetMesh<Real>& solid_;
    std::span<Real> distance_;
    std::span<Index> label_;
    std::vector<Index> outside_, around_;
    std::vector<Index> seen_;  // by vertex: in which look
    Index looks_ = 0;
    std::vector<Step> path_;
    typename BentWays<Real>::Room room_;
  };

  // Is the last crossing where the way ends?
  [[nodiscard]] bool ends_at(const Way& way, const Point& target) const {
    const Step& last = way.steps.back();
    return !taut_.is_bend(last) &&
           norm(target - taut_.place(last, 1 - last.side)) <= Real(1e-6) * taut_.size(last);
  }

  // Are the last two crossings at one place?
  [[nodiscard]] bool turns(const Way& way) const {
    if (way.steps.size() < 2) return false;
    const Step &last = way.steps.back(), &before = way.steps[way.steps.size() - 2];
    return !taut_.is_bend(before) &&
           norm(taut_.place(before, 1 - before.side) - taut_.place(last, last.side)) <=
               Real(1e-6) * taut_.size(last);
  }

  const Domain& domain_;
  const std::vector<std::unique_ptr<Piece>>& pieces_;
  const Taut& taut_;
  const BentWays<Real>& bent_;
  Real radius_;
  std::vector<Held> held_;
  std::size_t rounds_ = 0;
};

}  // namespace plexway

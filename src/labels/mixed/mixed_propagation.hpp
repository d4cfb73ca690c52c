#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

#include "labels/mixed/hinge_crossings.hpp"
#include "labels/mixed/mixed_hinges.hpp"
#include "labels/mixed/mixed_piece.hpp"
#include "labels/mixed/mixed_solid.hpp"
#include "labels/mixed/mixed_surface.hpp"
#include "labels/mixed/mixed_wire.hpp"
#include "labels/progress_counter.hpp"
#include "labels/slot_set.hpp"

namespace plexway {

/// Calls work(piece) for each of these pieces, several at once; returns when all are done.
using PiecesAtOnce =
    std::function<void(std::span<const Index> pieces, const std::function<void(Index)>& work)>;

/// One propagation over a mixed domain. Pieces take turns up to a horizon, so that all of them know
/// about as much; in between, what was expanded at the welds crosses them. In its turn a piece
/// looks at nothing but itself, so turns may be at once, and the result is the same.
template <class Real>
class MixedPropagation {
 public:
  using Domain = MixedComplex<Real>;
  using Member = typename Domain::Member;

  /// `offered` is room for what has crossed already. Without `at_once` pieces are one after the
  /// other's.
  MixedPropagation(const Domain& domain, std::span<WorkspaceState<Real>> workspaces,
                   std::vector<Real>& offered, const PropagateOptions& options,
                   const PiecesAtOnce& at_once = {})
      : domain_(domain),
        options_(options),
        at_once_(at_once),
        reported_(options, 4096),
        offered_(offered),
        pieces_(pieces_of(domain, workspaces)),
        hinges_(domain, pieces_),
        posed_(domain.members().size()),
        due_(slots(domain)),
        bends_(slots(domain)),
        crossings_(domain, pieces_, hinges_.neighbours()),
        ran_(pieces_.size(), 0),
        pace_(pace(domain)) {
    offered_.assign(slots(domain), infinity);
  }

  /// A source in the piece's own numbers. A welded vertex is one in its other pieces too.
  void seed(Index piece, const PointSource& source, Index number) {
    const Real offset = static_cast<Real>(source.offset);
    crossings_.seed(piece, pieces_[piece]->place(source), offset, number);
    pieces_[piece]->seed(source, number);
    if (source.vertex == none) return;
    const Index vertex = std::visit([&](const auto& c) { return c.inside_vertex(source.vertex); },
                                    domain_.complex(domain_.pieces()[piece]));
    for (const auto& weld : domain_.welds())
      for (const std::size_t side : {0, 1})
        if (weld.piece[side] == piece && weld.vertex[side] == vertex) {
          auto& other = *pieces_[weld.piece[1 - side]];
          crossings_.seed(weld.piece[1 - side], other.unit() * other.place(weld.vertex[1 - side]),
                          offset, number);
          other.enter_vertex(weld.vertex[1 - side], offset, number, false);
        }
  }

  void run() {
    while (complete_) {
      Real nearest = infinity;
      for (const auto& piece : pieces_) nearest = std::min(nearest, piece->nearest());
      if (!(nearest < infinity)) {
        if (!look_again()) return;
        continue;
      }
      // By more than the pieces' units round.
      const Real horizon =
          std::max(nearest + pace_, nearest * (1 + 8 * std::numeric_limits<Real>::epsilon()));
      do {
        take_turns(horizon);
      } while (complete_ && cross());
    }
  }

  /// One a vertex of the domain.
  void read_out(DistanceField<Real>& field) {
    field.distance.assign(domain_.vertex_count(), infinity);
    field.label.assign(domain_.vertex_count(), none);
    each([&](Index p) { pieces_[p]->read_out(distances(field, p), labels(field, p)); });
    crossings_.end();
    each([&](Index p) {
      crossings_.straighten(p, distances(field, p), labels(field, p));
      for (Index& l : labels(field, p)) l = root(l);
    });
    field.complete = complete_;
    field.statistics = {};
    for (const auto& piece : pieces_) {
      const PropagateStatistics s = piece->statistics();
      field.statistics.expansions += s.expansions;
      field.statistics.updates += s.updates;
      field.statistics.reached_simplices += s.reached_simplices;
    }
  }

  /// When sources have had their say: welded vertices are one, and none is farther than a neighbour
  /// and the edge between.
  void settle(DistanceField<Real>& field) {
    weld(field);
    std::vector<Index> changed(pieces_.size());
    std::iota(changed.begin(), changed.end(), 0);
    while (!changed.empty()) {
      turn_ = changed;
      said_.assign(pieces_.size(), 0);
      each_in_turn(true, [&](Index p) {
        said_[p] = pieces_[p]->relax(distances(field, p), labels(field, p));
      });
      changed = any_said() ? weld(field) : std::vector<Index>();
    }
  }

 private:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  static std::size_t slots(const Domain& domain) {
    return 2 * domain.welds().size() + domain.members().size();
  }

  std::vector<std::unique_ptr<MixedPiece<Real>>> pieces_of(
      const Domain& domain, std::span<WorkspaceState<Real>> workspaces) {
    const Real step =
        options_.schedule == Schedule::fifo ? infinity : static_cast<Real>(options_.step);
    // What pieces count and report is summed up here.
    PropagateOptions mine = options_;
    if (options_.progress) mine.progress = [this](const Progress& p) { return report(p); };
    std::vector<std::unique_ptr<MixedPiece<Real>>> pieces;
    for (const auto& piece : domain.pieces()) {
      WorkspaceState<Real>& workspace = workspaces[piece.number];
      const auto& complex = domain.complex(piece);
      if (const auto* surface = std::get_if<TriangleMesh<Real>>(&complex))
        pieces.push_back(std::make_unique<MixedSurface<Real>>(*surface, workspace, mine, step));
      else if (const auto* solid = std::get_if<TetMesh<Real>>(&complex))
        pieces.push_back(std::make_unique<MixedSolid<Real>>(*solid, workspace, mine, step));
      else
        pieces.push_back(std::make_unique<MixedWire<Real>>(std::get<Wireframe<Real>>(complex),
                                                           workspace, mine, step));
    }
    return pieces;
  }

  // So far the horizon moves on at a time: the mean edge where most simplices are.
  static Real pace(const Domain& domain) {
    if (domain.pieces().size() == 1) return infinity;
    double sum = 0;
    for (const auto& piece : domain.pieces())
      sum += static_cast<double>(piece.simplices) *
             std::visit([](const auto& c) { return c.summary().mean_edge; }, domain.complex(piece));
    const double mean = sum / static_cast<double>(domain.simplex_count());
    return mean > 0 ? static_cast<Real>(mean) : infinity;
  }

  std::span<Real> distances(DistanceField<Real>& field, Index p) const {
    const auto& piece = domain_.pieces()[p];
    return std::span(field.distance).subspan(piece.first_vertex, piece.vertices);
  }
  std::span<Index> labels(DistanceField<Real>& field, Index p) const {
    const auto& piece = domain_.pieces()[p];
    return std::span(field.label).subspan(piece.first_vertex, piece.vertices);
  }

  // A chain of welds may need several rounds. Gives the pieces where a vertex got nearer.
  std::vector<Index> weld(DistanceField<Real>& field) const {
    std::vector<Index> changed;
    const auto offer = [&](Index v, Index from) {
      if (!(field.distance[from] < field.distance[v])) return false;
      field.distance[v] = field.distance[from];
      field.label[v] = field.label[from];
      const auto piece =
          std::upper_bound(domain_.pieces().begin(), domain_.pieces().end(), v,
                           [](Index vertex, const auto& p) { return vertex < p.first_vertex; });
      changed.push_back(std::prev(piece)->number);
      return true;
    };
    for (bool again = true; again;) {
      again = false;
      for (const auto& [v, w] : domain_.outer_welds()) again |= offer(v, w) || offer(w, v);
    }
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    return changed;
  }

  // work(p) for those in turn_, on this thread unless it is worth waking others.
  template <class Work>
  void each_in_turn(bool worth, const Work& work) {
    if (!at_once_ || !worth || turn_.size() < 2) {
      for (const Index p : turn_) {
        running_ = p;
        work(p);
      }
    } else {
      running_ = none;
      at_once_(turn_, work);
    }
  }
  // The same for all pieces.
  template <class Work>
  void each(const Work& work) {
    turn_.clear();
    for (Index p = 0; p < pieces_.size(); ++p) turn_.push_back(p);
    said_.assign(pieces_.size(), 0);
    each_in_turn(true, work);
  }
  [[nodiscard]] bool any_said() const {
    return std::any_of(said_.begin(), said_.end(), [](char said) { return said != 0; });
  }

  // Those with something to do, as far as the horizon. What is left of the budget is dealt to them
  // by number: who works, and when, changes nothing.
  void take_turns(Real horizon) {
    turn_.clear();
    for (Index p = 0; p < pieces_.size(); ++p)
      if (pieces_[p]->nearest() < horizon) turn_.push_back(p);
    if (turn_.empty()) return;
    const std::size_t spent = expansions(), budget = options_.max_expansions;
    const std::size_t left = budget - std::min(budget, spent);
    if (left == 0) {
      complete_ = false;
      return;
    }
    share_.resize(pieces_.size());
    for (std::size_t i = 0; i < turn_.size(); ++i)
      share_[turn_[i]] = left / turn_.size() + (i < left % turn_.size());
    constexpr std::size_t worth_waking = 128;
    each_in_turn(spent - spent_before_ >= worth_waking, [&](Index p) {
      ran_[p] = 1;
      const std::size_t own = pieces_[p]->statistics().expansions;
      constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
      pieces_[p]->run(horizon, share_[p] > most - own ? most : own + share_[p]);
    });
    spent_before_ = spent;
    if (running_ == none)
      reported_.count(expansions(), [&] { return progress(static_cast<double>(horizon)); });
  }

  // When nothing waits: what looks at whole pieces, and bends at vertices last, since they serve
  // what nothing else reaches. True if something waits then.
  bool look_again() {
    if (pace_ < infinity)
      for (const auto& piece : pieces_) piece->hold();
    each([&](Index p) {
      if (std::exchange(ran_[p], 0)) said_[p] = pieces_[p]->repair();
    });
    return any_said() || bend();
  }

  std::size_t expansions() const {
    std::size_t sum = 0;
    for (const auto& piece : pieces_) sum += piece->statistics().expansions;
    return sum;
  }

  Progress progress(double distance) const {
    Progress all = {0, 0, domain_.simplex_count(), distance};
    for (const auto& piece : pieces_) {
      const PropagateStatistics own = piece->statistics();
      all.expansions += own.expansions;
      all.reached += own.reached_simplices;
    }
    return all;
  }

  // A piece wants to tell. Where several run that is done in between.
  bool report(const Progress& of_piece) const {
    if (running_ == none) return true;
    Progress all = progress(of_piece.distance);
    const PropagateStatistics own = pieces_[running_]->statistics();
    all.expansions += of_piece.expansions - own.expansions;
    all.reached += of_piece.reached - own.reached_simplices;
    return options_.progress(all);
  }

  [[nodiscard]] Index root(Index number) const { return crossings_.root(number); }

  // Over the welds where something was expanded. True if something was accepted.
  bool cross() {
    for (const auto& piece : domain_.pieces()) {
      std::vector<Index>& expanded = pieces_[piece.number]->expanded();
      for (const Index at : expanded)
        for (const Index slot : hinges_.slots(piece.number, at)) due_.add(slot);
      expanded.clear();
    }
    list_.clear();
    due_.drain(list_);
    bool any = false;
    members_.clear();
    for (const Index slot : list_) {
      if (slot < 2 * domain_.welds().size()) {
        const Index w = slot / 2;
        if (domain_.welds()[w].hinge) any |= pass(w, slot % 2, false);
        if (hinges_.bend_at(w) != none) bends_.add(slot);
        continue;
      }
      members_.push_back(slot);
    }
    return carry(members_) || any;
  }

  // Over a welded vertex, if that got better. True if it was accepted.
  bool pass(Index w, std::size_t side, bool bends) {
    const auto& weld = domain_.welds()[w];
    Real& offered = offered_[2 * w + side];
    const auto found = pieces_[weld.piece[side]]->at_vertex(weld.vertex[side]);
    if (!(found.distance < offered)) return false;
    offered = found.distance;
    if (static_cast<double>(found.distance) > options_.radius) return false;
    return tell(2 * w + static_cast<Index>(side), found.distance, root(found.source), bends);
  }

  // A path of a piece to a welded vertex, `slot`, is one of the other piece. All vertices that are
  // one hear of it, even where no simplex in between is nearer by it. True if it was accepted.
  bool tell(Index slot, Real distance, Index source, bool bends) {
    offered_[slot] = distance;
    const Index w = slot / 2;
    const auto& weld = domain_.welds()[w];
    const std::size_t side = slot % 2;
    auto& to = *pieces_[weld.piece[1 - side]];
    const Index vertex = weld.vertex[1 - side];
    // Of many such vertices a tetrahedron keeps one, as of crossings: its label is offered around.
    const bool starts = bends || to.sees_all();
    bool any = to.enter_vertex(vertex, distance, starts ? crossings_.next() : source, bends);
    if (any && starts)
      crossings_.add({source, bends ? hinges_.bend_at(w) : none, static_cast<std::uint8_t>(side),
                      to.place(vertex)});
    if (!bends)
      for (const Index other : hinges_.beside(slot ^ 1))
        if (distance < offered_[other]) any |= tell(other, distance, source, false);
    return any;
  }

  // Over the hinges of the members in these slots, where they got better. True if something was
  // accepted.
  bool carry(std::span<const Index> slots) {
    // First what has got better, then all of that goes over.
    changed_.clear();
    for (const Index slot : slots) {
      const Index m = slot - 2 * static_cast<Index>(domain_.welds().size());
      const auto [n, side] = hinges_.place(m);
      const auto& hinge = domain_.hinges()[n];
      const Member& member = domain_.members()[m];
      const auto& piece = *pieces_[hinge.piece[side]];
      const Real distance = piece.distance(member.simplex);
      if (!(distance < offered_[slot])) continue;
      offered_[slot] = distance;
      HingeFront<Real> front(piece, member, hinge.dimension, none, none);
      const bool one = front.is_one_source(posed_[m]);
      posed_[m].source = root(posed_[m].source);
      // Virtual sources of a surface are where they seem to be for points of its plane alone: from
      // its triangles paths bend on the face. What comes into a solid bends on the hinge.
      const bool as_it_is = one && hinges_.is_isometric(n) &&
                            !pieces_[hinge.piece[1 - side]]->is_solid() &&
                            (hinge.dimension == 1 || piece.is_solid());
      changed_.push_back({n, side, m, as_it_is});
    }
    bool any = false;
    for (const auto& [n, side, m, as_it_is] : changed_) {
      const auto& hinge = domain_.hinges()[n];
      const Index to = hinge.piece[1 - side];
      if (as_it_is) {
        for (Index k = hinge.begin[1 - side]; k < hinge.end[1 - side]; ++k) {
          PosedSource<Real> posed = posed_[m];
          posed.sigma += gain_over(n, side, m, k);
          any |= pieces_[to]->enter(domain_.members()[k], hinge.dimension, posed,
                                    hinges_.chains().line(n));
        }
        continue;
      }
      for (Index k = hinge.begin[1 - side]; k < hinge.end[1 - side]; ++k) {
        const HingeFront<Real> front(*pieces_[hinge.piece[side]], domain_.members()[m],
                                     hinge.dimension, posed_[m].source, crossings_.next());
        Vector3<Real> start = {0, 0, 0};
        if (!pieces_[to]->enter_front(domain_.members()[k], front, start)) continue;
        any = true;
        crossings_.add({posed_[m].source, n, static_cast<std::uint8_t>(side), start});
      }
    }
    return any;
  }

  // A source that is handed on must not be nearer to a point of the hinge than it was before, else
  // labels would gain on themselves going to and fro: what two measures of one hinge differ by.
  [[nodiscard]] Real gain_over(Index n, std::size_t side, Index m, Index k) const {
    const auto& hinge = domain_.hinges()[n];
    const auto before = pieces_[hinge.piece[side]]->shape(domain_.members()[m], hinge.dimension);
    const auto after = pieces_[hinge.piece[1 - side]]->shape(domain_.members()[k], hinge.dimension);
    const PosedSource<Real>& eye = posed_[m];
    const auto way = [&](const HingeShape<Real>& shape, const HingePlace<Real>& b) {
      const auto p = shape.place(b);
      return std::sqrt((p[0] - eye.x) * (p[0] - eye.x) + (p[1] - eye.y) * (p[1] - eye.y) +
                       eye.h * eye.h);
    };
    Real most = 0;
    for (int i = 0; i <= hinge.dimension; ++i) {
      const HingePlace<Real> b = {i == 1 ? Real(1) : Real(0), i == 2 ? Real(1) : Real(0)};
      most = std::max(most, way(before, b) - way(after, b));
    }
    return most;
  }

  // Over the vertices where paths may bend. True if something was accepted.
  bool bend() {
    list_.clear();
    bends_.drain(list_);
    bool any = false;
    for (const Index slot : list_) any |= pass(slot / 2, slot % 2, true);
    return any;
  }

  const Domain& domain_;
  const PropagateOptions& options_;
  const PiecesAtOnce at_once_;
  ProgressCounter reported_;
  std::vector<Real>& offered_;  // by slot
  const std::vector<std::unique_ptr<MixedPiece<Real>>> pieces_;
  const MixedHinges<Real> hinges_;
  struct Change {
    Index hinge, side, member;
    bool as_it_is;
  };
  std::vector<Change> changed_;
  std::vector<PosedSource<Real>> posed_;  // by member: what it offered last
  // Where something was expanded: slots to look at, and what waits until nothing else does.
  SlotSet due_, bends_;
  std::vector<Index> list_, members_;
  HingeCrossings<Real> crossings_;
  std::vector<Index> turn_;         // pieces at work
  std::size_t spent_before_ = 0;    // when the last turn began
  std::vector<std::size_t> share_;  // by piece: of what may be expanded, in this turn
  std::vector<char> said_;          // by piece: its answer
  std::vector<char> ran_;           // by piece, since it was repaired
  Real pace_;
  Index running_ = none;  // alone, and on this thread
  bool complete_ = true;
};

}  // namespace plexway

#include <catch2/catch.hpp>

#include <set>
#include <vector>

#include "complexes/partition/cut.hpp"
#include "complexes/partition/partition.hpp"

namespace plexway::partition_test {

namespace {

/// Cells of a board, each beside up to four, numbered row by row.
struct Board {
  Index width, height;

  [[nodiscard]] Index count() const { return width * height; }
  auto neighbours() const {
    return [*this](Index s, const auto& visit) {
      const Index x = s % width, y = s / width;
      if (x > 0) visit(s - 1);
      if (x + 1 < width) visit(s + 1);
      if (y > 0) visit(s - width);
      if (y + 1 < height) visit(s + width);
    };
  }
  [[nodiscard]] std::vector<std::array<float, 3>> points() const {
    std::vector<std::array<float, 3>> all;
    for (Index s = 0; s < count(); ++s)
      all.push_back({static_cast<float>(s % width), static_cast<float>(s / width), 0});
    return all;
  }
};

std::vector<std::size_t> sizes(const Partition& partition) {
  std::vector<std::size_t> found(partition.pieces);
  for (const Index p : partition.piece_of) ++found.at(p);
  return found;
}

}  // namespace

TEST_CASE("pieces are of one size, compact, and the same each time") {
  const Board board = {150, 90};
  const bool with_points = GENERATE(true, false);
  const auto points = with_points ? board.points() : std::vector<std::array<float, 3>>();
  const std::size_t size = GENERATE(100u, 450u);
  const Partition partition = plexway::partition(board.count(), size, points, board.neighbours());
  INFO(with_points << " " << size);
  REQUIRE(partition.piece_of.size() == board.count());
  for (const std::size_t n : sizes(partition)) {
    CHECK(n >= size / 4);
    CHECK(n <= 2 * size);
  }
  std::size_t cuts = 0;
  for (Index s = 0; s < board.count(); ++s)
    board.neighbours()(s, [&](Index t) { cuts += partition.piece_of[s] != partition.piece_of[t]; });
  // Squares of that size have perimeters of 4 sqrt(size) in all; each cut counts on both sides.
  const double squares = static_cast<double>(board.count()) / std::sqrt(size) * 4;
  CHECK(static_cast<double>(cuts) < (with_points ? 1.2 : 2.0) * squares);
  CHECK(plexway::partition(board.count(), size, points, board.neighbours()).piece_of ==
        partition.piece_of);
}

TEST_CASE("a partition of little is whole") {
  const Board board = {3, 2};
  const auto points =
      GENERATE(true, false) ? Board{3, 2}.points() : std::vector<std::array<float, 3>>();
  const Partition one = partition(board.count(), 100, points, board.neighbours());
  CHECK(one.pieces == 1);
  CHECK(one.piece_of == std::vector<Index>(6, 0));
  // Parts that nothing connects.
  const Partition apart = grown(6, 2, [](Index, const auto&) {});
  CHECK(apart.pieces == 6);
  Partition empty = {{4, 2, 4, 0}, 5};
  leave_out_empty(empty);
  CHECK(empty.pieces == 3);
  CHECK(empty.piece_of == std::vector<Index>{2, 1, 2, 0});
}

TEST_CASE("pieces know their peers, and peers what they have as ghosts") {
  const Board board = {40, 31};
  const auto neighbours = board.neighbours();
  const Cut cut =
      plexway::cut(partition(board.count(), 60, board.points(), neighbours), neighbours);
  std::size_t own = 0;
  for (Index p = 0; p < cut.pieces.size(); ++p) {
    const CutPiece& piece = cut.pieces[p];
    own += piece.own;
    std::set<Index> ghosts;
    for (Index i = 0; i < piece.own; ++i) {
      const Index s = piece.simplices[i];
      CHECK(cut.piece_of[s] == p);
      CHECK(cut.number_of[s] == i);
      bool at_cut = false;
      neighbours(s, [&](Index t) {
        if (cut.piece_of[t] != p) at_cut = true, ghosts.insert(t);
      });
      CHECK(at_cut == (i < piece.at_cut));
    }
    CHECK(ghosts == std::set<Index>(piece.simplices.begin() + static_cast<long>(piece.own),
                                    piece.simplices.end()));
    for (const Index s : ghosts) {
      const Index here = piece.ghost(s, cut.piece_of);
      REQUIRE(here != none);
      CHECK(piece.simplices[here] == s);
    }
    CHECK(piece.ghost(piece.simplices[0], cut.piece_of) == none);
    std::size_t told = 0;
    for (std::size_t k = 0; k < piece.peer_count(); ++k) {
      const CutPiece::Peer& peer = piece.peers[k];
      const CutPiece& other = cut.pieces[peer.piece];
      CHECK(other.peers[peer.place].piece == p);
      for (const CutPiece::Slot& slot : piece.slots_of(k)) {
        CHECK(slot.here < piece.at_cut);
        CHECK(slot.there >= other.own);
        CHECK(other.simplices[slot.there] == piece.simplices[slot.here]);
        ++told;
      }
    }
    // Each of its own that is a ghost elsewhere, once a peer that has it.
    std::size_t wanted = 0;
    for (Index i = 0; i < piece.at_cut; ++i) {
      std::set<Index> who;
      neighbours(piece.simplices[i], [&](Index t) {
        if (cut.piece_of[t] != p) who.insert(cut.piece_of[t]);
      });
      wanted += who.size();
    }
    CHECK(told == wanted);
  }
  CHECK(own == board.count());
}

}  // namespace plexway::partition_test

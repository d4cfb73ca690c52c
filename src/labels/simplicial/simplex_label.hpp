#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <tuple>
#include <vector>

#include "complexes/simplicial/flat_domain.hpp"
#include "labels/label_memory.hpp"

namespace plexway {

/// What an N-simplex remembers under the plain step: the virtual source of the best path to its
/// centre, as squared distances to its own vertices. No coordinates.
template <class Real, int N>
struct SimplexLabel {
  Real distance2[N + 1];
  Real sigma;   ///< walked from the source to the virtual source
  Real centre;  ///< distance of the centre
};

/// What an N-simplex of a flat domain remembers: the path to its centre from where it is settled,
/// over at most four faces. Points and lengths in the unit inside.
template <int N>
struct SimplexStringLabel {
  static constexpr std::size_t most = 4;

  std::array<double, N> source;  ///< of the string: the domain's source, or a bend long past
  double sigma;                  ///< walked up to there
  double centre;                 ///< distance of the centre
  std::array<double, N - 2> along[most];  ///< where it bends on the faces
  Index face[most];
  Index bends;
  float nudge[N];  ///< by so many clearances (FlatDomain) the string is held off its source
};

/// What a vertex of a flat domain knows: the shortest way to it that was found.
template <int N>
struct SimplexVertexWay {
  SimplexStringLabel<N> label;  ///< of that way at the centre of a simplex around
  double distance;              ///< of the vertex
  double seen;                  ///< what the simplices around knew when they were last asked
  Index simplex;
  Index source;
  bool is_new;  ///< or what is around is: others are still to be told

  void forget() {
    distance = std::numeric_limits<double>::infinity();
    seen = 0;
    source = none;
    is_new = false;
  }
};

/// A simplex that might gain by a vertex's way: its centre, or only a corner?
struct SimplexWanted {
  Index simplex;
  bool centre;
};

/// A vertex next to the one that tells, in one of the simplices that may hear of it, and whether it
/// would gain.
struct SimplexHearer {
  Index vertex, simplex;
  bool gains;
};

/// Lists that vertices need to tell others, kept from solve to solve.
template <int N>
struct SimplexTelling {
  std::vector<Index> waiting;
  // Around one vertex, by simplex: the way there, and whether it came there.
  struct Around {
    SimplexStringLabel<N> label;
    bool seen;
  };
  std::vector<Around> star;
  std::vector<std::size_t> line;       // in which order
  std::vector<SimplexWanted> wanted;   // those that might gain by it
  std::vector<SimplexHearer> hearers;  // their corners, by number
};

/// Labels, and ways of vertices, for whichever dimension a domain has and whichever rule is asked;
/// only these take room.
template <class Real>
class SimplexLabels {
 public:
  template <class Label>
  Label* reserve(std::size_t count) {
    return std::get<LabelStorage<Label>>(storage_).reserve(count);
  }
  template <int N>
  SimplexTelling<N>& telling() {
    return std::get<SimplexTelling<N>>(telling_);
  }
  [[nodiscard]] std::size_t bytes() const {
    return std::apply([](const auto&... s) { return (s.bytes() + ...); }, storage_);
  }

 private:
  template <int N>
  using Plain = LabelStorage<SimplexLabel<Real, N>>;
  template <int N>
  using String = LabelStorage<SimplexStringLabel<N>>;
  template <int N>
  using Way = LabelStorage<SimplexVertexWay<N>>;
  std::tuple<Plain<1>, Plain<2>, Plain<3>, Plain<4>, String<2>, String<3>, String<4>, Way<2>,
             Way<3>, Way<4>>
      storage_;
  std::tuple<SimplexTelling<2>, SimplexTelling<3>, SimplexTelling<4>> telling_;
};

}  // namespace plexway

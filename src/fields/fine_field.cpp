#include <plexway/fields/fine_field.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "fields/level_sets.hpp"

namespace plexway {
using namespace detail;
namespace {

constexpr unsigned most_parts_of_edge = 16;

/// The edges of faces, each once.
struct Edges {
  std::vector<std::array<Index, 2>> ends;      ///< the lesser vertex first
  std::vector<std::array<Index, 2>> beside;    ///< one of its faces, and the edge's place there
  std::vector<std::array<Index, 3>> of_faces;  ///< edge i of a face is that behind corner i

  explicit Edges(std::span<const std::array<Index, 3>> faces) : of_faces(faces.size()) {
    struct Side {
      Index v, w, face, place;
    };
    std::vector<Side> all;
    all.reserve(3 * faces.size());
    for (Index f = 0; f < faces.size(); ++f)
      for (Index i = 0; i < 3; ++i) {
        const Index a = faces[f][i], b = faces[f][(i + 1) % 3];
        all.push_back({std::min(a, b), std::max(a, b), f, i});
      }
    std::sort(all.begin(), all.end(), [](const Side& a, const Side& b) {
      return std::tie(a.v, a.w, a.face) < std::tie(b.v, b.w, b.face);
    });
    for (const auto& [v, w, face, place] : all) {
      if (ends.empty() || ends.back() != std::array{v, w}) {
        ends.push_back({v, w});
        beside.push_back({face, place});
      }
      of_faces[face][place] = static_cast<Index>(ends.size() - 1);
    }
  }
};

/// Point number t of n on an edge of a face, from the lesser vertex on, by weights times n.
std::array<std::uint8_t, 3> along(const std::array<Index, 3>& face, Index place, unsigned t,
                                  unsigned n) {
  const std::size_t i = place, j = (place + 1) % 3;
  std::array<std::uint8_t, 3> weights{};
  weights[face[i] < face[j] ? i : j] = static_cast<std::uint8_t>(n - t);
  weights[face[i] < face[j] ? j : i] = static_cast<std::uint8_t>(t);
  return weights;
}

std::array<double, 4> shares(const std::array<std::uint8_t, 3>& weights, unsigned n) {
  return {weights[0] / double(n), weights[1] / double(n), weights[2] / double(n), 0};
}

}  // namespace

FineField fine_field(const GivenPoints& positions, const GivenSimplices<3>& faces,
                     const Given<double>& distance, const DistanceInside& at,
                     const FineOptions& options) {
  check_level_sets(positions.size(), std::span(faces), distance, options.values, "face", "isoline");
  if (!(options.tolerance > 0)) throw UsageError("the tolerance of a fine field must be > 0");
  std::vector<double> values(options.values.begin(), options.values.end());
  std::sort(values.begin(), values.end());
  std::vector<std::array<Index, 3>> whole;
  std::vector<Index> number;  // of each among those given
  for (Index f = 0; f < faces.size(); ++f) {
    const auto& [a, b, c] = faces[f];
    if (a == b || b == c || c == a) continue;
    whole.push_back(faces[f]);
    number.push_back(f);
  }
  const Edges edges(whole);
  std::vector<double> middle(edges.ends.size()), bend(edges.ends.size());
  for (std::size_t e = 0; e < middle.size(); ++e) {
    const auto [face, place] = edges.beside[e];
    const auto [v, w] = edges.ends[e];
    middle[e] = at(number[face], shares(along(whole[face], place, 1, 2), 2));
    bend[e] = std::abs(middle[e] - (distance[v] + distance[w]) / 2);
  }

  // Faces where one of the values is, and how far off linear would be in them.
  std::vector<Index> taken;
  double worst = 0;
  for (Index f = 0; f < whole.size(); ++f) {
    double low = distance[whole[f][0]], high = low, off = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double corner = distance[whole[f][i]], between = middle[edges.of_faces[f][i]];
      low = std::min({low, corner, between});
      high = std::max({high, corner, between});
      if (std::isfinite(bend[edges.of_faces[f][i]]))
        off = std::max(off, bend[edges.of_faces[f][i]]);
    }
    const auto next = std::lower_bound(values.begin(), values.end(), low - off);
    if (!values.empty() && (next == values.end() || *next > high + off)) continue;
    taken.push_back(f);
    worst = std::max(worst, off);
  }
  FineField fine;
  unsigned n = 1;
  while (n < most_parts_of_edge && worst > options.tolerance * (n * n) &&
         taken.size() * (4 * n * n) <= options.most)
    n *= 2;
  fine.parts = n;
  fine.positions.assign(positions.begin(), positions.end());
  fine.distance.assign(distance.begin(), distance.end());

  // A vertex is numbered where it is first met; those on an edge belong to all its faces.
  std::vector<Index> first_on(edges.ends.size(), none);
  const auto add = [&](Index f, const std::array<std::uint8_t, 3>& weights) {
    std::array<double, 3> place{};
    const auto share = shares(weights, n);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) place[k] += share[i] * positions[whole[f][i]][k];
    fine.positions.push_back(place);
    fine.distance.push_back(at(number[f], share));
    return static_cast<Index>(fine.positions.size() - 1);
  };
  std::vector<Index> inside((n + 1) * (n + 1));
  for (const Index f : taken) {
    for (Index i = 0; i < 3; ++i) {
      const Index e = edges.of_faces[f][i];
      if (first_on[e] != none || n == 1) continue;
      for (unsigned t = 1; t < n; ++t) {
        const Index v = add(f, along(whole[f], i, t, n));
        if (t == 1) first_on[e] = v;
      }
    }
    // By the weights of corners 1 and 2.
    const auto vertex = [&](unsigned b, unsigned c) -> Index& { return inside[b * (n + 1) + c]; };
    const auto on_edge = [&](Index i, unsigned t) {  // t steps from corner i to the next
      const Index from = whole[f][i], to = whole[f][(i + 1) % 3];
      return first_on[edges.of_faces[f][i]] + (from < to ? t : n - t) - 1;
    };
    for (unsigned b = 0; b <= n; ++b)
      for (unsigned c = 0; b + c <= n; ++c) {
        const unsigned a = n - b - c;
        const auto step = [](unsigned x) { return static_cast<std::uint8_t>(x); };
        vertex(b, c) = a == n   ? whole[f][0]
                       : b == n ? whole[f][1]
                       : c == n ? whole[f][2]
                       : c == 0 ? on_edge(0, b)
                       : a == 0 ? on_edge(1, c)
                       : b == 0 ? on_edge(2, a)
                                : add(f, {step(a), step(b), step(c)});
      }
    const auto put = [&](std::array<std::array<unsigned, 2>, 3> corners) {
      std::array<Index, 3> face;
      std::array<std::array<std::uint8_t, 3>, 3> place;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [b, c] = corners[i];
        face[i] = vertex(b, c);
        place[i] = {static_cast<std::uint8_t>(n - b - c), static_cast<std::uint8_t>(b),
                    static_cast<std::uint8_t>(c)};
      }
      fine.faces.push_back(face);
      fine.parent.push_back(number[f]);
      fine.place.push_back(place);
    };
    for (unsigned b = 0; b < n; ++b)
      for (unsigned c = 0; b + c < n; ++c) {
        put({{{b, c}, {b + 1, c}, {b, c + 1}}});
        if (b + c + 1 < n) put({{{b + 1, c}, {b + 1, c + 1}, {b, c + 1}}});
      }
  }
  return fine;
}

}  // namespace plexway

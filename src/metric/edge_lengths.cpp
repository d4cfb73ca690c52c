#include <plexway/metric/edge_lengths.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include <plexway/domain/support.hpp>
#include <plexway/error.hpp>

namespace plexway::metric {
namespace {

template <std::size_t Corners>
constexpr std::size_t edges_of = Corners*(Corners - 1) / 2;

// The corners of each edge, in the order that the complex of that dimension takes, and its name.
template <std::size_t Corners>
struct Ends;
template <>
struct Ends<2> {
  static constexpr auto of = simplex_edges<2>;
  static constexpr std::string_view simplex = "edge";
};
template <>
struct Ends<3> {
  static constexpr auto of = triangle_edges;
  static constexpr std::string_view simplex = "triangle";
};
template <>
struct Ends<4> {
  static constexpr auto of = simplex_edges<4>;
  static constexpr std::string_view simplex = "tetrahedron";
};

template <std::size_t Corners>
using Rows = std::vector<std::array<double, edges_of<Corners>>>;

Point step(const Point& a, const Point& b) { return {b[0] - a[0], b[1] - a[1], b[2] - a[2]}; }

[[noreturn]] void not_positive(std::string_view what, std::size_t number, const Point& d) {
  throw InputError(std::string(what) + " " + std::to_string(number) +
                   ": its tensor gives the step (" + std::to_string(d[0]) + ", " +
                   std::to_string(d[1]) + ", " + std::to_string(d[2]) +
                   ") no positive length; tensors must be positive definite");
}

// An edge between points at the same place has no length under any tensor.
double tensor_length(const Tensor& tensor, const Point& d, std::string_view what,
                     std::size_t number) {
  const double squared = tensor.squared(d);
  const bool is_step = d[0] != 0 || d[1] != 0 || d[2] != 0;
  if (!std::isfinite(squared) || squared < 0 || (squared == 0 && is_step))
    not_positive(what, number, d);
  return std::sqrt(squared);
}

// The integral of sqrt over what is linear from a^2 to b^2.
double linear_between(double a, double b) {
  return a + b > 0 ? 2. / 3 * (a * a + a * b + b * b) / (a + b) : 0;
}

void check_count(std::size_t given, std::size_t needed, std::string_view of, std::string_view a) {
  if (given != needed)
    throw InputError(std::to_string(given) + " " + std::string(of) + " for " +
                     std::to_string(needed) + " " + std::string(a));
}

std::uint64_t key(Index a, Index b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

// One length for all simplices that share an edge. Simplices that measure it alike keep their bits.
template <std::size_t Corners>
void agree(std::span<const std::array<Index, Corners>> simplices, const Agreement& agreement,
           Rows<Corners>& rows) {
  if constexpr (Corners > 2) {
    struct Side {
      std::uint64_t edge;
      double* length;
    };
    std::vector<Side> all;
    all.reserve(simplices.size() * edges_of<Corners>);
    for (std::size_t s = 0; s < simplices.size(); ++s)
      for (std::size_t e = 0; e < edges_of<Corners>; ++e) {
        const auto [i, j] = Ends<Corners>::of[e];
        all.push_back({key(simplices[s][i], simplices[s][j]), &rows[s][e]});
      }
    std::sort(all.begin(), all.end(), [](const Side& a, const Side& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.length < b.length;
    });
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
      double least = std::numeric_limits<double>::infinity(), most = 0, sum = 0;
      for (end = begin; end < all.size() && all[end].edge == all[begin].edge; ++end) {
        least = std::min(least, *all[end].length);
        most = std::max(most, *all[end].length);
        sum += *all[end].length;
      }
      if (least == most) continue;
      if (agreement.sides == Sides::own && most - least > agreement.jump * most) continue;
      const double agreed =
          agreement.sides == Sides::least ? least : sum / static_cast<double>(end - begin);
      for (std::size_t i = begin; i < end; ++i) *all[i].length = agreed;
    }
  }
}

template <std::size_t Corners>
void check_speeds(const std::vector<double>& speed, std::size_t simplices) {
  check_count(speed.size(), simplices, "speeds", "simplices");
  for (std::size_t s = 0; s < simplices; ++s)
    if (!(speed[s] > 0) || !std::isfinite(speed[s]))
      throw InputError(std::string(Ends<Corners>::simplex) + " " + std::to_string(s) +
                       ": its speed is not a positive number");
}

template <std::size_t Corners>
class Measure {
 public:
  using Simplices = std::span<const std::array<Index, Corners>>;

  Measure(std::span<const Point> positions, Simplices simplices)
      : positions_(positions), simplices_(simplices), rows_(simplices.size()) {
    for (std::size_t s = 0; s < simplices.size(); ++s)
      for (const Index v : simplices[s])
        if (v >= positions.size())
          throw InputError(std::string(Ends<Corners>::simplex) + " " + std::to_string(s) +
                           ": vertex " + std::to_string(v) + " is out of range, there are " +
                           std::to_string(positions.size()));
  }

  Rows<Corners> rows() { return std::move(rows_); }

  void operator()(const SimplexTensors& metric) {
    check_count(metric.tensor.size(), simplices_.size(), "tensors", "simplices");
    each_edge([&](std::size_t s, Index a, Index b) {
      return tensor_length(metric.tensor[s], step(positions_[a], positions_[b]),
                           Ends<Corners>::simplex, s);
    });
    agree<Corners>(simplices_, metric.agreement, rows_);
  }

  void operator()(const SimplexSpeeds& metric) {
    check_speeds<Corners>(metric.speed, simplices_.size());
    each_edge([&](std::size_t s, Index a, Index b) {
      const Point d = step(positions_[a], positions_[b]);
      return std::hypot(d[0], d[1], d[2]) / metric.speed[s];
    });
    agree<Corners>(simplices_, metric.agreement, rows_);
  }

  void operator()(const VertexTensors& metric) {
    check_count(metric.tensor.size(), positions_.size(), "tensors", "vertices");
    each_edge([&](std::size_t, Index a, Index b) {
      const Point d = step(positions_[a], positions_[b]);
      return linear_between(tensor_length(metric.tensor[a], d, "vertex", a),
                            tensor_length(metric.tensor[b], d, "vertex", b));
    });
  }

  void operator()(const TensorFunction& metric) {
    constexpr double out = 0.3872983346207417;  // half the root of 3 / 5
    constexpr double weight = 5. / 18;
    each_edge([&](std::size_t s, Index a, Index b) {
      const Point &p = positions_[a], &q = positions_[b], d = step(p, q);
      const auto at = [&](double t) {
        const Point x = {p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]};
        return tensor_length(metric.at(x), d, Ends<Corners>::simplex, s);
      };
      return weight * (at(0.5 - out) + at(0.5 + out)) + (1 - 2 * weight) * at(0.5);
    });
  }

  void operator()(const LengthFunction& metric) {
    each_edge([&](std::size_t, Index a, Index b) {
      return metric.between(positions_[a], positions_[b]);
    });
  }

  void operator()(const GivenLengths& metric) {
    std::vector<std::pair<std::uint64_t, double>> given;
    given.reserve(metric.edges.size());
    for (const auto& edge : metric.edges) given.emplace_back(key(edge.from, edge.to), edge.length);
    std::stable_sort(given.begin(), given.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    each_edge([&](std::size_t s, Index a, Index b) {
      auto found = std::upper_bound(given.begin(), given.end(), key(a, b),
                                    [](std::uint64_t k, const auto& row) { return k < row.first; });
      if (found == given.begin() || (--found)->first != key(a, b))
        throw InputError("no length is given for the edge " + std::to_string(a) + " - " +
                         std::to_string(b) + " of " + std::string(Ends<Corners>::simplex) + " " +
                         std::to_string(s));
      return found->second;
    });
  }

 private:
  // The same way from both sides, so that both get the same bits.
  template <class Length>
  void each_edge(Length of) {
    for (std::size_t s = 0; s < simplices_.size(); ++s)
      for (std::size_t e = 0; e < edges_of<Corners>; ++e) {
        const auto [i, j] = Ends<Corners>::of[e];
        const auto [a, b] = std::minmax(simplices_[s][i], simplices_[s][j]);
        const double l = of(s, a, b);
        if (!std::isfinite(l) || l < 0)
          throw InputError("the edge " + std::to_string(a) + " - " + std::to_string(b) + " of " +
                           std::string(Ends<Corners>::simplex) + " " + std::to_string(s) +
                           ": its length is negative or not finite");
        rows_[s][e] = l;
      }
  }

  std::span<const Point> positions_;
  Simplices simplices_;
  Rows<Corners> rows_;
};

template <std::size_t Corners>
Rows<Corners> measured(std::span<const Point> positions,
                       std::span<const std::array<Index, Corners>> simplices,
                       const Metric& metric) {
  Measure<Corners> measure(positions, simplices);
  std::visit(measure, metric);
  return measure.rows();
}

bool closes(double a, double b, double c) {
  const double longest = std::max({a, b, c});
  return longest - (a + b + c - longest) <= 1e-14 * longest;
}

// Are the fourth corner's distances from a triangle those of a point in space?
bool closes(const std::array<double, 6>& l) {
  if (!closes(l[0], l[1], l[2]) || !closes(l[0], l[3], l[4]) || !closes(l[1], l[3], l[5]) ||
      !closes(l[2], l[4], l[5]))
    return false;
  // Gram's determinant of the edges from corner 0, each of unit length.
  if (l[0] == 0 || l[1] == 0 || l[3] == 0) return true;
  const auto cosine = [](double a, double b, double across) {
    return (a * a + b * b - across * across) / (2 * a * b);
  };
  const double u = cosine(l[0], l[1], l[2]), v = cosine(l[0], l[3], l[4]),
               w = cosine(l[1], l[3], l[5]);
  return 1 + 2 * u * v * w - u * u - v * v - w * w >= -1e-12;
}

template <class Row, class Closes>
Violations violations(std::span<const Row> rows, Closes are_closed) {
  Violations found;
  for (std::size_t s = 0; s < rows.size(); ++s)
    if (!are_closed(rows[s]) && found.count++ == 0) found.first = static_cast<Index>(s);
  return found;
}

}  // namespace

std::vector<std::array<double, 3>> triangle_lengths(std::span<const Point> positions,
                                                    std::span<const std::array<Index, 3>> triangles,
                                                    const Metric& metric) {
  return measured<3>(positions, triangles, metric);
}

std::vector<std::array<double, 3>> triangle_times(std::span<const std::array<double, 3>> lengths,
                                                  std::span<const std::array<Index, 3>> triangles,
                                                  const SimplexSpeeds& metric) {
  check_speeds<3>(metric.speed, triangles.size());
  Rows<3> rows(lengths.begin(), lengths.end());
  for (std::size_t s = 0; s < rows.size(); ++s)
    for (double& length : rows[s]) length /= metric.speed[s];
  agree<3>(triangles, metric.agreement, rows);
  return rows;
}

std::vector<std::array<double, 6>> tet_lengths(std::span<const Point> positions,
                                               std::span<const std::array<Index, 4>> tets,
                                               const Metric& metric) {
  const auto own = [](const auto& m) {
    if constexpr (requires { m.agreement; }) return m.agreement.sides == Sides::own;
    return false;
  };
  if (std::visit(own, metric)) support_of_own_sides(DomainKind::solid).require();
  return measured<4>(positions, tets, metric);
}

std::vector<double> edge_lengths(std::span<const Point> positions,
                                 std::span<const std::array<Index, 2>> edges,
                                 const Metric& metric) {
  const Rows<2> rows = measured<2>(positions, edges, metric);
  std::vector<double> lengths(rows.size());
  for (std::size_t e = 0; e < rows.size(); ++e) lengths[e] = rows[e][0];
  return lengths;
}

Violations find_violations(std::span<const std::array<double, 3>> lengths) {
  return violations(lengths, [](const auto& l) { return closes(l[0], l[1], l[2]); });
}

Violations find_violations(std::span<const std::array<double, 6>> lengths) {
  return violations(lengths, [](const auto& l) { return closes(l); });
}

}  // namespace plexway::metric

#include <array>
#include <cmath>
#include <span>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/common/distinct_points.hpp>
#include <plexway/error.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/shape/support.hpp>

#include "shape/shape_state.hpp"
#include "shape/words.hpp"

namespace plexway {
using namespace detail;

namespace detail {

namespace {

using Place = std::array<double, 3>;

struct CellHash {
  std::size_t operator()(const Place& cell) const {
    std::size_t sum = 0;
    for (const double x : cell) sum = (sum ^ std::hash<double>{}(x)) * 0x9e3779b97f4a7c15U;
    return sum ^ (sum >> 32U);
  }
};

// Points that are kept lie more than `tolerance` apart, so few share a cube of that side.
std::vector<Index> first_within(std::span<const Place> points, double tolerance) {
  std::unordered_map<Place, std::vector<Index>, CellHash> cells;
  std::vector<Index> first(points.size());
  const auto cell_of = [&](const Place& p, int i, int j, int k) -> Place {
    return {std::floor(p[0] / tolerance) + i, std::floor(p[1] / tolerance) + j,
            std::floor(p[2] / tolerance) + k};
  };
  for (Index v = 0; v < points.size(); ++v) {
    const Place& p = points[v];
    first[v] = v;
    for (int n = 0; n < 27; ++n) {
      const auto found = cells.find(cell_of(p, n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1));
      if (found == cells.end()) continue;
      for (const Index w : found->second) {
        const Place& q = points[w];
        if (w < first[v] && std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= tolerance)
          first[v] = w;
      }
    }
    if (first[v] == v) cells[cell_of(p, 0, 0, 0)].push_back(v);
  }
  return first;
}

}  // namespace

void merge_vertices(AnyShape::State& state, double tolerance) {
  if (!(tolerance >= 0) || std::isinf(tolerance)) throw UsageError("merge must be a number >= 0");
  const auto merge = [&](auto& simplices, const std::vector<Place>& positions) {
    if (positions.empty())
      support(Reading::merging,
              {.held = DomainKind::wireframe, .wanted = DomainKind::wireframe, .positions = false})
          .require();
    std::vector<Index> first =
        tolerance > 0 ? first_within(positions, tolerance) : distinct_points(positions).first;
    bool any = false;
    for (Index v = 0; v < first.size() && !any; ++v) any = first[v] != v;
    if (!any) return;
    for (auto& corners : simplices)
      for (auto& v : corners) v = first[v];
    state.merged = std::move(first);
    state.merge_tolerance = tolerance;
  };
  std::visit(
      [&](auto& data) {
        if constexpr (requires { data.triangles; }) {
          merge(data.triangles, data.positions);
        } else if constexpr (requires { data.tets; }) {
          merge(data.tets, data.positions);
        } else if constexpr (requires { data.edges; }) {
          merge(data.edges, data.positions);
        }
      },
      state.data);
}

}  // namespace detail

AnyShape AnyShape::merged(double tolerance) const {
  support(Reading::merging, {.held = kind(), .wanted = kind(), .positions = !positions().empty()})
      .require();
  State state = *state_;
  state.data = data();
  state.kept = nullptr;
  merge_vertices(state, tolerance);
  return of(std::move(state));
}

std::span<const Index> AnyShape::merged_vertices() const { return state_->merged; }
double AnyShape::merge_tolerance() const { return state_->merge_tolerance; }
std::size_t AnyShape::merged_count() const {
  std::size_t count = 0;
  for (Index v = 0; v < state_->merged.size(); ++v) count += state_->merged[v] != v;
  return count;
}

namespace detail {

namespace {

bool has_twice(std::span<const Index> corners) {
  for (std::size_t i = 1; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (corners[i] == corners[j]) return true;
  return false;
}

}  // namespace

void find_collapsed(AnyShape::State& state) {
  Index number = 0;
  for (const io::Cells& cells : state.cells) {
    const bool edges =
        state.data.index() != static_cast<std::size_t>(DomainKind::simplices) && cells.corners == 2;
    for (std::size_t c = 0; c < cells.count(); ++c, ++number)
      if (!edges && has_twice(cells.connectivity.subspan(c * cells.corners, cells.corners)))
        state.collapsed.push_back(number);
  }
}

std::string collapsed_sentence(const AnyShape& shape) {
  const auto collapsed = shape.collapsed();
  if (collapsed.empty()) return "";
  const std::string first = std::to_string(collapsed.front());
  return counted(collapsed.size(), shape.simplex_name()) +
         (collapsed.size() == 1
              ? " (" + first + ") has a corner twice and is left out"
              : " (" + first + " is the first) have a corner twice and are left out");
}

}  // namespace detail

std::shared_ptr<const Mask> without_collapsed(const AnyShape& shape,
                                              std::shared_ptr<const Mask> mask) {
  const std::span<const Index> first = shape.merged_vertices();
  if (mask && !first.empty() && mask->closed_vertices().size() == first.size()) {
    // Whoever closes one of the vertices that are one closes the place.
    auto whole = std::make_shared<Mask>(*mask);
    for (Index v = 0; v < first.size(); ++v)
      if (mask->closed_vertices()[v] != 0) whole->close_vertex(first[v]);
    mask = std::move(whole);
  }
  if (shape.collapsed().empty()) return mask;
  if (shape.collapsed().size() == shape.simplices())
    throw InputError("all " + counted(shape.simplices(), shape.simplex_name()) +
                     " have a corner twice: there is nothing to go along");
  auto open = mask ? std::make_shared<Mask>(*mask)
                   : std::make_shared<Mask>(shape.vertices(), shape.simplices());
  for (const Index simplex : shape.collapsed()) open->close_simplex(simplex);
  return open;
}

}  // namespace plexway

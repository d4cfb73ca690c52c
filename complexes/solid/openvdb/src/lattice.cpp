#include "lattice.hpp"

#include <algorithm>
#include <cmath>

#include <plexway/error.hpp>

#include "answer.hpp"

namespace plexway::openvdb {
namespace {

// A cut nearer than this share of its edge to a point moves the point: the shares with the best
// guarantee on angles (Labelle and Shewchuk 2007, section 3).
constexpr double near_on_long = 0.24999;
constexpr double near_on_short = 0.41189;

constexpr std::array<Cell, Lattice::directions> make_steps() {
  std::array<Cell, Lattice::directions> steps{};
  for (std::int32_t d = 0; d < 8; ++d)
    steps[static_cast<std::size_t>(d)] = {(d & 1) != 0 ? 1 : -1, (d & 2) != 0 ? 1 : -1,
                                          (d & 4) != 0 ? 1 : -1};
  for (std::size_t d = 8; d < steps.size(); ++d) steps[d][(d - 8) / 2] = d % 2 == 0 ? -2 : 2;
  return steps;
}

}  // namespace

const std::array<Cell, Lattice::directions> Lattice::steps = make_steps();

Lattice::Lattice(const Bricks& bricks, double spacing) : level_set_(bricks), spacing_(spacing) {
  choose_bricks(bricks);
  evaluate(bricks);
  move_near_points();
}

// All bricks with points inside or beside one: the function is negative at most a voxel beyond a
// voxel where it is.
void Lattice::choose_bricks(const Bricks& bricks) {
  constexpr std::size_t most = std::size_t{1} << 22;  // Point counts so many
  const double side = std::cbrt(std::abs(bricks.frame.determinant()));
  const auto too_many = [&] {
    throw UsageError("the spacing " + text_of(spacing_ * side) +
                     " is too small: more than 2^31 lattice cells; choose a larger one");
  };
  BrickNumbers found;
  for (std::size_t b = 0; b < bricks.numbers.size(); ++b) {
    Cell low = {8, 8, 8}, high = {-1, -1, -1};
    if (bricks.block[b] == Bricks::inside) {
      low = {0, 0, 0};
      high = {7, 7, 7};
    } else {
      const float* const values = &bricks.values[std::size_t{bricks.block[b]} * 512];
      for (std::int32_t i = 0; i < 512; ++i) {
        if (!(values[i] < 0)) continue;
        const Cell at = {i >> 6, i >> 3 & 7, i & 7};
        for (std::size_t k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], at[k]);
          high[k] = std::max(high[k], at[k]);
        }
      }
    }
    if (high[0] < 0) continue;
    Cell first, last;
    for (std::size_t k = 0; k < 3; ++k) {
      const double corner = 8.0 * bricks.numbers.corners()[b][k];
      const double from = std::floor(((corner + low[k] - 1) / spacing_ - 1) / 8);
      const double to = std::floor(((corner + high[k] + 1) / spacing_ + 1) / 8);
      if (std::max(std::abs(from), std::abs(to)) >= BrickNumbers::far - 1)
        throw UsageError("the spacing " + text_of(spacing_ * side) +
                         " is too small for a level set so far from the origin of its grid");
      first[k] = static_cast<std::int32_t>(from);
      last[k] = static_cast<std::int32_t>(to);
    }
    double count = 1;
    for (std::size_t k = 0; k < 3; ++k) count *= 1.0 + last[k] - first[k];
    if (count > static_cast<double>(most)) too_many();
    for (std::int32_t x = first[0]; x <= last[0]; ++x)
      for (std::int32_t y = first[1]; y <= last[1]; ++y)
        for (std::int32_t z = first[2]; z <= last[2]; ++z)
          if (found.add({x, y, z}).first >= most) too_many();
  }
  // In an order that does not depend on how the tree was built.
  std::vector<Cell> sorted = found.corners();
  std::sort(sorted.begin(), sorted.end());
  for (const Cell& corner : sorted) numbers_.add(corner);
}

Vector Lattice::at_rest(Point p) const {
  const Cell& corner = numbers_.corners()[p >> 10];
  const Cell at = doubled(p & 1023);
  Vector place;
  for (std::size_t k = 0; k < 3; ++k) place[k] = spacing_ * (8.0 * corner[k] + 0.5 * at[k]);
  return place;
}

void Lattice::evaluate(const Bricks& bricks) {
  value_.resize(points());
  side_.resize(points());
  all_inside_.resize(this->bricks());
  Lookup lookup(bricks);
  for (std::uint32_t b = 0; b < this->bricks(); ++b) {
    bool all = true;
    for (Point p = b << 10; p < (b + 1) << 10; ++p) {
      const auto value = static_cast<float>(lookup.at(at_rest(p)));
      value_[p] = value;
      side_[p] = value < 0 ? -1 : value > 0 ? 1 : 0;
      all = all && value < 0;
    }
    all_inside_[b] = all;
  }
}

Lattice::Around Lattice::around(std::uint32_t brick) const {
  Around numbers;
  const Cell& corner = numbers_.corners()[brick];
  std::size_t n = 0;
  for (std::int32_t x = -1; x <= 1; ++x)
    for (std::int32_t y = -1; y <= 1; ++y)
      for (std::int32_t z = -1; z <= 1; ++z)
        numbers[n++] = numbers_.find({corner[0] + x, corner[1] + y, corner[2] + z});
  return numbers;
}

bool Lattice::deep(const Around& around) const {
  return std::all_of(around.begin(), around.end(), [&](std::uint32_t b) {
    return b != BrickNumbers::none && all_inside_[b] != 0;
  });
}

// The function is not linear along the edge: between voxels it is of third degree.
double Lattice::share_to_crossing(Point inside, Point outside, const Vector& a,
                                  const Vector& b) const {
  Lookup lookup(level_set_);
  double low = 0, high = 1, at_low = value_[inside], at_high = value_[outside];
  double share = at_low / (at_low - at_high);
  for (int i = 0; i < 3; ++i) {
    Vector p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + share * (b[k] - a[k]);
    const double value = lookup.at(p);
    (value < 0 ? low : high) = share;
    (value < 0 ? at_low : at_high) = value;
    if (value == 0 || !(at_low < at_high)) break;
    share = low + (high - low) * (at_low / (at_low - at_high));
  }
  return share;
}

void Lattice::move_near_points() {
  for (std::uint32_t b = 0; b < bricks(); ++b) {
    const Around beside = around(b);
    if (deep(beside)) continue;
    for (std::uint32_t local = 0; local < 1024; ++local) {
      const Point p = b << 10 | local;
      const int own = side_[p];
      if (own == 0) continue;
      const Cell from = doubled(local);
      double least = 2;
      Vector nearest{};
      for (std::size_t d = 0; d < directions; ++d) {
        const Cell& step = steps[d];
        const Point q = at(beside, from[0] + step[0], from[1] + step[1], from[2] + step[2]);
        if (q == none || side_[q] != -own) continue;
        const Vector here = at_rest(p), there = at_rest(q);
        // From the inside, so that both ends agree to the last bit.
        const double share = own < 0 ? share_to_crossing(p, q, here, there)
                                     : 1 - share_to_crossing(q, p, there, here);
        if (!(share < (d < 8 ? near_on_short : near_on_long))) continue;
        const double distance = share * (d < 8 ? std::sqrt(0.75) : 1.0);
        if (distance >= least) continue;
        least = distance;
        for (std::size_t k = 0; k < 3; ++k) nearest[k] = here[k] + share * (there[k] - here[k]);
      }
      if (least > 1) continue;
      side_[p] = 0;
      moved_.emplace(p, nearest);
    }
  }
}

Vector Lattice::place(Point p) const {
  if (side_[p] == 0) {
    if (const auto found = moved_.find(p); found != moved_.end()) return found->second;
  }
  return at_rest(p);
}

Vector Lattice::crossing(Point inside, std::size_t direction) const {
  const Vector a = at_rest(inside);
  const Cell& corner = numbers_.corners()[inside >> 10];
  const Cell& step = steps[direction];
  const Cell from = doubled(inside & 1023);
  Cell brick;
  std::array<std::int32_t, 3> cell;
  Vector b;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t to = from[k] + step[k];
    b[k] = spacing_ * (8.0 * corner[k] + 0.5 * to);
    cell[k] = to >> 1;
    brick[k] = corner[k] + (cell[k] >> 3);
  }
  const bool centre = ((from[0] + step[0]) & 1) != 0;
  const Point outside =
      numbers_.find(brick) << 10 |
      static_cast<Point>(Bricks::offset(cell[0], cell[1], cell[2]) + (centre ? 512u : 0u));
  const double share = share_to_crossing(inside, outside, a, b);
  Vector p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + share * (b[k] - a[k]);
  return p;
}

}  // namespace plexway::openvdb

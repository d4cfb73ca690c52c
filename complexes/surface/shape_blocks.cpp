#include "complexes/surface/shape_blocks.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>

#include <plexway/error.hpp>

#include "complexes/surface/triangle_shape.hpp"

namespace plexway::detail {
namespace {

constexpr std::size_t size = ShapeBlock::size;
using Row = ShapeBlock::Row;
using Vectors = std::array<Row, 3>;  // x, y and z

// Edge i of each triangle, from corner i to the next. Places behind the last repeat it.
void gather(std::span<const std::array<double, 3>> positions,
            std::span<const std::array<Index, 3>> faces, std::span<const Index> listed,
            std::array<Vectors, 3>& edge) {
  std::array<Vectors, 3> corner;
  for (std::size_t k = 0; k < listed.size(); ++k) {
    const auto& f = faces[listed[k]];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& p = positions[f[i]];
      for (std::size_t d = 0; d < 3; ++d) corner[i][d][k] = p[d];
    }
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t k = listed.size(); k < size; ++k)
        corner[i][d][k] = corner[i][d][listed.size() - 1];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t k = 0; k < size; ++k)
        edge[i][d][k] = corner[(i + 1) % 3][d][k] - corner[i][d][k];
}

double larger(double a, double b) { return a < b ? b : a; }

// The same bits as std::hypot of three: scaled by the largest, so that nothing overflows.
void norms(const Vectors& v, Row& norm) {
  for (std::size_t k = 0; k < size; ++k) {
    const double x = std::abs(v[0][k]), y = std::abs(v[1][k]), z = std::abs(v[2][k]);
    const double most = larger(larger(x, y), z);
    const double by = most > 0 ? most : 1.0;
    const double p = x / by, q = y / by, r = z / by;
    norm[k] = by * std::sqrt(p * p + q * q + r * r);
  }
}

void put(const TriangleShape& shape, std::size_t k, ShapeBlock& block) {
  for (std::size_t i = 0; i < 3; ++i) {
    block.cosine[i][k] = shape.cosine[i];
    block.sine[i][k] = shape.sine[i];
  }
  block.degenerate[k] = shape.degenerate;
  block.violated[k] = shape.violated;
}

}  // namespace

void ShapesInSpace::look_up(std::span<const Index> faces, ShapeBlock& block) const {
  std::array<Vectors, 3> edge;
  gather(positions_, faces_, faces, edge);
  for (std::size_t i = 0; i < 3; ++i) norms(edge[i], block.length[i]);
  // Each corner by its own cross product: one for all would be off by rounding over the sharpest
  // sine. Nothing is scaled but the lengths: what is flat, long or short goes one by one.
  constexpr double flat = 1e-13, longest = 1e70, shortest = 1e-70;
  Row least, most;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vectors &u = edge[i], &w = edge[(i + 2) % 3];
    const Row &l = block.length[i], &m = block.length[(i + 2) % 3];
    for (std::size_t k = 0; k < size; ++k) {
      const double product = l[k] * m[k];
      const double x = u[1][k] * w[2][k] - u[2][k] * w[1][k];
      const double y = u[2][k] * w[0][k] - u[0][k] * w[2][k];
      const double z = u[0][k] * w[1][k] - u[1][k] * w[0][k];
      block.cosine[i][k] = -(u[0][k] * w[0][k] + u[1][k] * w[1][k] + u[2][k] * w[2][k]) / product;
      block.sine[i][k] = std::sqrt(x * x + y * y + z * z) / product;
    }
  }
  const auto smaller = [](double a, double b) { return b < a ? b : a; };
  for (std::size_t k = 0; k < size; ++k) {
    least[k] = smaller(smaller(block.sine[0][k], block.sine[1][k]), block.sine[2][k]);
    most[k] = larger(larger(block.length[0][k], block.length[1][k]), block.length[2][k]);
  }
  for (std::size_t k = 0; k < faces.size(); ++k) {
    block.degenerate[k] = block.violated[k] = false;
    if (least[k] > flat && most[k] < longest && most[k] > shortest) continue;
    const auto& f = faces_[faces[k]];
    put(shape_from_positions({&positions_[f[0]], &positions_[f[1]], &positions_[f[2]]}), k, block);
  }
}

void ShapesOfLengths::look_up(std::span<const Index> faces, ShapeBlock& block) const {
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const auto& lengths = lengths_[faces[k]];
    for (std::size_t i = 0; i < 3; ++i) block.length[i][k] = lengths[i];
    put(shape_from_lengths(lengths), k, block);
    block.violated[k] = violated_[faces[k]] != 0;
  }
}

void check_length(Index face, std::span<const double, 3> lengths) {
  const double a = lengths[0], b = lengths[1], c = lengths[2];
  if (std::isfinite(a + b + c) || (std::isfinite(a) && std::isfinite(b) && std::isfinite(c)))
    return;
  throw InputError("face " + std::to_string(face) + ": too long for a number");
}

void angles_of(const ShapeBlock& block, std::array<Row, 3>& angle) {
  // By half angles: tan(angle / 2) = sin / (1 + cos), of the acute one of two supplements, and pi /
  // 8 less where that is more. The odd polynomial is off by less than a rounding error.
  constexpr double eighth = 0.41421356237309503;  // tan(pi / 8)
  constexpr std::array<double, 10> series = {
      -0.3333333333333325,   0.19999999999898407, -0.14285714266096602, 0.11111109636533431,
      -0.09090852557145968,  0.07691055157849669, -0.06649613689550408, 0.05736332130703195,
      -0.044833345062807464, 0.022750525406052224};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < size; ++k) {
      const double s = block.sine[i][k], c = block.cosine[i][k];
      const double base = 1 + std::abs(c);
      const bool large = s > eighth * base;
      const double t = (large ? s - base : s) / (large ? s + base : base);
      const double z = t * t;
      double p = series[9];
      for (std::size_t n = 9; n-- > 0;) p = p * z + series[n];
      const double half = (t + t * z * p) + (large ? std::numbers::pi / 4 : 0.0);
      angle[i][k] = c < 0 ? std::numbers::pi - 2 * half : 2 * half;
    }
}

template <class Real>
void round_angles(const ShapeBlock& block, RoundedAngles<Real>& rounded) {
  // Of the numbers next to both, the pair that misses least, or they themselves. Which of the pairs
  // on the other side make it worse is known: those are left out, and six remain. A pair's number
  // takes the last bits of its miss, so that a minimum finds both. Of equal ones, as at 45 degrees,
  // the least cosine counts, then the least sine.
  constexpr Real step = std::numeric_limits<Real>::epsilon() * Real(0.75);
  enum : std::uint64_t { neither = 0, other_both = 8, sine_only, both_other, cosine_only, both };
  constexpr std::uint64_t code_mask = 15, sign = std::uint64_t{1} << 63;
  // By code, and by its complement, which it is where the right way is down: 0 the number itself, 1
  // the next the right way, 2 the other way.
  constexpr std::array<std::uint8_t, 16> which_cosine = {0, 0, 0, 1, 1, 1, 0, 2,
                                                         2, 0, 1, 1, 1, 0, 0, 0};
  constexpr std::array<std::uint8_t, 16> which_sine = {0, 0, 0, 1, 0, 2, 1, 1,
                                                       1, 1, 2, 0, 1, 0, 0, 0};
  using Numbers = std::array<Real, size>;
  std::array<Numbers, 3> cosine, sine;
  std::array<std::uint64_t, size> codes;
  Numbers way;
  const auto over = [](double c) { return (c - 1) * (c + 1); };  // cos^2 - 1
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < size; ++k) {
      cosine[0][k] = static_cast<Real>(block.cosine[i][k]);
      sine[0][k] = static_cast<Real>(block.sine[i][k]);
    }
    for (std::size_t k = 0; k < size; ++k) {
      const double c = static_cast<double>(cosine[0][k]), s = static_cast<double>(sine[0][k]);
      const bool down = over(c) + s * s > 0;
      way[k] = down ? -step : step;
      codes[k] = down ? code_mask : 0;
    }
    for (std::size_t k = 0; k < size; ++k) {
      const Real dc = cosine[0][k] * way[k], ds = sine[0][k] * way[k];
      cosine[1][k] = cosine[0][k] + dc, cosine[2][k] = cosine[0][k] - dc;
      sine[1][k] = sine[0][k] + ds, sine[2][k] = sine[0][k] - ds;
    }
    for (std::size_t k = 0; k < size; ++k) {
      const double c0 = static_cast<double>(cosine[0][k]), s0 = static_cast<double>(sine[0][k]);
      const double c1 = static_cast<double>(cosine[1][k]), s1 = static_cast<double>(sine[1][k]);
      const double c2 = static_cast<double>(cosine[2][k]), s2 = static_cast<double>(sine[2][k]);
      const double a0 = over(c0), a1 = over(c1), a2 = over(c2);
      const double b0 = s0 * s0, b1 = s1 * s1, b2 = s2 * s2;
      const std::uint64_t complement = codes[k];
      const auto miss = [&](double a, double b, std::uint64_t code) {
        return std::bit_cast<double>((std::bit_cast<std::uint64_t>(a + b) & ~(sign | code_mask)) |
                                     (code ^ complement));
      };
      const auto least = [](double a, double b) { return a < b ? a : b; };
      // They themselves count a little better, so that what is a matter of chance stays.
      const double own = std::abs(a0 + b0) - 1e-17;
      const double first =
          own > 0 ? std::bit_cast<double>(std::bit_cast<std::uint64_t>(own) & ~code_mask) : 0.0;
      const double best = least(least(least(first, miss(a0, b1, sine_only)),
                                      least(miss(a1, b0, cosine_only), miss(a1, b1, both))),
                                least(miss(a1, b2, both_other), miss(a2, b1, other_both)));
      codes[k] = std::bit_cast<std::uint64_t>(best) & code_mask;
    }
    for (std::size_t k = 0; k < size; ++k) {
      rounded.cosine[i][k] = cosine[which_cosine[codes[k]]][k];
      rounded.sine[i][k] = sine[which_sine[codes[k]]][k];
    }
  }
}
template void round_angles(const ShapeBlock&, RoundedAngles<float>&);
template void round_angles(const ShapeBlock&, RoundedAngles<double>&);

}  // namespace plexway::detail

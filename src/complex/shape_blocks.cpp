#include "complex/shape_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "complex/triangle_shape.hpp"

namespace plexway {
namespace {

constexpr std::size_t size = ShapeBlock::size;
using Row = ShapeBlock::Row;
using Vectors = std::array<Row, 3>;  // x, y and z

// Edge i of each triangle, from corner i to the next. Places behind the last repeat it.
void gather(std::span<const std::array<double, 3>> positions,
            std::span<const std::array<Index, 3>> faces, std::span<const Index> listed,
            std::array<Vectors, 3>& edge) {
  for (std::size_t k = 0; k < size; ++k) {
    const auto& f = faces[listed[std::min(k, listed.size() - 1)]];
    const auto &a = positions[f[0]], &b = positions[f[1]], &c = positions[f[2]];
    for (std::size_t d = 0; d < 3; ++d) {
      edge[0][d][k] = b[d] - a[d];
      edge[1][d][k] = c[d] - b[d];
      edge[2][d][k] = a[d] - c[d];
    }
  }
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

void ShapesInSpace::lengths(std::span<const Index> faces,
                            std::span<std::array<double, 3>> rows) const {
  std::array<Vectors, 3> edge;
  Row length;
  for (std::size_t first = 0; first < faces.size(); first += size) {
    const std::size_t count = std::min(size, faces.size() - first);
    gather(positions_, faces_, faces.subspan(first, count), edge);
    for (std::size_t i = 0; i < 3; ++i) {
      norms(edge[i], length);
      for (std::size_t k = 0; k < count; ++k) rows[first + k][i] = length[k];
    }
  }
}

void ShapesInSpace::angles(std::span<const Index> faces, ShapeBlock& block) const {
  std::array<Vectors, 3> edge;
  gather(positions_, faces_, faces, edge);
  // One cross product serves all corners, unless the triangle is thin, long or short: then each
  // corner has its own (TriangleShape).
  constexpr double thin = 1e-4, longest = 1e70, shortest = 1e-70;
  Row area, least, most;
  for (std::size_t k = 0; k < size; ++k) {
    const double x = edge[0][1][k] * edge[1][2][k] - edge[0][2][k] * edge[1][1][k];
    const double y = edge[0][2][k] * edge[1][0][k] - edge[0][0][k] * edge[1][2][k];
    const double z = edge[0][0][k] * edge[1][1][k] - edge[0][1][k] * edge[1][0][k];
    area[k] = std::sqrt(x * x + y * y + z * z);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Vectors &u = edge[i], &w = edge[(i + 2) % 3];
    const Row &l = block.length[i], &m = block.length[(i + 2) % 3];
    for (std::size_t k = 0; k < size; ++k) {
      const double product = l[k] * m[k];
      block.cosine[i][k] =
          -(u[0][k] * w[0][k] + u[1][k] * w[1][k] + u[2][k] * w[2][k]) / product;
      block.sine[i][k] = area[k] / product;
    }
  }
  const auto smaller = [](double a, double b) { return b < a ? b : a; };
  for (std::size_t k = 0; k < size; ++k) {
    least[k] = smaller(smaller(block.sine[0][k], block.sine[1][k]), block.sine[2][k]);
    most[k] = larger(larger(block.length[0][k], block.length[1][k]), block.length[2][k]);
  }
  for (std::size_t k = 0; k < faces.size(); ++k) {
    block.degenerate[k] = block.violated[k] = false;
    if (least[k] > thin && most[k] < longest && most[k] > shortest) continue;
    const auto& f = faces_[faces[k]];
    put(shape_from_positions({&positions_[f[0]], &positions_[f[1]], &positions_[f[2]]}), k, block);
  }
}

void ShapesOfLengths::lengths(std::span<const Index> faces,
                              std::span<std::array<double, 3>> rows) const {
  for (std::size_t k = 0; k < faces.size(); ++k) rows[k] = lengths_[faces[k]];
}

void ShapesOfLengths::angles(std::span<const Index> faces, ShapeBlock& block) const {
  for (std::size_t k = 0; k < faces.size(); ++k) {
    put(shape_from_lengths(lengths_[faces[k]]), k, block);
    block.violated[k] = violated_[faces[k]] != 0;
  }
}

void angles_of(const ShapeBlock& block, std::array<Row, 3>& angle) {
  // By half angles: tan(angle / 2) = sin / (1 + cos), of the acute one of two supplements, and pi /
  // 8 less where that is more. The odd polynomial is off by less than a rounding error.
  constexpr double eighth = 0.41421356237309503;  // tan(pi / 8)
  constexpr std::array<double, 10> series = {
      -0.3333333333333325,  0.19999999999898407, -0.14285714266096602, 0.11111109636533431,
      -0.09090852557145968, 0.07691055157849669, -0.06649613689550408, 0.05736332130703195,
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
  // Of the neighbours of both, in units of their last places, the pair that misses least; those
  // themselves where that is a matter of chance.
  constexpr Real step = std::numeric_limits<Real>::epsilon() * Real(0.75);
  using Numbers = std::array<Real, size>;
  std::array<Numbers, 3> cosine, sine;
  std::array<Row, 3> over, under;  // cos^2 - 1, sin^2
  Row best_cosine, best_sine;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < size; ++k) {
      const Real c = static_cast<Real>(block.cosine[i][k]), s = static_cast<Real>(block.sine[i][k]);
      const Real dc = std::abs(c) * step, ds = std::abs(s) * step;
      cosine[0][k] = c - dc, cosine[1][k] = c, cosine[2][k] = c + dc;
      sine[0][k] = s - ds, sine[1][k] = s, sine[2][k] = s + ds;
    }
    for (std::size_t n = 0; n < 3; ++n)
      for (std::size_t k = 0; k < size; ++k) {
        const double c = static_cast<double>(cosine[n][k]), s = static_cast<double>(sine[n][k]);
        over[n][k] = (c - 1) * (c + 1);
        under[n][k] = s * s;
      }
    // The pairs in their order, cosines first: of equal ones the first.
    for (std::size_t k = 0; k < size; ++k) {
      double best = std::numeric_limits<double>::infinity(), best_c = 0, best_s = 0;
      const auto look = [&](std::size_t n, std::size_t j, double against) {
        const double miss = std::abs(over[n][k] + under[j][k]) + against;
        const double c = static_cast<double>(cosine[n][k]), s = static_cast<double>(sine[j][k]);
        best_c = miss < best ? c : best_c;
        best_s = miss < best ? s : best_s;
        best = miss < best ? miss : best;
      };
      look(0, 0, 1e-17), look(0, 1, 1e-17), look(0, 2, 1e-17);
      look(1, 0, 1e-17), look(1, 1, 0), look(1, 2, 1e-17);
      look(2, 0, 1e-17), look(2, 1, 1e-17), look(2, 2, 1e-17);
      best_cosine[k] = best_c, best_sine[k] = best_s;
    }
    for (std::size_t k = 0; k < size; ++k) {
      rounded.cosine[i][k] = static_cast<Real>(best_cosine[k]);
      rounded.sine[i][k] = static_cast<Real>(best_sine[k]);
    }
  }
}
template void round_angles(const ShapeBlock&, RoundedAngles<float>&);
template void round_angles(const ShapeBlock&, RoundedAngles<double>&);

}  // namespace plexway

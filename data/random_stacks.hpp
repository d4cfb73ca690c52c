#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "mixed_pieces.hpp"

/// Stacks of slabs of random speeds, as coarse as one likes. Distances are Layers::time.
namespace samples {

struct Stack {
  Layers layers;
  std::vector<Block> blocks;  // one a slab, neighbours have the same vertices on the plane between
};

/// The same numbers with every library: in [low, high).
inline double between(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.);
}

/// 3 to 7 cells a side, 1 wide, 2 to `most` slabs, each one to three rows of cells high and from
/// `thinnest` to `thickest` cells thick; speeds from 1 / 3 to 3. Inner vertices are moved by up to
/// a fifth of a cell, those of planes in them.
inline Stack random_stack(std::mt19937& random, std::size_t most, double thinnest,
                          double thickest) {
  const std::size_t n = 3 + random() % 5, slabs = 2 + random() % (most - 1);
  const double cell = 1. / static_cast<double>(n);
  Stack stack;
  double z = 0;
  std::vector<double> moved((n + 1) * (n + 1) * 2, 0);  // of the plane below
  const auto draw = [&] {
    for (std::size_t v = 0; v < (n + 1) * (n + 1); ++v) {
      const std::size_t at[2] = {v / (n + 1), v % (n + 1)};
      for (std::size_t i = 0; i < 2; ++i) {
        const double by = between(random, -.2, .2) * cell;
        moved[2 * v + i] = at[i] > 0 && at[i] < n ? by : 0;
      }
    }
  };
  draw();
  for (std::size_t k = 0; k < slabs; ++k) {
    const double thick = cell * std::exp(between(random, std::log(thinnest), std::log(thickest)));
    const std::size_t up = 1 + random() % 3;
    if (k > 0) stack.layers.z.push_back(z);
    stack.layers.v.push_back(std::pow(3., between(random, -1, 1)));
    Block b = block({0, 0, z}, {1, 1, z + thick}, {n, n, up});
    for (std::size_t level = 0; level <= up; ++level) {
      if (level > 0) draw();
      for (std::size_t v = 0; v < (n + 1) * (n + 1); ++v)
        for (std::size_t i = 0; i < 2; ++i)
          b.positions[v * (up + 1) + level][i] += moved[2 * v + i];
    }
    stack.blocks.push_back(std::move(b));
    z += thick;
  }
  return stack;
}

/// The slabs as solids that are welded, each of its speed.
struct StackDomain {
  explicit StackDomain(const Stack& stack) {
    for (std::size_t k = 0; k < stack.blocks.size(); ++k) {
      const auto& [positions, tets] = stack.blocks[k];
      places.insert(places.end(), positions.begin(), positions.end());
      auto timed = positions;
      for (auto& p : timed)
        for (double& x : p) x /= stack.layers.v[k];
      pieces.push_back(domain.add(plexway::TetMesh<double>(timed, tets), positions));
      if (k > 0) domain.weld(pieces[k - 1], pieces[k], plexway::WeldOptions{.tolerance = 1e-9});
    }
  }
  plexway::MixedComplex<double> domain;
  std::vector<plexway::MixedComplex<double>::Piece> pieces;
  std::vector<Position> places;  // by vertex of the domain
};

}  // namespace samples

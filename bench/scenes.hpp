#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "data/shapes.hpp"
#include "measure.hpp"

/// What several benchmarks are run on.
namespace bench {

struct Wires {
  std::string name;
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 2>> edges;
  std::vector<double> lengths;  ///< empty: from the positions
};

/// nx by ny by nz points a unit apart, each pushed by up to `push` along each axis that there is.
Wires lattice(std::string name, Index nx, Index ny, Index nz, double push);

/// Over the unit square, n squares a side, all cut the same way.
Surface height_field(Index n, const std::function<double(double, double)>& height);

/// The numbers below n in an order that says nothing of them.
std::vector<Index> shuffled(std::size_t n, samples::Noise& noise);

}  // namespace bench

#include "scenes.hpp"

#include <algorithm>
#include <numeric>

namespace bench {

Wires lattice(std::string name, Index nx, Index ny, Index nz, double push) {
  Wires wires{std::move(name), {}, {}, {}};
  samples::Noise noise(1);
  for (Index k = 0; k < nz; ++k)
    for (Index j = 0; j < ny; ++j)
      for (Index i = 0; i < nx; ++i) {
        const Index v = static_cast<Index>(wires.positions.size());
        const double x = push * noise(), y = push * noise(), z = nz > 1 ? push * noise() : 0;
        wires.positions.push_back({i + x, j + y, k + z});
        if (i > 0) wires.edges.push_back({v - 1, v});
        if (j > 0) wires.edges.push_back({v - nx, v});
        if (k > 0) wires.edges.push_back({v - nx * ny, v});
      }
  return wires;
}

Surface height_field(Index n, const std::function<double(double, double)>& height) {
  Surface s;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) {
      const double x = i * 1.0 / n, y = j * 1.0 / n;
      s.positions.push_back({x, y, height(x, y)});
    }
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i, b = a + n + 1;
      s.faces.push_back({a, a + 1, b + 1});
      s.faces.push_back({a, b + 1, b});
    }
  return s;
}

std::vector<Index> shuffled(std::size_t n, samples::Noise& noise) {
  std::vector<Index> order(n);
  std::iota(order.begin(), order.end(), Index{0});
  for (std::size_t i = n; i > 1; --i) {
    const double place = (noise() + 1) / 2 * static_cast<double>(i);
    std::swap(order[i - 1], order[std::min(i - 1, static_cast<std::size_t>(place))]);
  }
  return order;
}

}  // namespace bench

// Warnings of domains whose kind is known: where distances may be far off though nothing failed. A
// strip of 60,000 triangles' edges is too long for single precision, and its end lies apart.

#include <array>
#include <cstdio>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/shape/warnings.hpp>
#include <plexway/solve.hpp>

using namespace plexway;

namespace {

constexpr Index edges = 60000;

// Vertices 2 i and 2 i + 1 across the strip; the last triangle hangs on nothing.
std::vector<std::array<double, 3>> positions() {
  std::vector<std::array<double, 3>> at;
  for (Index i = 0; i <= edges; ++i) {
    at.push_back({double(i), 0, 0});
    at.push_back({i + .3, 1, 0});
  }
  at.insert(at.end(), {{0, 5, 0}, {1, 5, 0}, {0, 6, 0}});
  return at;
}

std::vector<std::array<Index, 3>> triangles() {
  std::vector<std::array<Index, 3>> corners;
  for (Index a = 0; a < 2 * edges; a += 2) {
    corners.push_back({a, a + 2, a + 1});
    corners.push_back({a + 2, a + 3, a + 1});
  }
  corners.push_back({2 * edges + 2, 2 * edges + 3, 2 * edges + 4});
  return corners;
}

template <class Real>
std::size_t warned() {
  const TriangleMesh<Real> strip(positions(), triangles());
  const DistanceField<Real> field = solve(Serial{}, strip, 0);
  const std::vector<Warning> all = warnings(strip, field);
  for (const Warning& warning : all)
    std::printf("%s: %s\n", warning.doubtful ? "doubtful" : "note", warning.text.c_str());
  return all.size();
}

}  // namespace

int main() {
  try {
    return warned<float>() > warned<double>() && warned<double>() == 1 ? 0 : 1;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

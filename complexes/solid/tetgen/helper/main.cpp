// The program that runs TetGen, the only one of ours that links it.

#include <unistd.h>
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <new>
#include <string>

#define TETLIBRARY
#include <tetgen.h>
#undef REAL

#include <plexway/tetgen/piecewise_linear_complex.hpp>

#include "complexes/common/helper_main.hpp"
#include "complexes/common/plain_bytes.hpp"
#include "isolated_run.hpp"

namespace {

using namespace plexway::tetgen;
namespace isolated = plexway::detail::isolated;

// Copies points to TetGen's array, three numbers each; it frees the array itself.
double* new_points(const std::vector<std::array<double, 3>>& points) {
  if (points.empty()) return nullptr;
  double* const list = new double[3 * points.size()];
  for (std::size_t i = 0; i < points.size(); ++i) std::copy_n(points[i].data(), 3, list + 3 * i);
  return list;
}

// The complex in TetGen's own arrays. Facets get the markers 1, 2, ...
void to_tetgen(const PiecewiseLinearComplex& complex, tetgenio& io) {
  io.pointlist = new_points(complex.positions);
  io.numberofpoints = static_cast<int>(complex.positions.size());
  io.holelist = new_points(complex.holes);
  io.numberofholes = static_cast<int>(complex.holes.size());

  io.facetlist = new tetgenio::facet[complex.facets.size()];
  io.facetmarkerlist = new int[complex.facets.size()];
  for (const auto& facet : complex.facets) {
    const int number = io.numberoffacets++;
    io.facetmarkerlist[number] = number + 1;
    tetgenio::facet& to = io.facetlist[number];
    tetgenio::init(&to);
    to.holelist = new_points(facet.holes);
    to.numberofholes = static_cast<int>(facet.holes.size());
    to.polygonlist = new tetgenio::polygon[facet.polygons.size()];
    for (const auto& polygon : facet.polygons) {
      tetgenio::polygon& corners = to.polygonlist[to.numberofpolygons++];
      corners.numberofvertices = static_cast<int>(polygon.size());
      corners.vertexlist = new int[polygon.size()];
      std::copy(polygon.begin(), polygon.end(), corners.vertexlist);
    }
  }

  if (complex.regions.empty()) return;
  io.regionlist = new double[5 * complex.regions.size()];
  for (const auto& region : complex.regions) {
    double* const to = io.regionlist + 5 * io.numberofregions++;
    std::copy_n(region.point.data(), 3, to);
    to[3] = region.attribute;
    to[4] = region.max_volume > 0 ? region.max_volume : -1;
  }
}

bool understand(isolated::BytesIn in, std::string& switches, PiecewiseLinearComplex& complex) {
  std::uint64_t facets = 0;
  if (!in.get_row(switches) || !in.get_row(complex.positions) || !in.get_row(complex.holes) ||
      !in.get_row(complex.regions) || !in.get(facets))
    return false;
  for (; facets > 0; --facets) {
    auto& facet = complex.facets.emplace_back();
    std::uint64_t polygons = 0;
    if (!in.get_row(facet.holes) || !in.get(polygons)) return false;
    for (; polygons > 0; --polygons)
      if (!in.get_row(facet.polygons.emplace_back())) return false;
  }
  return true;
}

void send_row(const void* numbers, std::uint64_t rows, std::size_t bytes_each) {
  isolated::send_answer(&rows, sizeof rows);
  isolated::send_answer(numbers, rows * bytes_each);
}

// Nothing is freed: the process ends here, and after an error TetGen's memory is not to be touched.
void fill(const PiecewiseLinearComplex& complex, std::string switches) {
  std::setvbuf(stdout, nullptr, _IOLBF, 1 << 12);  // abort() does not flush
  Ending ending = Ending::done;
  auto* const in = new tetgenio;
  auto* const out = new tetgenio;
  try {
    to_tetgen(complex, *in);
    ::tetrahedralize(switches.data(), in, out);
  } catch (const int code) {
    ending = code == 0 ? Ending::internal_error : static_cast<Ending>(code);
  } catch (const std::bad_alloc&) {
    ending = Ending::out_of_memory;
  } catch (...) {
    ending = Ending::internal_error;
  }
  std::fflush(stdout);
  const bool done = ending == Ending::done;
  const auto tets = static_cast<std::uint64_t>(done ? out->numberoftetrahedra : 0);
  const auto word = static_cast<std::int32_t>(ending);
  isolated::send_answer(&word, sizeof word);
  send_row(out->pointlist, static_cast<std::uint64_t>(done ? out->numberofpoints : 0),
           3 * sizeof(double));
  send_row(out->tetrahedronlist, tets, 4 * sizeof(int));
  send_row(out->tetrahedronattributelist, out->numberoftetrahedronattributes == 1 ? tets : 0,
           sizeof(double));
}

}  // namespace

int main(int argc, char** argv) {
  // Whoever asked is told by which signal TetGen ended, also where a sanitizer would report
  // instead.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) std::signal(signal, SIG_DFL);
  try {
    const std::string told = isolated::begin_as_helper(argc, argv);
    std::string switches;
    PiecewiseLinearComplex complex;
    if (!understand(isolated::BytesIn(told), switches, complex)) ::_exit(1);
    fill(complex, switches);
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

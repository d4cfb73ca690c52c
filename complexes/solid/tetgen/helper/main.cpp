// The program that runs TetGen, the only one of ours that links it.

#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <new>
#include <string>

#include "complexes/common/helper_main.hpp"
#include "complexes/common/plain_bytes.hpp"
#include "isolated_run.hpp"
#include "tetgen_arrays.hpp"

namespace {

using namespace plexway::tetgen;
namespace isolated = plexway::detail::isolated;

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

#include "reason.hpp"

#include <algorithm>
#include <new>
#include <set>
#include <utility>

#include <plexway/error.hpp>

namespace plexway::tetgen {
namespace {

// Calls `take` with each line of `text`, without a copy of the text.
template <class Take>
void for_each_line(const std::string& text, Take take) {
  for (std::size_t from = 0; from < text.size();) {
    std::size_t end = text.find('\n', from);
    if (end == text.npos) return;  // cut off
    take(text.substr(from, end - from));
    from = end + 1;
  }
}

// Pairs of facets, counted from 0, that the diagnosis says touch where they must not.
struct Clashes {
  std::pair<int, int> first = {-1, -1};
  bool duplicates = false;  // the first pair covers the same triangle
  std::set<std::pair<int, int>> all;
};

Clashes clashes_in(const std::string& said) {
  Clashes clashes;
  for_each_line(said, [&](const std::string& line) {
    int a = 0, b = 0;
    const bool crosses = std::sscanf(line.c_str(), " Facet #%d intersects facet #%d", &a, &b) == 2;
    if (!crosses && std::sscanf(line.c_str(), " Facet #%d duplicates facet #%d", &a, &b) != 2)
      return;
    const auto pair = std::minmax({a - 1, b - 1});
    if (clashes.all.empty()) {
      clashes.first = pair;
      clashes.duplicates = !crosses;
    }
    clashes.all.insert(pair);
  });
  return clashes;
}

// Two vertices that TetGen took for one, though they are not in the same place.
std::pair<int, int> merged_in(const std::string& said) {
  std::pair<int, int> merged = {-1, -1};
  for_each_line(said, [&](const std::string& line) {
    int a = 0, b = 0;
    if (merged.first < 0 &&
        std::sscanf(line.c_str(), "Warning: Point %d is replaced by point %d", &a, &b) == 2)
      merged = std::minmax({a, b});
  });
  return merged;
}

std::string plural(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

void give_reason(const Run& run, const Run& diagnosis, const std::string& facet) {
  if (run.ending == Ending::out_of_memory) throw std::bad_alloc();
  if (run.ending == Ending::killed)
    throw Error(std::string("the program ") + helper_name + ", which fills solids, " + run.how);
  if (run.ending == Ending::cancelled || diagnosis.ending == Ending::cancelled)
    throw Cancelled("TetGen was stopped");
  const Clashes clashes = clashes_in(diagnosis.said);
  if (!clashes.all.empty()) {
    const bool only_part = diagnosis.ending != Ending::done;
    std::string message = facet + "s " + std::to_string(clashes.first.first) + " and " +
                          std::to_string(clashes.first.second) +
                          (clashes.duplicates ? " lie on each other" : " intersect");
    message += ", " + plural(clashes.all.size(), "pair") + (only_part ? " or more" : "") +
               " in all: the boundary must not cross or cover itself";
    throw InputError(message);
  }
  if (run.ending == Ending::out_of_time)
    throw Error(
        "TetGen was stopped at the time limit; allow more, keep the surface as it is, or ask "
        "for less quality");
  for (const std::string* said : {&run.said, &diagnosis.said}) {
    const auto [a, b] = merged_in(*said);
    if (a >= 0) {
      throw InputError(
          "vertices " + std::to_string(a) + " and " + std::to_string(b) +
          " are too close to be distinguished (1e-8 of the solid's size), and the boundary "
          "is not sound if they are one: merge them first");
    }
  }
  switch (run.ending) {
    case Ending::done:
      throw InputError("the boundary encloses no volume that is not a hole");
    case Ending::self_intersection:
      throw InputError("the boundary intersects itself; TetGen does not say where");
    case Ending::tiny_feature:
      throw InputError(
          "the boundary has a feature too small for TetGen: merge vertices that are "
          "very close");
    case Ending::close_facets:
      throw InputError("two " + facet +
                       "s of the boundary nearly lie on each other; with keep_surface "
                       "TetGen may succeed");
    case Ending::input_error:
      throw InputError("TetGen does not accept this input, and does not say why");
    default:
      throw InputError(
          "TetGen gives up on this boundary; it may be flat, nearly cross itself, or "
          "have parts that nearly touch");
  }
}

}  // namespace plexway::tetgen

#include <plexway/flann/neighbours.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <plexway/common/blocks.hpp>
#include <plexway/error.hpp>

#include "complexes/common/disjoint_sets.hpp"
#include "search.hpp"

namespace plexway::flann {
using namespace detail;
namespace {

using Points = std::span<const std::array<double, 3>>;

constexpr std::size_t block = 1024;

void check_options(const NeighbourOptions& options) {
  if (!(options.radius > 0)) throw UsageError("the radius of neighbours must be > 0");
  if (options.k == 0 && !std::isfinite(options.radius))
    throw UsageError("neighbours need a number k, a radius, or both");
}

// Rows of the places, in numbers of the search, end to end.
struct Rows {
  std::vector<std::size_t> begin;
  std::vector<Index> of;
  [[nodiscard]] std::span<const Index> row(std::size_t i) const {
    return std::span<const Index>(of).subspan(begin[i], begin[i + 1] - begin[i]);
  }
};

// Where the k nearest of a place lie in one row of a scan, all up to the rows beside it.
void reach_beside(const Search& search, std::size_t i, std::size_t k, double radius,
                  std::vector<Found>& row, std::vector<std::array<double, 3>>& offsets) {
  constexpr std::size_t most = 16;  // times k: rows 8 k times as far apart as the points in a row
  const auto look = [&] {
    offsets.clear();
    for (const Found& f : row) offsets.push_back(search.offset(i, f.place));
  };
  look();
  const RowOfPoints along(offsets);
  if (!along.found()) return;
  const std::vector<Found> own = row;
  std::size_t needed = 0;
  for (std::size_t more = 2 * k; more <= most * k; more *= 2) {
    search.around(i, more, radius, row);
    look();
    needed = along.needed(offsets, false);
    if ((needed > 0 && needed < row.size()) || row.size() < more) break;
  }
  if (needed == 0) needed = along.needed(offsets, true);  // the last row has one side only
  if (needed == 0)
    row = own;
  else
    row.resize(std::max(needed, own.size()));
}

Rows search_all(const Search& search, std::size_t k, const NeighbourOptions& options,
                bool surface) {
  const std::size_t n = search.places().order.size();
  Rows rows;
  rows.begin.assign(n + 1, 0);
  std::vector<std::vector<Index>> found((n + block - 1) / block);
  for_blocks(n, block, options.threads, options.progress, [&](std::size_t first, std::size_t last) {
    std::vector<Found> row;
    std::vector<std::array<double, 3>> offsets;
    std::vector<Index>& some = found[first / block];
    some.reserve((last - first) * k);
    for (std::size_t i = first; i < last; ++i) {
      search.around(i, k, options.radius, row);
      if (surface && k > 0) reach_beside(search, i, k, options.radius, row, offsets);
      rows.begin[i + 1] = row.size();
      for (const Found& f : row) some.push_back(f.place);
    }
  });
  for (std::size_t i = 0; i < n; ++i) rows.begin[i + 1] += rows.begin[i];
  rows.of.reserve(rows.begin[n]);
  for (std::vector<Index>& some : found) {
    rows.of.insert(rows.of.end(), some.begin(), some.end());
    some = {};
  }
  return rows;
}

// Who has a point but not the other way around is farther than all that the point has, or as far:
// so it comes behind them.
Rows close(const Search& search, const Rows& rows) {
  const std::size_t n = rows.begin.size() - 1;
  std::vector<Found> last(n, {-1, none, none});
  for (std::size_t i = 0; i < n; ++i)
    if (const auto row = rows.row(i); !row.empty()) last[i] = search.seen(i, row.back());
  const auto lists = [&](Index j, Index i) { return !(last[j] < search.seen(j, i)); };
  Rows closure;
  closure.begin.assign(n + 1, 0);
  for (Index i = 0; i < n; ++i) {
    closure.begin[i + 1] += rows.row(i).size();
    for (const Index j : rows.row(i)) closure.begin[j + 1] += !lists(j, i);
  }
  for (std::size_t i = 0; i < n; ++i) closure.begin[i + 1] += closure.begin[i];
  closure.of.resize(closure.begin[n]);
  std::vector<std::size_t> end(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = rows.row(i);
    std::copy(row.begin(), row.end(),
              closure.of.begin() + static_cast<std::ptrdiff_t>(closure.begin[i]));
    end[i] = closure.begin[i] + row.size();
  }
  for (Index i = 0; i < n; ++i)
    for (const Index j : rows.row(i)) {
      if (lists(j, i)) continue;
      const Found added = search.seen(j, i);
      std::size_t at = end[j]++;
      for (; at > closure.begin[j] && added < search.seen(j, closure.of[at - 1]); --at)
        closure.of[at] = closure.of[at - 1];
      closure.of[at] = i;
    }
  return closure;
}

// Rows of the places become rows of all points in the caller's order.
Neighbours of_all_points(const Search& search, const Rows& rows, std::size_t points,
                         bool symmetric) {
  const DistinctPoints& places = search.places();
  std::vector<Index> twins(symmetric ? points : 0, 0);  // in front: their distance is 0
  Neighbours result;
  result.begin.assign(points + 1, 0);
  for (std::size_t p = 0; p < places.order.size(); ++p)
    result.begin[places.order[p] + 1] = static_cast<Index>(rows.row(p).size());
  for (Index i = 0; i < points; ++i) {
    if (places.first[i] == i) continue;
    ++result.begin[i + 1];
    if (symmetric) ++twins[places.first[i]], ++result.begin[places.first[i] + 1];
  }
  std::size_t total = 0;
  for (std::size_t i = 0; i < points; ++i) {
    total += result.begin[i + 1];
    if (total >= none) throw InputError("more than 4294967294 neighbours: ask for fewer");
    result.begin[i + 1] = static_cast<Index>(total);
  }
  result.of.resize(total);
  for (std::size_t p = 0; p < places.order.size(); ++p) {
    const Index i = places.order[p];
    Index at = result.begin[i] + (symmetric ? twins[i] : 0);
    for (const Index q : rows.row(p)) result.of[at++] = places.order[q];
  }
  std::fill(twins.begin(), twins.end(), Index{0});
  for (Index i = 0; i < points; ++i) {
    const Index first = places.first[i];
    if (first == i) continue;
    result.of[result.begin[i]] = first;
    if (symmetric) result.of[result.begin[first] + twins[first]++] = i;
  }
  return result;
}

Neighbours neighbours_of(const Search& search, std::size_t points, const NeighbourOptions& options,
                         bool surface) {
  const std::size_t places = search.places().order.size();
  const std::size_t most = places > 0 ? places - 1 : 0;
  // Without a number, or with all the others, every pair is found from both ends.
  const bool all = options.k == 0 || options.k >= most;
  Rows rows = search_all(search, all ? 0 : options.k, options, surface);
  if (options.symmetric && !all) rows = close(search, rows);
  return of_all_points(search, rows, points, options.symmetric);
}

}  // namespace

Neighbours neighbours(const GivenPoints& points, const NeighbourOptions& options) {
  check_options(options);
  return neighbours_of(Search(points), points.size(), options, false);
}

Neighbours surface_neighbours(const GivenPoints& points, const NeighbourOptions& options) {
  check_options(options);
  DistinctPoints places = distinct_points(points);
  Neighbours found = neighbours_of(Search(points, places), points.size(), options, true);
  DistinctPoints merged = without_near_twins(points, found, places);
  if (merged.order.size() == places.order.size()) return found;
  return neighbours_of(Search(points, std::move(merged)), points.size(), options, true);
}

std::optional<std::size_t> connecting_k(const GivenPoints& points, std::size_t most,
                                        const NeighbourOptions& options) {
  const Search search(points);
  const DistinctPoints& places = search.places();
  const std::size_t n = places.order.size();
  if (n < 2) return 0;
  DisjointSets sets(points.size());
  for (Index i = 0; i < points.size(); ++i) sets.unite(i, places.first[i]);
  std::size_t apart = n;
  struct Link {
    std::size_t k;
    Index a, b;
  };
  constexpr double everywhere = std::numeric_limits<double>::infinity();
  most = std::min(most, n - 1);
  for (std::size_t known = 0, k = std::min<std::size_t>(16, most); known < most;
       known = k, k = std::min(2 * k, most)) {
    // Only who is not connected by fewer neighbours matters.
    std::vector<Index> part(points.size());
    for (Index i = 0; i < points.size(); ++i) part[i] = sets.find(i);
    std::vector<std::vector<Link>> found((n + block - 1) / block);
    for_blocks(n, block, options.threads, options.progress,
               [&](std::size_t first, std::size_t last) {
                 std::vector<Found> row;
                 for (std::size_t i = first; i < last; ++i) {
                   search.around(i, k, everywhere, row);
                   const Index a = part[places.order[i]];
                   for (std::size_t r = known; r < row.size(); ++r)
                     if (const Index b = part[places.order[row[r].place]]; a != b)
                       found[first / block].push_back({r + 1, a, b});
                 }
               });
    std::vector<Link> links;
    for (const auto& some : found) links.insert(links.end(), some.begin(), some.end());
    std::stable_sort(links.begin(), links.end(),
                     [](const Link& a, const Link& b) { return a.k < b.k; });
    for (const Link& link : links)
      if (sets.unite(link.a, link.b) && --apart == 1) return link.k;
  }
  return std::nullopt;
}

}  // namespace plexway::flann

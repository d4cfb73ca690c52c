#include <plexway/flann/neighbours.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <plexway/complex/blocks.hpp>
#include <plexway/error.hpp>

#include "search.hpp"

namespace plexway::flann {
namespace {

using Points = std::span<const std::array<double, 3>>;

constexpr std::size_t block = 1024;

void check_options(const NeighbourOptions& options) {
  if (!(options.radius > 0)) throw UsageError("the radius of neighbours must be > 0");
  if (options.k == 0 && !std::isfinite(options.radius))
    throw UsageError("neighbours need a number k, a radius, or both");
}

// Rows of the places in the search's order become rows of all points in the caller's.
Neighbours in_callers_order(const Search& search, std::size_t points,
                            const std::vector<std::vector<Index>>& found,
                            const std::vector<Index>& count) {
  const DistinctPoints& places = search.places();
  Neighbours result;
  result.begin.assign(points + 1, 0);
  for (std::size_t i = 0; i < places.order.size(); ++i)
    result.begin[places.order[i] + 1] = count[i];
  for (std::size_t i = 0; i < points; ++i) result.begin[i + 1] += places.first[i] != i;
  std::size_t total = 0;
  for (std::size_t i = 0; i < points; ++i) {
    total += result.begin[i + 1];
    if (total >= none) throw InputError("more than 4294967294 neighbours: ask for fewer");
    result.begin[i + 1] = static_cast<Index>(total);
  }
  result.of.resize(total);
  for (Index i = 0; i < points; ++i)
    if (places.first[i] != i) result.of[result.begin[i]] = places.first[i];
  for (std::size_t i = 0, at = 0; i < places.order.size(); ++i) {
    const std::vector<Index>& rows = found[i / block];
    if (i % block == 0) at = 0;
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(at), count[i],
                result.of.begin() + result.begin[places.order[i]]);
    at += count[i];
  }
  return result;
}

class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count), left_(count) {
    for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<Index>(i);
  }
  Index find(Index a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(Index a, Index b) {
    a = find(a), b = find(b);
    if (a == b) return;
    parent_[std::max(a, b)] = std::min(a, b);
    --left_;
  }
  [[nodiscard]] std::size_t left() const { return left_; }

 private:
  std::vector<Index> parent_;
  std::size_t left_;
};

}  // namespace

Neighbours neighbours(Points points, const NeighbourOptions& options) {
  check_options(options);
  const Search search(points);
  const std::size_t places = search.places().order.size();
  const std::size_t k = std::min(options.k, places > 0 ? places - 1 : 0);
  std::vector<Index> count(places, 0);
  std::vector<std::vector<Index>> found((places + block - 1) / block);
  if (k > 0 || options.k == 0)
    for_blocks(places, block, options.threads, options.progress,
               [&](std::size_t first, std::size_t last) {
                 std::vector<Found> row;
                 std::vector<Index>& rows = found[first / block];
                 rows.reserve((last - first) * k);
                 for (std::size_t i = first; i < last; ++i) {
                   search.around(i, k, options.radius, row);
                   count[i] = static_cast<Index>(row.size());
                   for (const Found& f : row) rows.push_back(f.point);
                 }
               });
  Neighbours result = in_callers_order(search, points.size(), found, count);
  found = {};
  return options.symmetric ? symmetric_closure(result, points) : result;
}

std::optional<std::size_t> connecting_k(Points points, std::size_t most,
                                        const NeighbourOptions& options) {
  const Search search(points);
  const DistinctPoints& places = search.places();
  const std::size_t n = places.order.size();
  if (n < 2) return 0;
  Sets sets(points.size());
  for (Index i = 0; i < points.size(); ++i) sets.join(i, places.first[i]);
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
                     if (const Index b = part[row[r].point]; a != b)
                       found[first / block].push_back({r + 1, a, b});
                 }
               });
    std::vector<Link> links;
    for (const auto& some : found) links.insert(links.end(), some.begin(), some.end());
    std::stable_sort(links.begin(), links.end(),
                     [](const Link& a, const Link& b) { return a.k < b.k; });
    for (const Link& link : links) {
      sets.join(link.a, link.b);
      if (sets.left() == 1) return link.k;
    }
  }
  return std::nullopt;
}

}  // namespace plexway::flann

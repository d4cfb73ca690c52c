#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <plexway/solve/options.hpp>

#include "executors/threads/team.hpp"
#include "labels/read_out.hpp"
#include "labels/workspace_state.hpp"

namespace plexway {

/// What a team does for a solve besides the propagation, which schedulers that derive from it share
/// out.
template <class Real, bool kLabels>
class TeamScheduler {
 public:
  TeamScheduler(const Team& team, WorkspaceState<Real>& workspace, Real step, double unit,
                const PropagateOptions& options)
      : team_(team), workspace_(workspace), step_(step), unit_(unit), options_(options) {}

  template <class Work>
  void over(std::size_t count, const Work& work) const {
    team_.over(count, work);
  }

  /// In order, and those that are wanted before any is looked at: with any number of threads.
  template <class Wanted, class Look>
  void search(std::size_t count, const Wanted& wanted, const Look& look) const {
    // Where a range begins, those found in it are written: nothing is shared, nothing to sort.
    Index* const found = list();
    std::vector<std::pair<std::size_t, std::size_t>> ranges;
    std::mutex mutex;
    team_.over(count, [&](std::size_t begin, std::size_t end) {
      std::size_t last = begin;
      for (std::size_t i = begin; i < end; ++i)
        if (wanted(i)) found[last++] = static_cast<Index>(i);
      const std::scoped_lock lock(mutex);
      ranges.emplace_back(begin, last);
    });
    std::sort(ranges.begin(), ranges.end());
    for (const auto& [begin, end] : ranges)
      for (std::size_t i = begin; i < end; ++i) look(found[i]);
  }

  [[nodiscard]] const Team& team() const { return team_; }

 protected:
  // Nothing waits in the front's second queue while the team works: it has room for all simplices.
  [[nodiscard]] Index* list() const { return workspace_.front.far.get(); }

  const Team& team_;
  WorkspaceState<Real>& workspace_;
  Real step_;
  double unit_;
  const PropagateOptions& options_;
};

/// Distances and whose they are, as numbers in the order of distances, then of sources. In double
/// there is no room for both in one.
template <class Real>
struct OfferKey {
  static constexpr bool ties_apart = sizeof(Real) == 8;
  static constexpr std::uint64_t unreached = ~std::uint64_t{0};

  static std::uint64_t of(float distance, Index source) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(distance + 0.F)} << 32 | source;
  }
  static Real distance(std::uint64_t key) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32));
  }
};

/// Triangles offer distances to their vertices, which keep the least.
template <class Real, bool kLabels, class Rule, class Front>
void read_out_triangles(const Team& team, std::span<const TriangleRecord<Real>> triangles,
                        const Rule& rule, const Front& front, WorkspaceState<Real>& workspace) {
  using Key = OfferKey<Real>;
  const auto offers = [&](const auto& offer) {
    team.over(triangles.size() - 1, [&](std::size_t begin, std::size_t end) {
      if constexpr (requires { rule.label(0).x; })
        offer_apexes(triangles, rule, front, static_cast<Index>(begin), static_cast<Index>(end),
                     offer);
      else
        offer_corners(triangles, rule, front, static_cast<Index>(begin), static_cast<Index>(end),
                      offer);
    });
  };
  const auto lower = [](auto& value, auto by) {
    const std::atomic_ref least(value);
    auto known = least.load(std::memory_order_relaxed);
    while (by < known && !least.compare_exchange_weak(known, by, std::memory_order_relaxed)) {
    }
  };
  Real* const distance = workspace.vertex.data();
  if constexpr (!kLabels) {
    offers([&](Index v, Real d, Index) { lower(distance[v], d); });
  } else if constexpr (!Key::ties_apart) {
    const std::size_t vertices = workspace.vertex.size();
    std::uint64_t* const key = workspace.team.template reserve<std::uint64_t>(vertices);
    team.over(vertices, [&](std::size_t begin, std::size_t end) {
      std::fill(key + begin, key + end, Key::unreached);
    });
    offers([&](Index v, Real d, Index f) { lower(key[v], Key::of(d, front.source(f))); });
    team.over(vertices, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        if (key[v] != Key::unreached) {
          distance[v] = Key::distance(key[v]);
          workspace.vertex_source[v] = static_cast<Index>(key[v]);
        }
    });
  } else {  // the distances first, then whose they are
    offers([&](Index v, Real d, Index) { lower(distance[v], d); });
    offers([&](Index v, Real d, Index f) {
      if (d == distance[v]) lower(workspace.vertex_source[v], front.source(f));
    });
  }
}

}  // namespace plexway

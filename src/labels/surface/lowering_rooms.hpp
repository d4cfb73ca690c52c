#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway::detail {

/// A vertex and a distance of it.
template <class Real>
struct VertexDistance {
  Index vertex;
  Real distance;
};

/// What one thread notes while distances go down along edges.
template <class Real>
struct LoweringRoom {
  std::vector<VertexDistance<Real>> changes;  ///< what a vertex had before
  std::vector<VertexDistance<Real>> waiting;  ///< to be passed on later
  std::vector<Index> corners;                 ///< around one vertex
  std::size_t seen = 0, most = 0;             ///< corners

  /// What an ordinary small solve needs, so that another source's allocates nothing.
  LoweringRoom() {
    changes.reserve(512);
    waiting.reserve(512);
    corners.reserve(64);
  }
  void start() {
    changes.clear();
    waiting.clear();
    seen = most = 0;
  }
};

/// One for each thread, kept from solve to solve.
template <class Real>
struct LoweringRooms {
  std::deque<LoweringRoom<Real>> all;
  std::vector<LoweringRoom<Real>*> free;
  std::vector<Index> lowered;

  void start() {
    free.clear();
    for (LoweringRoom<Real>& room : all) {
      room.start();
      free.push_back(&room);
    }
  }
  [[nodiscard]] LoweringRoom<Real>& take() {
    if (free.empty()) {
      free.reserve(all.size() + 1);
      lowered.reserve(512);
      return all.emplace_back();
    }
    LoweringRoom<Real>& room = *free.back();
    free.pop_back();
    return room;
  }
  void give_back(LoweringRoom<Real>& room) { free.push_back(&room); }

  [[nodiscard]] std::size_t bytes() const {
    const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    std::size_t sum = of(free) + of(lowered);
    for (const LoweringRoom<Real>& room : all)
      sum += sizeof(room) + of(room.changes) + of(room.waiting) + of(room.corners);
    return sum;
  }
};

}  // namespace plexway::detail

#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/workspace.hpp>
#include <plexway/source/point_source.hpp>

#include "labels/front.hpp"
#include "labels/label_memory.hpp"
#include "labels/simplicial/simplex_label.hpp"
#include "labels/surface/saddle_label.hpp"
#include "windows/window_memory.hpp"

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

class FlatStrings;
class MixedStrings;
class SolidStrings;

/// Of the surface or solid that a flat complex is solved as.
struct FlatSolve {
  Workspace<double> workspace;
  DistanceField<double> field;
};

/// All that a propagation changes, in the open.
template <class Real>
struct WorkspaceState {
  /// Which simplices have a label.
  VisitMarks marks;
  LabelStorage<SaddleLabel<Real>> saddles;  ///< Visibility::saddles
  SimplexLabels<Real> simplex;              ///< the other policies, and of other domains
  std::vector<Index> source;                ///< nearest source a simplex; empty for one source
  WindowMemory<Real> windows;               ///< on surfaces: accuracies but `fast`
  /// The queues.
  FrontStorage front;
  PieceMemory pieces;                             ///< for executors with several threads
  std::vector<Real> vertex;                       ///< read-out, in the numbers inside
  std::vector<Index> vertex_source;               ///< its labels
  std::shared_ptr<SolidStrings> strings;          ///< in solids: strings/solid_strings.hpp
  std::vector<Index> corners;                     ///< around one vertex
  std::vector<PointSource> moved;                 ///< sources of a cloud, as its surface has them
  std::unique_ptr<LoweringRooms<Real>> lowering;  ///< read_out_edges
  std::vector<WorkspaceState> parts;              ///< on mixed domains: one a piece
  std::shared_ptr<MixedStrings> media;        ///< likewise, by strings: strings/mixed_strings.hpp
  std::shared_ptr<FlatSolve> flat;            ///< flat complexes of two or three dimensions
  std::shared_ptr<FlatStrings> flat_strings;  ///< of four: strings/flat/flat_strings.hpp

  /// Room for a front and marks over so many simplices and a sentinel behind them; all unreached
  /// but the sentinel, which nothing can improve.
  void start(std::size_t simplices, bool labels) {
    marks.resize(simplices + 1);
    marks.start();
    marks.data()[simplices] = marks.current();
    if (labels) source.resize(simplices + 1);
  }

  /// Bytes held.
  [[nodiscard]] std::size_t bytes() const {
    const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    std::size_t of_parts = 0;
    for (const WorkspaceState& part : parts) of_parts += part.bytes();
    return of_parts + sizeof(*this) + marks.bytes() + saddles.count * sizeof(SaddleLabel<Real>) +
           simplex.bytes() + (flat ? flat->workspace.bytes() + of(flat->field.distance) : 0) +
           of(source) + windows.bytes() + of(vertex) + of(vertex_source) + of(corners) + of(moved) +
           (lowering ? sizeof(*lowering) + lowering->bytes() : 0) +
           front.capacity * 2 * sizeof(Index) + of(front.heap) + pieces.bytes();
  }
};

}  // namespace plexway::detail

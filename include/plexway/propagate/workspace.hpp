#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <plexway/complex/ids.hpp>
#include <plexway/propagate/front.hpp>
#include <plexway/propagate/plain_label.hpp>
#include <plexway/propagate/plain_solid_label.hpp>
#include <plexway/propagate/saddle_label.hpp>
#include <plexway/propagate/solid_label.hpp>
#include <plexway/propagate/visit_marks.hpp>

namespace plexway {

/// Room for one label a simplex, allocated without being touched.
template <class Label>
struct LabelStorage {
  std::unique_ptr<Label[]> labels;
  std::size_t count = 0;

  Label* reserve(std::size_t simplices) {
    if (count != simplices) {
      labels = std::make_unique_for_overwrite<Label[]>(simplices);
      count = simplices;
    }
    return labels.get();
  }
};

/// All that a propagation changes: labels, marks, queues. Belongs to one domain and one thread at a
/// time; grows on first use and is then reused without allocating or clearing.
template <class Real>
struct Workspace {
  VisitMarks marks;
  LabelStorage<SaddleLabel<Real>> saddles;           ///< Visibility::saddles
  LabelStorage<PlainLabel<Real>> plain;              ///< the other policies
  LabelStorage<SolidLabel<Real>> solids;             ///< in solids: Visibility::saddles
  LabelStorage<PlainSolidLabel<Real>> plain_solids;  ///< in solids: the other policies
  std::vector<Index> source;  ///< nearest source a simplex; empty for one source
  FrontStorage front;
  std::vector<Real> vertex;          ///< read-out, in the numbers inside
  std::vector<Index> vertex_source;  ///< its labels
  std::vector<Index> vertex_path;    ///< in solids: how the path came
  std::vector<Index> corners;        ///< around one vertex

  [[nodiscard]] std::size_t bytes() const {
    const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return sizeof(*this) + marks.bytes() + saddles.count * sizeof(SaddleLabel<Real>) +
           plain.count * sizeof(PlainLabel<Real>) + solids.count * sizeof(SolidLabel<Real>) +
           plain_solids.count * sizeof(PlainSolidLabel<Real>) + of(source) + of(vertex) +
           of(vertex_source) + of(vertex_path) + of(corners) + front.capacity * 2 * sizeof(Index) +
           of(front.heap);
  }
};

}  // namespace plexway

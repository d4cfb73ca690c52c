#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/propagate/plain_rule.hpp>
#include <plexway/propagate/saddle_rule.hpp>

#include "apps/solved.hpp"

namespace plexway {

/// The labels a propagation left on a surface, as its rule reads them: a front that nothing waits in.
template <class Real, class Label>
class LeftLabels {
 public:
  LeftLabels(const VisitMarks& marks, const Label* labels) : marks_(marks), labels_(labels) {}
  [[nodiscard]] bool reached(Index s) const { return marks_.reached(s); }
  [[nodiscard]] std::size_t hinge(Index s) const { return marks_.hinge(s); }
  [[nodiscard]] const Label& label(Index s) const { return labels_[s]; }
  void put(Index, const Label&) {}

 private:
  const VisitMarks& marks_;
  const Label* labels_;
};

/// Those of either rule.
template <class Real>
class SurfaceLabels {
 public:
  SurfaceLabels(const TriangleMesh<Real>& mesh, const Solved<Real>& solved)
      : mesh_(mesh), solved_(solved), saddles_(solved.visibility == Visibility::saddles) {}

  [[nodiscard]] bool reached(Index f) const { return solved_.workspace.marks.reached(f); }
  /// The edge that the label came in by.
  [[nodiscard]] std::size_t hinge(Index f) const { return solved_.workspace.marks.hinge(f); }

  /// Length of the label's path to corner i, in the unit inside.
  [[nodiscard]] double corner_distance(Index f, std::size_t i) const {
    return ask([&](const auto& rule) { return static_cast<double>(rule.corner_distance(f, i)); });
  }
  [[nodiscard]] double centre_distance(Index f) const {
    return ask([&](const auto& rule) { return static_cast<double>(rule.distance(f)); });
  }

  /// Does the path of the label come from corner i of its own triangle?
  [[nodiscard]] bool starts_at(Index f, std::size_t i) const {
    if (!saddles_) return solved_.workspace.plain.labels[f].distance2[i] == 0;
    const auto& label = solved_.workspace.saddles.labels[f];
    if (label.h[0] != 0) return false;
    const std::size_t in = hinge(f);
    return i == in ? label.x[0] == 0
                   : i == edge_after(in) && label.x[0] == mesh_.triangles()[f].length[in];
  }

 private:
  template <class Ask>
  double ask(Ask question) const {
    const Workspace<Real>& w = solved_.workspace;
    if (saddles_) {
      LeftLabels<Real, SaddleLabel<Real>> left(w.marks, w.saddles.labels.get());
      return question(SaddleRule<Real, decltype(left)>(mesh_.triangles(), left, false));
    }
    LeftLabels<Real, PlainLabel<Real>> left(w.marks, w.plain.labels.get());
    return question(
        PlainRule<Real, decltype(left)>(mesh_.triangles(), left, solved_.visibility));
  }

  const TriangleMesh<Real>& mesh_;
  const Solved<Real>& solved_;
  bool saddles_;
};

}  // namespace plexway

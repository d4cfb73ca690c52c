// Where exact windows begin: at the sources, and again at what rounding lost. Part of
// exact_windows.cpp.

namespace plexway::windows {

template <class Real>
template <class Order>
void ExactWindows<Real>::seed(Order& order, const WindowSources& sources) {
  for (std::size_t n = 0; n < sources.points.size(); ++n) {
    const PointSource& s = sources.points[n];
    const Index number = sources.number(n);
    const double sigma = s.offset / mesh_.unit();
    if (s.vertex != none) {
      offer(order, mesh_.inside_vertex(s.vertex), sigma, {}, number);
      continue;
    }
    const auto [f, turned] = mesh_.inside_face(s.simplex);
    const TriangleRecord<Real>& t = triangles_[f];
    std::array<double, 4> b = s.barycentric;
    if (turned) std::swap(b[1], b[2]);
    if (const auto at = near_corner(t, b)) {
      offer(order, t.corner[at->corner], sigma + at->way, {}, number);
      continue;
    }
    for (std::size_t e = 0; e < 3; ++e) {
      const std::size_t i = edge_after(e), p = edge_before(e);
      const double length = static_cast<double>(t.length[e]);
      const double x = b[i] * length + b[p] * static_cast<double>(t.apex_x(e));
      const double h = b[p] * static_cast<double>(t.apex_h(e));
      leave(order, f, e, measured(Beam<double>{x, h, 0, length}.mirrored(length), sigma), number);
      // The corner at the edge's start; the source in the frame of that edge.
      const double back = std::sqrt(x * x + h * h);
      offer(order, t.corner[e], sigma + back, {static_cast<Index>(3 * f + e), x, h}, number);
    }
  }
  for (const CornerBesideLine& c : sources.corners)
    offer(order, triangles_[c.face].corner[c.corner], c.distance,
          {3 * c.face + c.corner, c.back.along, c.back.off}, c.number);
  for (const LineLight& light : sources.lights) {
    const Window<double> window = light.window();
    const double length = static_cast<double>(triangles_[light.face].length[light.edge]);
    if (light.into)
      enter(order, light.face << Across::face_shift | light.edge, window, light.number);
    else
      leave(order, light.face, light.edge, window.mirrored(length), light.number);
  }
}

/// Light that rounding lost, or that fell on nothing with an area: vertices that are farther than
/// along an edge from a neighbour. False if there is none.
template <class Real>
template <class Order>
bool ExactWindows<Real>::fill_holes(Order& order) {
  if (radius_ < infinity) return false;
  bool any = false;
  const auto look = [&](Index v, Index w, double length) {
    const double way = distance_[v] + length;
    if (!(way + std::abs(rounding(way)) < distance_[w])) return;
    offer(order, w, way, {}, source(v));
    any = true;
  };
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    const TriangleRecord<Real>& t = triangles_[f];
    for (std::size_t e = 0; e < 3; ++e) {
      const Index v = t.corner[e], w = t.corner[edge_after(e)];
      look(v, w, static_cast<double>(t.length[e]));
      look(w, v, static_cast<double>(t.length[e]));
    }
  }
  return any;
}

}  // namespace plexway::windows

// Where merged windows begin: at the sources, and again at what no window reached. Part of
// merged_windows.cpp.

namespace plexway::windows {

/// So small a barycentric coordinate is none.
inline constexpr double on_edge = 1e-9;

/// A point of a triangle: over the edges that it does not lie on, and to the corners.
template <class Real>
template <class Order>
void MergedWindows<Real>::seed_in(Order& order, Index f, const std::array<double, 3>& b, Real sigma,
                                  Index number) {
  const TriangleRecord<Real>& t = triangles_[f];
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t i = edge_after(e), p = edge_before(e);
    const double length = static_cast<double>(t.length[e]);
    const double x = b[i] * length + b[p] * static_cast<double>(t.apex_x(e));
    const double h = b[p] * static_cast<double>(t.apex_h(e));
    const Beam<double> beam = Beam<double>{x, h, 0, length}.mirrored(length);
    Window<Real> window = {
        {static_cast<Real>(beam.x), static_cast<Real>(beam.h), 0, t.length[e]}, sigma, 0, 0, 0};
    window.begin_at(0);
    window.end_at(t.length[e]);
    if (b[p] > on_edge) leave(order, f, e, window, number);
    offer(order, t.corner[e], sigma + static_cast<Real>(std::sqrt(x * x + h * h)),
          static_cast<Index>(3 * f + e), {static_cast<Real>(x), static_cast<Real>(h)}, number, 0);
  }
}

template <class Real>
template <class Order>
void MergedWindows<Real>::seed(Order& order, const WindowSources& sources) {
  const auto real = [](double x) { return static_cast<Real>(x); };
  for (std::size_t n = 0; n < sources.points.size(); ++n) {
    const PointSource& s = sources.points[n];
    const Index number = sources.number(n);
    const Real sigma = static_cast<Real>(s.offset / mesh_.unit());
    if (s.vertex != none) {
      offer(order, mesh_.inside_vertex(s.vertex), sigma, none, {0, 0}, number, 0);
      continue;
    }
    const auto [f, turned] = mesh_.inside_face(s.simplex);
    const TriangleRecord<Real>& t = triangles_[f];
    std::array<double, 4> b = s.barycentric;
    if (turned) std::swap(b[1], b[2]);
    if (const auto at = near_corner(t, b)) {
      offer(order, t.corner[at->corner], sigma + real(at->way), none, {0, 0}, number, 0);
      continue;
    }
    seed_in(order, f, {b[0], b[1], b[2]}, sigma, number);
    // On an edge all triangles there have it. As a window over that edge it would light them
    // through a single point, and what cuts off a part of the edge would cut off all light to one
    // side.
    for (std::size_t e = 0; e < 3; ++e) {
      if (b[edge_before(e)] > on_edge || t.across[e] >> Across::face_shift == sentinel_) continue;
      cross_edge(triangles_, f, e, [&](Index across, bool same_way) {
        const std::size_t k = across & Across::edge_mask;
        std::array<double, 3> there = {0, 0, 0};
        there[k] = b[same_way ? e : edge_after(e)];
        there[edge_after(k)] = b[same_way ? edge_after(e) : e];
        const Index g = across >> Across::face_shift;
        seed_in(order, g, there, sigma, number);
        if (!kept_) return;  // what is read there looks for the source over the edge
        const Real length = triangles_[g].length[k];
        kept_->take(static_cast<Index>(4 * g + k),
                    {static_cast<Real>(there[edge_after(k)]) * length, 0, 0, length}, sigma,
                    number);
      });
    }
  }
  for (const CornerBesideLine& c : sources.corners)
    offer(order, triangles_[c.face].corner[c.corner], real(c.distance), 3 * c.face + c.corner,
          {real(c.back.along), real(c.back.off)}, c.number, 0);
  for (const LineLight& light : sources.lights) {
    const Beam<double>& b = light.beam;
    const Real length = triangles_[light.face].length[light.edge];
    Window<Real> window = {
        parallel(real(b.x), real(-b.h), real(b.begin), std::min(real(b.end), length)),
        real(light.sigma), 0, 0, 0};
    window.begin_at(window.beam.begin);
    window.end_at(window.beam.end);
    if (light.into)
      enter(order, light.face << Across::face_shift | light.edge, window, light.number);
    else
      leave(order, light.face, light.edge, window.mirrored(length), light.number);
  }
}

template <class Real>
template <class Order>
bool MergedWindows<Real>::fill_holes(Order& order) {
  if (radius_ < infinity<Real> ||
      std::all_of(vertices_.begin(), vertices_.end(),
                  [](const Vertex& v) { return v.distance < infinity<Real>; }))
    return false;
  bool any = false;
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    const TriangleRecord<Real>& t = triangles_[f];
    for (std::size_t e = 0; e < 3; ++e)
      for (const auto& [from, to] : {std::pair(e, edge_after(e)), std::pair(edge_after(e), e)}) {
        const Index v = t.corner[from], w = t.corner[to];
        if (vertices_[w].distance < infinity<Real> || !(vertices_[v].distance < infinity<Real>))
          continue;
        offer(order, w, vertices_[v].distance + t.length[e], none, {0, 0}, labels_ ? source_[v] : 0,
              error_[v]);
        any = true;
      }
  }
  return any;
}

}  // namespace plexway::windows

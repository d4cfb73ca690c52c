// Where merged windows begin: at the sources, and again at what no window reached. Part of
// merged_windows.cpp.

namespace plexway::windows {

template <class Real>
template <class Order>
void MergedWindows<Real>::seed(Order& order, std::span<const PointSource> sources) {
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const PointSource& s = sources[n];
    const Index number = static_cast<Index>(n);
    const Real sigma = static_cast<Real>(s.offset / mesh_.unit() - base_);
    if (s.vertex != none) {
      offer(order, mesh_.inside_vertex(s.vertex), sigma, none, {0, 0}, number, 0);
      continue;
    }
    const auto [f, turned] = mesh_.inside_face(s.simplex);
    const TriangleRecord<Real>& t = triangles_[f];
    std::array<double, 4> b = s.barycentric;
    if (turned) std::swap(b[1], b[2]);
    const auto corner = std::find(b.begin(), b.begin() + 3, 1.);
    if (corner != b.begin() + 3) {
      offer(order, t.corner[corner - b.begin()], sigma, none, {0, 0}, number, 0);
      continue;
    }
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
      leave(order, f, e, window, number);
      offer(order, t.corner[e], sigma + static_cast<Real>(std::sqrt(x * x + h * h)),
            static_cast<Index>(3 * f + e), {static_cast<Real>(x), static_cast<Real>(h)}, number, 0);
    }
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
        offer(order, w, distance_to(v) + t.length[e], none, {0, 0}, labels_ ? source_[v] : 0,
              error_[v]);
        any = true;
      }
  }
  return any;
}

}  // namespace plexway::windows

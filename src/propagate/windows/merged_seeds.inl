// Where merged windows begin: at the sources, and again at what no window reached. Part of
// merged_windows.cpp.

namespace plexway::windows {

template <class Real>
template <class Order>
void MergedWindows<Real>::seed_inside(Order& order, Index f, const std::array<double, 4>& b,
                                      Real sigma, Index number) {
  const TriangleRecord<Real>& t = triangles_[f];
  for (std::size_t e = 0; e < 3; ++e) {
    const auto [x, h, length] = SeenFromEdge<Real>(t, b, e);
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

template <class Real>
template <class Order>
bool MergedWindows<Real>::fill_holes(Order& order) {
  if (radius_ < infinity<Real> ||
      std::all_of(vertices_.begin(), vertices_.end(),
                  [](const Vertex& v) { return v.distance < infinity<Real>; }))
    return false;
  return fill_holes(
      triangles_, own_, [&](Index v) { return vertices_[v].distance; },
      [&](Index v, Index w, Real way) {
        offer(order, w, way, none, {0, 0}, labels_ ? source_[v] : 0, error_[v]);
      });
}

}  // namespace plexway::windows

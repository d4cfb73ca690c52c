// Where exact windows begin: at the sources, at messages, and again at what no window reached. Part
// of exact_windows.cpp.

namespace plexway::detail::windows {

template <class Real>
void ExactWindows<Real>::begin(const WindowSources& sources, const PropagateOptions& options,
                               const Patience& patience) {
  kept_ = nullptr;
  patience_ = patience;
  distance_.assign(sheet_.vertex_count, infinity);
  arrival_.resize(sheet_.vertex_count);
  labels_ = sources.labels;
  if (labels_) source_.resize(sheet_.vertex_count);
  split_.assign(3 * std::size_t{own_}, {std::numeric_limits<float>::infinity(), 0});
  nodes_.clear();
  node_source_.clear();
  free_ = none;
  complete_ = true;
  statistics_ = {};
  tie_ = least_tie();
  radius_ = options.radius / sheet_.mesh->unit();
  // A source that is no vertex may lie in another's light, and over an edge with several triangles
  // light comes from several sheets.
  splits_whole_ = sheet_.mesh->summary().non_manifold_edges == 0 && sources.only_points() &&
                  std::all_of(sources.points.begin(), sources.points.end(),
                              [](const PointSource& s) { return s.vertex != none; });
  ring_.start(bucket_width);
  leaving_.start(sheet_.shared);
}

template <class Real>
void ExactWindows<Real>::take(const Message<double>& message) {
  const auto admit = [&](double near) {
    ring_.admit(near, [this](Index n) -> Index& { return nodes_[n].next; });
  };
  const Window<double>& w = message.window;
  if (message.is_of_vertex()) {
    admit(w.at_begin);
    static_cast<void>(know(ring_, message.vertex(), w.at_begin, message.arrival(), message.source));
  } else {
    admit(turn_of(w));
    enter(ring_, message.to, w, message.source);
  }
}

template <class Real>
void ExactWindows<Real>::seed_vertex(Index vertex, double sigma, Index number) {
  offer(ring_, vertex, sigma, {}, number);
}

template <class Real>
void ExactWindows<Real>::seed_inside(Index f, const std::array<double, 4>& barycentric,
                                     double sigma, Index number) {
  seed_inside(ring_, f, barycentric, sigma, number);
}

template <class Real>
void ExactWindows<Real>::seed_hole(Index vertex, double distance, Index source, double) {
  offer(ring_, vertex, distance, {}, source);
}

template <class Real>
void ExactWindows<Real>::run_to(double horizon, std::size_t most) {
  ring_.set_horizon(horizon);
  static_cast<void>(spread(ring_, most));
}

template <class Real>
template <class Order>
void ExactWindows<Real>::seed_inside(Order& order, Index f, const std::array<double, 4>& b,
                                     double sigma, Index number) {
  const TriangleRecord<Real>& t = triangles_[f];
  for (std::size_t e = 0; e < 3; ++e) {
    const auto [x, h, length] = SeenFromEdge<Real>(t, b, e);
    leave(order, f, e, measured_window(Beam<double>{x, h, 0, length}.mirrored(length), sigma),
          number);
    // The corner at the edge's start; the source in the frame of that edge.
    const double back = std::sqrt(x * x + h * h);
    offer(order, t.corner[e], sigma + back, {static_cast<Index>(3 * f + e), x, h}, number);
  }
}

template <class Real>
template <class Order>
void ExactWindows<Real>::seed(Order& order, const WindowSources& sources) {
  for_each_seed(
      *sheet_.mesh, sources, [&](Index v, double sigma, Index n) { offer(order, v, sigma, {}, n); },
      [&](Index f, const std::array<double, 4>& b, double sigma, Index n) {
        seed_inside(order, f, b, sigma, n);
      });
  for (const CornerBesideLine& c : sources.corners)
    offer(order, triangles_[c.face].corner[c.corner], c.distance,
          {3 * c.face + c.corner, c.back.along, c.back.off}, c.number);
  for (const LineLight& light : sources.lights) {
    const Window<double> window = light.window();
    const double length = static_cast<double>(triangles_[light.face].length[light.edge]);
    if (light.into)
      enter(order, light.face << 2 | light.edge, window, light.number);
    else
      leave(order, light.face, light.edge, window.mirrored(length), light.number);
  }
}

template <class Real>
template <class Order>
bool ExactWindows<Real>::fill_holes(Order& order) {
  if (radius_ < infinity) return false;
  return fill_holes(
      triangles_, own_, [&](Index v) { return distance_[v]; },
      [&](Index v, Index w, double way) { offer(order, w, way, {}, source(v)); });
}

}  // namespace plexway::detail::windows

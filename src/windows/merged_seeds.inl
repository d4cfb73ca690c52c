// Where merged windows begin and end: at the sources, at messages, and again at what no window
// reached; what they hold. Part of merged_windows.cpp.

namespace plexway::detail::windows {

template <class Real>
void MergedWindows<Real>::begin(const WindowSources& sources, const PropagateOptions& options,
                                const MergeLimit& limit, std::vector<Real>& distance) {
  const double unit = sheet_.mesh->unit();
  limit_ = limit;
  kept_ = nullptr;
  labels_ = sources.labels;
  distance.assign(sheet_.vertex_count, unreached<Real>);
  distance_ = distance.data();
  error_.resize(sheet_.vertex_count);
  if (labels_) source_.resize(sheet_.vertex_count);
  if (!complete_) waiting_at_.clear(), shining_at_.clear();
  blocks_.clear();
  shining_.clear();
  arrivals_.resize(sheet_.shared);
  free_block_ = free_shining_ = none;
  waits_ = false;
  complete_ = false;  // until all is done: a callback may throw
  statistics_ = {};
  radius_ = static_cast<Real>(options.radius / unit);
  least_offset_ = std::numeric_limits<double>::infinity();
  for (const PointSource& s : sources.points)
    least_offset_ = std::min(least_offset_, s.offset / unit);
  scale_ = scale_at(least_offset_);
  ring_.start(merged_bucket_width);
  leaving_.start(sheet_.shared);
}

template <class Real>
bool MergedWindows<Real>::too_many(std::size_t turns, std::size_t triangles) {
  return turns > merge_patience * 3 * triangles + merged_share;
}

template <class Real>
void MergedWindows<Real>::take(const Message<Real>& message) {
  const auto admit = [&](Real near) {
    ring_.admit(static_cast<double>(near), [this](Index n) -> Index& { return next(n); });
  };
  const Window<Real>& w = message.window;
  if (!message.is_of_vertex()) {
    admit(turn_of(w));
    enter(ring_, message.to, w, message.source);
    return;
  }
  admit(w.at_begin);
  scale_ = scale_at(static_cast<double>(w.at_begin));
  static_cast<void>(know(ring_, message.vertex(), w.at_begin, message.corner, {w.beam.x, w.beam.h},
                         message.source, w.error));
}

template <class Real>
void MergedWindows<Real>::seed_vertex(Index vertex, double sigma, Index number) {
  offer(ring_, vertex, static_cast<Real>(sigma), none, {0, 0}, number, 0);
}

template <class Real>
void MergedWindows<Real>::seed_inside(Index f, const std::array<double, 4>& barycentric,
                                      double sigma, Index number) {
  seed_inside(ring_, f, barycentric, static_cast<Real>(sigma), number);
}

template <class Real>
void MergedWindows<Real>::seed_hole(Index vertex, Real distance, Index source, Real error) {
  offer(ring_, vertex, distance, none, {0, 0}, source, error);
}

template <class Real>
void MergedWindows<Real>::run_to(double horizon, std::size_t most) {
  ring_.set_horizon(horizon);
  if (!spread(ring_, most) && waits_ && !(ring_.nearest() < horizon)) {  // spent just so
    waits_ = false;
    commit_any(ring_, turns_[current_ ^ 1]);
  }
  complete_ = nearest() == unreached<double>;
}

/// After the last turn allowed: is there anything else to do?
template <class Real>
template <class Order>
typename MergedWindows<Real>::Outcome MergedWindows<Real>::left_over(Order& order) {
  const auto next_of = [this](Index n) -> Index& { return next(n); };
  const auto near_of = [this](Index n) { return static_cast<double>(near(n)); };
  while (order.pop(next_of, near_of) == none) {
    if (!waits_) return Outcome::done;
    waits_ = false;
    commit_any(order, turns_[current_ ^ 1]);
  }
  return Outcome::stopped;
}

/// Over the edges that it does not lie on, and to the corners.
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
    if (b[edge_before(e)] > on_edge<Real>) leave(order, f, e, window, number);
    offer(order, t.corner[e], sigma + static_cast<Real>(std::sqrt(x * x + h * h)),
          static_cast<Index>(3 * f + e), {static_cast<Real>(x), static_cast<Real>(h)}, number, 0);
  }
}

template <class Real>
template <class Order>
void MergedWindows<Real>::seed(Order& order, const WindowSources& sources) {
  const auto real = [](double x) { return static_cast<Real>(x); };
  const auto at_vertex = [&](Index v, double sigma, Index n) {
    offer(order, v, real(sigma), none, {0, 0}, n, 0);
  };
  const auto inside = [&](Index f, const std::array<double, 4>& b, double sigma, Index n) {
    triangles_at(triangles_, f, b, [&](Index g, const std::array<double, 4>& there, std::size_t k) {
      seed_inside(order, g, there, real(sigma), n);
      if (!kept_ || k == 3) return;  // what is read there looks for the source over the edge
      const Real length = triangles_[g].length[k];
      kept_->take(4 * g + static_cast<Index>(k),
                  {real(there[edge_after(k)]) * length, 0, 0, length}, real(sigma), n);
    });
  };
  for_each_seed(*sheet_.mesh, sources, at_vertex, inside);
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
      enter(order, light.face << 2 | light.edge, window, light.number);
    else
      leave(order, light.face, light.edge, window.mirrored(length), light.number);
  }
}

template <class Real>
template <class Order>
bool MergedWindows<Real>::fill_holes(Order& order) {
  if (radius_ < unreached<Real> || std::all_of(distance_, distance_ + sheet_.vertex_count,
                                               [](Real d) { return d < unreached<Real>; }))
    return false;
  return fill_holes(
      triangles_, own_, [&](Index v) { return distance_[v]; },
      [&](Index v, Index w, Real way) {
        offer(order, w, way, none, {0, 0}, labels_ ? source_[v] : 0, vertex_error(v));
      });
}

template <class Real>
std::size_t MergedWindows<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + of(source_) + of(error_) + of(shining_) + of(arrivals_) +
         of(own_distance_) + waiting_at_.bytes() + shining_at_.bytes() + of(blocks_) +
         of(corners_) + leaving_.bytes();
}

}  // namespace plexway::detail::windows

#include "apps/solid_read_out.hpp"

#include <algorithm>

namespace plexway {

template <class Real>
double SolidReadOut<Real>::at(Index t, const std::array<double, 4>& weight, ReadOut level) const {
  const TetRecord<Real>& record = mesh_.tets()[t];
  const auto vertex = [&](std::size_t i) {
    return static_cast<double>(solved_.workspace.vertex[record.corner[i]]);
  };
  if (level == ReadOut::linear) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
      if (weight[i] > 0)  // other corners may be at infinity
        sum += weight[i] *
               static_cast<double>(solved_.field.distance[solved_.outer[record.corner[i]]]);
    return sum / mesh_.unit();
  }
  Point q = {0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i)
    q = q + static_cast<Real>(weight[i]) * mesh_.points()[record.corner[i]];
  double best = std::numeric_limits<double>::infinity();
  if (front_.reached(t)) best = static_cast<double>(rule_.distance_at(t, t, q));
  if (level == ReadOut::simplex) return best;
  for (std::size_t i = 0; i < 4; ++i)
    best =
        std::min(best, vertex(i) + static_cast<double>(norm(q - mesh_.points()[record.corner[i]])));
  for (const Index across : record.across) {
    const Index u = across >> TetAcross::tet_shift;
    if (u != mesh_.tet_count() && front_.reached(u))
      best = std::min(best, static_cast<double>(rule_.distance_at(u, t, q)));
  }
  return best;
}

template <class Real>
std::array<double, 3> SolidReadOut<Real>::gradient(Index t) const {
  const Point& centre = mesh_.tets()[t].centre;
  const Point away = centre - rule_.seen_from(t, centre).eye;
  const Real length = norm(away);
  if (!(length > 0)) return {0, 0, 0};
  return {static_cast<double>(away.x / length), static_cast<double>(away.y / length),
          static_cast<double>(away.z / length)};
}

template class SolidReadOut<float>;
template class SolidReadOut<double>;

}  // namespace plexway

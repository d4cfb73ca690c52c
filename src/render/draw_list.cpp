#include "draw_list.hpp"

#include <algorithm>
#include <cmath>

namespace plexway::render {
namespace {

constexpr Others nothing_else = {{1e30f, 1e30f}, {by_value, by_value}};

Corner packed(const Vertex& v) {
  Corner corner{};
  for (std::size_t k = 0; k < 3; ++k) {
    corner.position[k] = static_cast<float>(v.position[k]);
    corner.normal[k] =
        static_cast<std::int16_t>(std::lround(32767 * std::clamp(v.normal[k], -1.0, 1.0)));
  }
  corner.value = static_cast<float>(v.value);
  corner.paint = v.paint;
  return corner;
}

}  // namespace

void Batch::add(const Vertex& a, const Vertex& b, const Vertex& c) {
  const bool more = a.others.has_value();
  if (more && others.empty()) others.assign(corners.size(), nothing_else);
  for (const Vertex* v : {&a, &b, &c}) {
    corners.push_back(packed(*v));
    if (more || !others.empty()) others.push_back(v->others.value_or(nothing_else));
  }
}

Vertex between(const Vertex& a, const Vertex& b, double t) {
  Vertex v = a;
  v.position = between(a.position, b.position, t);
  v.normal = unit_or_zero(between(a.normal, b.normal, t));
  v.value = (1 - t) * a.value + t * b.value;
  if (v.others)
    for (std::size_t k = 0; k < 2; ++k)
      v.others->value[k] = static_cast<float>((1 - t) * static_cast<double>(a.others->value[k]) +
                                              t * static_cast<double>(b.others->value[k]));
  return v;
}

void add_clipped(Batch& batch, const std::optional<Plane>& plane, const Vertex& a, const Vertex& b,
                 const Vertex& c) {
  if (!plane) return batch.add(a, b, c);
  const std::array<const Vertex*, 3> corners = {&a, &b, &c};
  std::array<double, 3> over{};
  for (std::size_t k = 0; k < 3; ++k) over[k] = plane->over(corners[k]->position);
  if (over[0] <= 0 && over[1] <= 0 && over[2] <= 0) return batch.add(a, b, c);
  std::vector<Vertex> kept;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (over[k] <= 0) kept.push_back(*corners[k]);
    if ((over[k] <= 0) != (over[next] <= 0))
      kept.push_back(between(*corners[k], *corners[next], over[k] / (over[k] - over[next])));
  }
  for (std::size_t k = 2; k < kept.size(); ++k) batch.add(kept[0], kept[k - 1], kept[k]);
}

}  // namespace plexway::render

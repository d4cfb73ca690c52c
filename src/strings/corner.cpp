#include "strings/corner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plexway::detail::strings {
namespace {

constexpr double angle_slack = 1e-6;  // of angles
constexpr double half_turn = std::numbers::pi - 1e-7;
constexpr double as_long = 1e-9;  // of two ways as long the one that passes more rows

double angle_between(const Point& p, const Point& q) {
  return std::atan2(norm(cross(p, q)), dot(p, q));
}

}  // namespace

void Corner::look(const SolidSpace& space, Index vertex) {
  const Point& at = space.point(vertex);
  sides_.clear();
  for (const auto& [v, f] : space.faces_at(vertex)) {
    const Boundary::Face& face = space.face(f);
    std::size_t k = 0;
    while (face.corner[k] != vertex) ++k;
    const Point a = space.point(face.corner[(k + 1) % 3]) - at,
                b = space.point(face.corner[(k + 2) % 3]) - at;
    const Point& n = face.normal;
    sides_.push_back({n, {unit(cross(n, a)), unit(cross(b, n))}});
  }
  for (const auto& [v, row] : space.rows_at(vertex)) {
    const Place& p = space.places()[row];
    for (const bool up : {false, true})
      if (p.end[up ? 1 : 0] != vertex)
        nodes_.push_back({row, up ? p.along : -1. * p.along, 1e300, 0, false});
  }
}

// Does the solid have the directions between two?
bool Corner::is_open(const SolidSpace& space, const Node& a, const Node& b) const {
  const auto leads_off = [&](const Node& row, const Point& direction) {
    if (row.place == none) return true;
    const Place& place = space.places()[row.place];
    const double angle = place.angle_of(direction);
    return place.holds() || (angle > -angle_slack && angle < place.angle + angle_slack);
  };
  if (!leads_off(a, b.along) || !leads_off(b, a.along)) return false;
  return std::none_of(sides_.begin(), sides_.end(), [&](const Side& side) {
    const double before = dot(side.normal, a.along), behind = dot(side.normal, b.along);
    if (!(before > -angle_slack && behind < -angle_slack)) return false;
    const double share = std::max(before, 0.) / (std::max(before, 0.) - behind);
    const Point at = a.along + share * (b.along - a.along);
    return dot(side.inward[0], at) > angle_slack && dot(side.inward[1], at) > angle_slack;
  });
}

bool Corner::find(const SolidSpace& space, Index vertex, const Point& in, const Point& out) {
  if (norm(in) == 0 || norm(out) == 0 || angle_between(in, out) >= half_turn) return false;
  nodes_.clear();
  nodes_.push_back({none, unit(in), 0, 0, false});
  nodes_.push_back({none, unit(out), 1e300, 0, false});
  look(space, vertex);
  return find_other(space);
}

bool Corner::find_other(const SolidSpace& space) {
  for (std::size_t n = 1; n < nodes_.size(); ++n) {
    nodes_[n].done = nodes_[n].left_out;
    nodes_[n].turned = 1e300;
  }
  for (std::size_t now = 0; now != 1;) {
    nodes_[now].done = true;
    for (std::size_t n = 1; n < nodes_.size(); ++n) {
      if (nodes_[n].done || nodes_[n].place == nodes_[now].place) continue;
      const double turned = nodes_[now].turned + angle_between(nodes_[now].along, nodes_[n].along);
      if (turned >= std::min(half_turn, nodes_[n].turned + as_long)) continue;
      if (!is_open(space, nodes_[now], nodes_[n])) continue;
      nodes_[n].turned = turned;
      nodes_[n].before = now;
    }
    now = 0;
    for (std::size_t n = 1; n < nodes_.size(); ++n)
      if (!nodes_[n].done && nodes_[n].turned < half_turn &&
          (now == 0 || nodes_[n].turned < nodes_[now].turned))
        now = n;
    if (now == 0) return false;
  }
  turned_ = nodes_[1].turned;
  rows_.clear();
  for (std::size_t n = nodes_[1].before; n != 0; n = nodes_[n].before) {
    rows_.push_back({nodes_[n].place, nodes_[n].along, nodes_[n].turned});
    if (nodes_[n].before == 0) nodes_[n].left_out = true;
  }
  std::reverse(rows_.begin(), rows_.end());
  return true;
}

}  // namespace plexway::detail::strings

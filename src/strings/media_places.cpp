#include "strings/media_builder.hpp"

namespace plexway::detail::strings {
void MediaSpace::Builder::find_patches() {
  std::map<Edge, std::vector<Index>> at;
  for (Index i = 0; i < interfaces.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      at[edge_of(interfaces[i].corner[k], interfaces[i].corner[(k + 1) % 3])].push_back(i);
  DisjointSets sets(interfaces.size());
  const auto one = [&](const Interface& a, const Interface& b) {
    if (a.media != b.media) return false;
    if (alike(a.normal, b.normal)) return a.above == b.above && a.below == b.below;
    return alike(a.normal, -1. * b.normal) && a.above == b.below && a.below == b.above;
  };
  for (const auto& [edge, all] : at)
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = i + 1; j < all.size(); ++j)
        if (one(interfaces[all[i]], interfaces[all[j]])) sets.unite(all[i], all[j]);
  for (Index i = 0; i < interfaces.size(); ++i) {
    const Index r = sets.find(i);
    if (r == i) {
      interfaces[i].patch = static_cast<Index>(patch_faces.size());
      patch_faces.emplace_back();
    }
    patch_faces[interfaces[i].patch = interfaces[r].patch].push_back(i);
  }
  for (const auto& [edge, all] : at) {
    std::vector<Index> borders;  // patches with one triangle here
    for (const Index i : all) {
      std::size_t count = 0;
      for (const Index j : all) count += interfaces[j].patch == interfaces[i].patch;
      if (count == 1) add(borders, interfaces[i].patch);
    }
    if (borders.empty()) continue;
    line_at[edge] = static_cast<Index>(lines.size());
    lines.push_back({edge, {}, borders, {}, false, none});
  }
}

void MediaSpace::Builder::find_touching() {
  std::vector<Edge> inside;
  for (const Interface& i : interfaces)
    for (std::size_t k = 0; k < 3; ++k)
      inside.push_back(edge_of(i.corner[k], i.corner[(k + 1) % 3]));
  std::sort(inside.begin(), inside.end());
  std::vector<std::pair<Edge, Index>> at;  // and the medium
  for (Index t = 0; t < parts.tets.size(); ++t)
    for (const auto& e : tet_edge_ends) {
      const Edge edge = edge_of(parts.tets[t][e[0]], parts.tets[t][e[1]]);
      if (space.nodes_at(edge[0]).size() > 1 && space.nodes_at(edge[1]).size() > 1 &&
          !std::binary_search(inside.begin(), inside.end(), edge))
        at.push_back({edge, medium_of_tet[t]});
    }
  std::sort(at.begin(), at.end());
  for (std::size_t i = 1; i < at.size(); ++i)
    if (at[i].first == at[i - 1].first && at[i].second != at[i - 1].second &&
        line_at.insert({at[i].first, static_cast<Index>(lines.size())}).second)
      lines.push_back({at[i].first, {}, {}, {}, false, none});
}

void MediaSpace::Builder::find_lines() {
  for (Index e = 0; e < parts.edges.size(); ++e) {
    const Edge edge = edge_of(parts.edges[e][0], parts.edges[e][1]);
    const auto [at, is_new] = line_at.insert({edge, static_cast<Index>(lines.size())});
    if (is_new) lines.push_back({edge, {}, {}, {}, false, none});
    lines[at->second].is_wire = true;
    add(lines[at->second].media, medium_of_edge[e]);
  }
  find_touching();
  const auto line = [&](Index a, Index b) -> Line* {
    const auto at = line_at.find(edge_of(a, b));
    return at == line_at.end() ? nullptr : &lines[at->second];
  };
  for (Index t = 0; t < parts.tets.size(); ++t)
    for (const auto& e : tet_edge_ends)
      if (Line* l = line(parts.tets[t][e[0]], parts.tets[t][e[1]])) {
        add(l->media, medium_of_tet[t]);
        l->wedges.push_back({medium_of_tet[t], wedge_of(t, l->end)});
      }
  for (Index f = 0; f < this->faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      if (Line* l = line(this->faces[f][k], this->faces[f][(k + 1) % 3])) {
        add(l->media, medium_of_face[f]);
        const Point& up = space.media_[medium_of_face[f]].up;
        const Point &a = points[l->end[0]], along = strings::unit(points[l->end[1]] - a),
                    off = points[this->faces[f][(k + 2) % 3]] - a,
                    in = strings::unit(off - dot(off, along) * along);
        l->wedges.push_back({medium_of_face[f], {{in, up}, strings::unit(in + up)}});
      }
}

void MediaSpace::Builder::find_rows() {
  std::map<Index, std::vector<Index>> at;
  for (Index l = 0; l < lines.size(); ++l)
    for (const Index v : lines[l].end) at[v].push_back(l);
  DisjointSets sets(lines.size());
  for (const auto& [v, all] : at)
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = i + 1; j < all.size(); ++j) {
        const Line &a = lines[all[i]], &b = lines[all[j]];
        if (a.media != b.media || a.patches != b.patches || a.is_wire != b.is_wire) continue;
        const auto from = [&, v = v](const Line& l) {
          return strings::unit(points[l.end[0] == v ? l.end[1] : l.end[0]] - points[v]);
        };
        if (alike(from(a), -1. * from(b))) sets.unite(all[i], all[j]);
      }
  for (Index l = 0; l < lines.size(); ++l) {
    const Index r = sets.find(l);
    if (r == l) {
      lines[l].row = static_cast<Index>(row_lines.size());
      row_lines.emplace_back();
    }
    row_lines[lines[l].row = lines[r].row].push_back(l);
  }
}

void MediaSpace::Builder::make_places() {
  std::vector<Place>& places = space.places_;
  const Point zero = {0, 0, 0};
  for (Medium& m : space.media_) {
    m.first_bend = static_cast<Index>(places.size());
    if (m.room) places.insert(places.end(), m.room->places().begin(), m.room->places().end());
  }
  space.first_patch_ = static_cast<Index>(places.size());
  std::vector<std::vector<Index>> media_at;  // of patches, then of rows
  space.at_.resize(points.size());
  for (const auto& faces : patch_faces) {
    const Interface& first = interfaces[faces[0]];
    Place place{points[first.corner[0]], zero, -unbounded, unbounded, zero, zero, zero, 0};
    place.along = strings::unit(points[first.corner[1]] - place.origin);
    place.wide = cross(first.normal, place.along);
    place.is_plane = true;
    for (const Index i : faces)
      for (const Index v : interfaces[i].corner)
        add(space.at_[v], static_cast<Index>(places.size()));
    space.patches_.push_back({first.normal, first.above, first.below, {}, {}});
    media_at.push_back(first.media);
    places.push_back(place);
  }
  space.first_row_ = static_cast<Index>(places.size());
  for (const auto& own : row_lines) {
    const Line& first = lines[own[0]];
    const auto number = static_cast<Index>(places.size());
    Place place{points[first.end[0]], zero, 0, 0, zero, zero, zero, 0};
    place.along = strings::unit(points[first.end[1]] - place.origin);
    std::array<Index, 2> ends = {first.end[0], first.end[0]};
    for (const Index l : own)
      for (const Index v : lines[l].end) {
        const double t = dot(points[v] - place.origin, place.along);
        if (t < place.low) place.low = t, ends[0] = v;
        if (t > place.high) place.high = t, ends[1] = v;
        if (first.media.size() > 1) add(space.at_[v], number);
      }
    space.ends_.push_back(ends);
    std::vector<Index> patches;
    for (const Index p : first.patches) {
      patches.push_back(space.first_patch_ + p);
      Patch& patch = space.patches_[p];
      const Place& plane = places[space.first_patch_ + p];
      std::array<double, 4> side;
      for (std::size_t k = 0; k < 2; ++k) {
        const Point d = points[ends[k]] - plane.origin;
        side[2 * k] = dot(d, plane.along);
        side[2 * k + 1] = dot(d, plane.wide);
      }
      patch.rows.push_back(number);
      patch.sides.push_back(side);
    }
    space.patches_of_.push_back(patches);
    media_at.push_back(first.media);
    places.push_back(place);
  }
  for (Index m = 0; m < space.media_.size(); ++m)
    if (const auto& medium = space.media_[m]; medium.room)
      for (std::size_t i = 0; i < medium.room->places().size(); ++i) {
        space.first_door_.push_back(static_cast<Index>(space.doors_.size()));
        space.doors_.push_back({medium.first_bend + static_cast<Index>(i), m, 0, 0});
      }
  for (Index p = space.first_patch_; p < places.size(); ++p) {
    space.first_door_.push_back(static_cast<Index>(space.doors_.size()));
    for (const Index m : media_at[p - space.first_patch_]) {
      Door door{p, m, static_cast<Index>(space.wedges_.size()), 0};
      if (p >= space.first_row_) {
        const Line& line = lines[row_lines[p - space.first_row_][0]];
        for (const auto& [medium, wedge] : line.wedges)
          if (medium == m) space.wedges_.push_back(wedge);
      }
      door.last_wedge = static_cast<Index>(space.wedges_.size());
      space.doors_.push_back(door);
    }
  }
  space.first_door_.push_back(static_cast<Index>(space.doors_.size()));
}

Boundary::Wedge MediaSpace::Builder::wedge_of(Index t, const Edge& edge) const {
  const Point along = strings::unit(points[edge[1]] - points[edge[0]]);
  Point side[2];
  std::size_t n = 0;
  for (const Index v : parts.tets[t]) {
    if (v == edge[0] || v == edge[1]) continue;
    const Point d = points[v] - points[edge[0]];
    side[n++] = strings::unit(d - dot(d, along) * along);
  }
  const auto inward = [&](const Point& in, const Point& off) {
    return strings::unit(off - dot(off, in) * in);
  };
  return {{inward(side[0], side[1]), inward(side[1], side[0])}, strings::unit(side[0] + side[1])};
}

}  // namespace plexway::detail::strings

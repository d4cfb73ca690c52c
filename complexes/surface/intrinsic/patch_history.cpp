#include "complexes/surface/intrinsic/patch_history.hpp"

#include <algorithm>
#include <limits>

namespace plexway::detail {
namespace {

using PatchCorners = std::array<std::uint8_t, 3>;

Planar place(const std::array<Planar, 3>& corner, const std::array<double, 3>& at) {
  return at[0] * corner[0] + at[1] * corner[1] + at[2] * corner[2];
}

// From the patch's order of corners to that of the slot.
std::array<double, 3> in_slot(const CornerOrder& order, const std::array<double, 3>& at) {
  std::array<double, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) result[order(k)] = at[k];
  return result;
}
std::array<double, 3> in_patch(const CornerOrder& order, const std::array<double, 3>& at) {
  return {at[order(0)], at[order(1)], at[order(2)]};
}

// How far a point is within a triangle: the least distance to an edge if it is inside, and if not,
// minus how far the coordinates that it would get are off. A length, so that triangles compare, and
// a flat one counts for the points on its line only.
double depth(const std::array<Planar, 3>& corner, const std::array<double, 3>& at, Planar point) {
  if (!(std::min({at[0], at[1], at[2]}) > 0)) return -norm(place(corner, clamped(at)) - point);
  const double area = cross(corner[1] - corner[0], corner[2] - corner[0]);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
    least = std::min(least, at[i] * area / norm(corner[(i + 2) % 3] - corner[(i + 1) % 3]));
  return least;
}

}  // namespace

struct PatchHistory::Form {
  std::size_t before_count, after_count;
  std::array<PatchCorners, 2> before;
  std::array<PatchCorners, 3> after;

  // The triangle before the patch that a point is in: the one above the x axis, or the one below.
  [[nodiscard]] std::size_t side(double y) const { return before_count == 2 && y < 0 ? 1 : 0; }
  [[nodiscard]] Index earlier(const Patch& patch, std::size_t k) const { return patch.link[k]; }
  [[nodiscard]] Index later(const Patch& patch, std::size_t k) const {
    return patch.link[before_count + k];
  }
};

namespace {

constexpr std::uint8_t a = 0, b = 1, c = 2, d = 3, p = 3;

}  // namespace

const std::array<PatchHistory::Form, 3> PatchHistory::forms = {{
    {2, 2, {{{a, b, c}, {b, a, d}}}, {{{a, d, c}, {b, c, d}}}},
    {1, 3, {{{a, b, c}}}, {{{a, b, p}, {b, c, p}, {c, a, p}}}},
    {1, 2, {{{a, b, c}}}, {{{a, p, c}, {p, b, c}}}},
}};

const PatchHistory::Form& PatchHistory::form_of(const Patch& patch) { return forms[patch.kind()]; }

std::array<Planar, 3> PatchHistory::points_of(const Patch& patch, const PatchCorners& corners) {
  const std::array<Planar, 4> point = {Planar{0, 0}, Planar{patch.length, 0}, patch.c, patch.other};
  return {point[corners[0]], point[corners[1]], point[corners[2]]};
}

// Among the triangles after; their number if it is none of them.
std::size_t PatchHistory::place_of(const Patch& patch, Index slot) {
  const std::size_t count = form_of(patch).after_count;
  std::size_t k = 0;
  while (k < count && patch.slot(k) != slot) ++k;
  return k;
}

void PatchHistory::add(const Change& change) {
  const std::size_t kind = static_cast<std::size_t>(change.kind);
  Patch patch{change.length, change.c, change.other, {none, none, none, none}, {}};
  for (std::size_t k = 0; k < 2; ++k)
    patch.packed[k] = change.slot[k] << 4 | static_cast<Index>(kind >> k & 1) << 3 |
                      static_cast<Index>(change.order[k].mirrored) << 2 | change.order[k].first;
  const Form& form = forms[kind];
  std::vector<Patch>& patches = patches_.own();
  std::vector<Index>& lasts = last_.own();
  const Index number = static_cast<Index>(patches.size());
  for (std::size_t k = 0; k < form.after_count; ++k) {
    const Index slot = patch.slot(k);
    if (slot >= lasts.size()) lasts.resize(slot + 1, none);
    Index& last = lasts[slot];
    if (k < form.before_count) {
      patch.link[k] = last;
      if (last != none) {
        Patch& before = patches[last];
        before.link[form_of(before).before_count + place_of(before, slot)] = number;
      }
    }
    last = number;
  }
  patches.push_back(patch);
}

bool PatchHistory::sound(std::size_t first_slots) const {
  const std::size_t slots = last_.size();
  const auto is_among = [&](Index number, Index slot, std::size_t(Form::*count)) {
    if (number >= patches_.size() || patches_[number].kind() >= forms.size()) return false;
    const Patch& patch = patches_[number];
    return place_of(patch, slot) < form_of(patch).*count;
  };
  for (Index s = 0; s < slots; ++s)
    if (last_[s] != none && !is_among(last_[s], s, &Form::after_count)) return false;
  for (Index number = 0; number < patches_.size(); ++number) {
    const Patch& patch = patches_[number];
    if (patch.kind() >= forms.size()) return false;
    const Form& form = form_of(patch);
    for (std::size_t k = 0; k < form.after_count; ++k) {
      const Index slot = patch.slot(k), later = form.later(patch, k);
      if (slot >= slots || (k >= form.before_count && slot < first_slots)) return false;
      if (later != none && (later <= number || !is_among(later, slot, &Form::before_count)))
        return false;
    }
    for (std::size_t k = 0; k < form.before_count; ++k) {
      const Index earlier = form.earlier(patch, k);
      if (patch.order(k).first > 2) return false;
      if (earlier != none &&
          (earlier >= number || !is_among(earlier, patch.slot(k), &Form::after_count)))
        return false;
    }
  }
  return true;
}

// Of a slot of the first triangulation: the patches of a slot lead back to it.
Index PatchHistory::first_of(Index slot) const {
  Index number = last_[slot];
  for (Index earlier = number; earlier != none;) {
    number = earlier;
    earlier = form_of(patches_[number]).earlier(patches_[number], place_of(patches_[number], slot));
  }
  return number;
}

SlotPoint PatchHistory::forward(SlotPoint point) const {
  for (Index number = first_of(point.slot); number != none;) {
    const Patch& patch = patches_[number];
    const Form& form = form_of(patch);
    const std::size_t k = place_of(patch, point.slot);
    const Planar at = place(points_of(patch, form.before[k]), in_patch(patch.order(k), point.at));
    std::size_t best = 0;
    double most = -std::numeric_limits<double>::infinity();
    std::array<double, 3> best_at{};
    for (std::size_t i = 0; i < form.after_count; ++i) {
      const auto corners = points_of(patch, form.after[i]);
      const auto share = barycentric(corners, at);
      const double inside = depth(corners, share, at);
      if (inside > most) most = inside, best = i, best_at = share;
    }
    point = {patch.slot(best), clamped(best_at)};
    number = form.later(patch, best);
  }
  return point;
}

SlotPoint PatchHistory::back(SlotPoint point) const {
  for (Index number = last_[point.slot]; number != none;) {
    const Patch& patch = patches_[number];
    const Form& form = form_of(patch);
    const Planar at = place(points_of(patch, form.after[place_of(patch, point.slot)]), point.at);
    const std::size_t k = form.side(at.y);
    point = {patch.slot(k),
             in_slot(patch.order(k), clamped(barycentric(points_of(patch, form.before[k]), at)))};
    number = form.earlier(patch, k);
  }
  return point;
}

void PatchHistory::back(const Piece& line, std::vector<Piece>& pieces) const {
  struct Open {
    Piece piece;
    Index patch;
  };
  std::vector<Open> open = {{line, last_[line.slot]}};
  while (!open.empty()) {
    const Open now = open.back();
    open.pop_back();
    if (now.patch == none) {
      pieces.push_back(now.piece);
      continue;
    }
    const Patch& patch = patches_[now.patch];
    const Form& form = form_of(patch);
    const auto corners = points_of(patch, form.after[place_of(patch, now.piece.slot)]);
    const Planar from = place(corners, now.piece.from), to = place(corners, now.piece.to);
    const auto add = [&](std::size_t k, Planar start, Planar end) {
      const auto before = points_of(patch, form.before[k]);
      open.push_back({{patch.slot(k), in_slot(patch.order(k), clamped(barycentric(before, start))),
                       in_slot(patch.order(k), clamped(barycentric(before, end)))},
                      form.earlier(patch, k)});
    };
    // A line along the x axis may lie on either side.
    const bool crosses =
        form.before_count == 2 && from.y != 0 && to.y != 0 && (from.y < 0) != (to.y < 0);
    if (!crosses) {
      add(form.side(from.y != 0 ? from.y : to.y), from, to);
      continue;
    }
    const double t = from.y / (from.y - to.y);
    Planar middle = from + t * (to - from);
    middle.y = 0;
    add(form.side(to.y), middle, to);  // the stack turns them round
    add(form.side(from.y), from, middle);
  }
}

}  // namespace plexway::detail

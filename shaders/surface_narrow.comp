#version 430
// Between settling and offers: every triangle that this round settled hears from the neighbour that
// its source sees before it, and takes over limits of that one's which are tighter
// (SaddleRule::may_hear_of_limits says when). One invocation an entry.
//
// What it heard stays with its entry until all have looked: the pass that makes the offers also makes
// it the triangle's label. So nobody reads what somebody writes.

#define Real float
const int K = 1;

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include kernel/hinge_kernel.inl
//@include labels/surface/saddle_step.inl
//@include surface.glsl
//@include front.glsl

layout(std430, binding = 2) readonly buffer Labels { SurfaceLabel labels[]; };
layout(std430, binding = 4) buffer WaitingLabels { SurfaceLabel waiting_labels[]; };

// Two labels are of one source if it is at the same place, within this share of its distance.
const float SAME_SOURCE = 1.0 / 128.0;

/// A limit as far from the source as the other label's is the same one.
bool tighter(SurfaceLabel label, SurfaceLabel other) {
  vec2 x = uintBitsToFloat(label.x.zw), h = uintBitsToFloat(label.h.zw);
  vec2 other_x = uintBitsToFloat(other.x.zw), other_h = uintBitsToFloat(other.h.zw);
  precise vec2 ours = x * x + h * h;
  precise vec2 theirs = other_x * other_x + other_h * other_h;
  return any(greaterThan(abs(theirs - ours), 0.01 * theirs));
}

/// The label of triangle f in its field, with what it heard; `heard` says if that is anything.
SurfaceLabel hear(SurfaceLabel label, uint f, uint field, float distance, out bool heard) {
  heard = false;
  float x = uintBitsToFloat(label.x.x), h = uintBitsToFloat(label.h.x);
  uint in_edge = label.h.y & 3u, before = edge_before(in_edge), after = edge_after(in_edge);
  float width = triangles[f].edge[in_edge];
  precise float to_left =
      x * abs(triangles[f].signed_sine[in_edge]) + h * triangles[f].cosine[in_edge];
  precise float to_right =
      (width - x) * abs(triangles[f].signed_sine[after]) + h * triangles[f].cosine[after];
  float behind = -64.0 * HINGE_EPSILON * (abs(x) + abs(h) + width);
  if (!(min(to_left, to_right) < behind) || !(h >= 0.0)) return label;

  bool left = to_left < to_right;
  uint over = left ? before : after, corner = left ? in_edge : over;
  uint across = triangles[f].across[over], g = across >> ACROSS_SHIFT, edge = across & ACROSS_EDGE;
  if ((across & (ACROSS_FLIP | ACROSS_FAN)) != 0u || g == triangle_count) return label;
  if (cells[field + g].known == UNREACHED) return label;
  SurfaceLabel other = labels[field + g];
  uint other_edge = other.h.y & 3u;
  float apart = abs(uintBitsToFloat(other.x.y) - uintBitsToFloat(label.x.y));
  if (other_edge == edge || other.h.y >> 2 != label.h.y >> 2) return label;
  if (!(apart <= SAME_SOURCE * distance) || !tighter(label, other)) return label;

  bool turns_left = edge == edge_before(other_edge);
  uint around = turns_left ? other_edge : edge;
  PosedSaddles there =
      turn_label(unpack(other), turns_left, triangles[g].edge[other_edge], triangles[g].edge[edge],
                 triangles[g].cosine[around], abs(triangles[g].signed_sine[around]));
  NarrowedLimits found = narrow_limits(
      unpack(label), there, left, width, triangles[f].edge[over], triangles[f].cosine[corner],
      abs(triangles[f].signed_sine[corner]), apex_over(f, in_edge), SAME_SOURCE * distance);
  for (int i = 0; i < 2; ++i) {
    if (!found.narrower[i]) continue;
    heard = true;
    label.x[2 + i] = floatBitsToUint(found.limit[i].x[0] - x);
    label.h[2 + i] = floatBitsToUint(found.limit[i].h - h);
  }
  return label;
}

void main() {
  start_group();
  uint number = invocation();
  if (number >= round_count) return;
  uint place = place_of(number);
  Entry entry = waiting[place];
  float distance = uintBitsToFloat(entry.distance);
  if (entry.cell == NO_CELL || distance >= limit) return;
  uint f = entry.cell % triangle_count;
  bool heard;
  SurfaceLabel label = hear(waiting_labels[place], f, entry.cell - f, distance, heard);
  if (!heard) return;
  waiting_labels[place] = label;
  waiting[place].round = HEARD;
}

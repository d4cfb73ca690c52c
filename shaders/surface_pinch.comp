#version 430
// A path may pass a vertex where fans of triangles only touch: it bends there (a hinge of dimension
// 0). One invocation a pinched vertex of a field. What it offers waits to be accepted
// (accept.comp).

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
layout(std430, binding = 6) readonly buffer Pinches { uint pinches[]; };  // where each begins
layout(std430, binding = 7) readonly buffer Corners { uint corners[]; };  // 3 f + i

uniform float radius;
uniform uint pinch_count, fields;

float corner_distance(uint cell, uint f, uint corner) {
  uint first = labels[cell].h.y & 3u;
  float hinge = triangles[f].edge[first];
  HingePoint q = saddle_point(0.0, 0.0);
  if (corner == edge_after(first)) q.x[0] = hinge;
  if (corner == edge_before(first)) q = apex_over(f, first);
  return path_length(unpack(labels[cell]), hinge, q);
}

/// The centre of triangle f from its corner.
float centre_distance(uint f, uint corner) {
  HingePoint apex = apex_over(f, corner);
  float x = (triangles[f].edge[corner] + apex.x[0]) / 3.0, h = apex.h / 3.0;
  return sqrt(x * x + h * h);
}

void main() {
  start_group();
  uint number = invocation();
  bool alive = number < pinch_count * fields;
  uint field = 0u, begin = 0u, end = 0u, source = 0u;
  float least = uintBitsToFloat(UNREACHED);
  if (alive) {
    field = number / pinch_count * triangle_count;
    begin = pinches[number % pinch_count];
    end = pinches[number % pinch_count + 1u];
  }
  for (uint n = begin; n < end; ++n) {
    uint f = corners[n] / 3u;
    if (cells[field + f].known == UNREACHED) continue;
    float d = corner_distance(field + f, f, corners[n] % 3u);
    if (d < least) {
      least = d;
      source = labels[field + f].h.y & ~3u;
    }
  }
  if (!(least < uintBitsToFloat(UNREACHED)) || least > radius) end = begin;

  // Within rounding of its own path a triangle stays with that one; else this would not end.
  const float epsilon = 1.1920929e-7;
  uint count = 0u, place = 0u;
  for (int turn = 0; turn < 2; ++turn) {
    if (turn == 1) place = reserve(uvec2(0u, count)).y;
    for (uint n = begin; n < end; ++n) {
      uint f = corners[n] / 3u, corner = corners[n] % 3u, known = cells[field + f].known;
      float d = least + centre_distance(f, corner);
      if (known != UNREACHED) {
        if (corner_distance(field + f, f, corner) <= least * (1.0 + 64.0 * epsilon)) continue;
        if (!(d < uintBitsToFloat(known) * (1.0 - 16.0 * epsilon))) continue;
      }
      if (turn == 0) {
        ++count;
        continue;
      }
      uint slot = place++;
      if (slot >= capacity) continue;
      uint at = far_queue * capacity + slot;
      waiting[at] = Entry(field + f, floatBitsToUint(d), round_number);
      PosedSaddles label;
      label.source = saddle_point(0.0, 0.0);
      label.limit[0] = label.source;
      label.limit[1] = label.source;
      label.sigma = least;
      waiting_labels[at] = pack(label, source | corner);
    }
  }
}

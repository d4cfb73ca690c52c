#version 430
// The last pass of a round along edges: every label that this round settled is offered to all
// neighbours of its vertex, one invocation a vertex. The hinge is a vertex, K = 0, where every path
// bends: what is left of the step is sigma + length (labels/wireframe/wire_propagation.hpp).

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include front.glsl

layout(std430, binding = 4) buffer WaitingLabels { uint waiting_labels[]; };  // the source
layout(std430, binding = 5) readonly buffer Rows { uint rows[]; };
layout(std430, binding = 6) readonly buffer Arcs { uvec2 arcs[]; };  // to, bits of the length

uniform uint vertex_count;
uniform float radius;

/// Does it beat the label that the vertex has, and is it not beaten by another offer?
bool wanted(uint target, uint distance) {
  return distance < cells[target].known && distance <= cells[target].least;
}

void main() {
  start_group();
  uint number = invocation();
  uint cell = 0u, bits = UNREACHED, made = 0u, source = 0u;
  bool alive = false, waits_on = false;
  if (number < round_count) {
    uint place = place_of(number);
    cell = waiting[place].cell;
    bits = waiting[place].distance;
    made = waiting[place].round;
    alive = cell != NO_CELL;
    if (alive) source = waiting_labels[place];
  }
  float sigma = uintBitsToFloat(bits);
  waits_on = alive && sigma >= limit;
  alive = alive && !waits_on && sigma <= radius;
  uint v = 0u, begin = 0u, end = 0u;
  if (alive) {
    v = cell % vertex_count;
    begin = rows[v];
    end = rows[v + 1u];
  }

  // Counted, then written: what is wanted only gets less, as the least distances fall.
  uvec2 count = uvec2(0u, waits_on ? 1u : 0u);
  for (uint k = begin; k < end; ++k) {
    float offer = sigma + uintBitsToFloat(arcs[k].y);
    if (!wanted(cell - v + arcs[k].x, floatBitsToUint(offer))) continue;
    if (offer < limit) ++count.x; else ++count.y;
  }
  uvec2 place = reserve(count), last = place + count;
  if (waits_on && place.y < capacity) {
    uint at = far_queue * capacity + place.y;
    waiting[at] = Entry(cell, bits, made);
    waiting_labels[at] = source;
  }
  if (waits_on) ++place.y;
  for (uint k = begin; k < end; ++k) {
    uint target = cell - v + arcs[k].x;
    float offer = sigma + uintBitsToFloat(arcs[k].y);
    uint distance = floatBitsToUint(offer);
    if (!wanted(target, distance)) continue;
    bool near = offer < limit;
    uint slot = near ? place.x++ : place.y++;
    // Without room it must not be accepted: the round will be repeated.
    if (slot >= capacity) continue;
    bool waits = lower(target, distance);
    uint at = (near ? near_queue : far_queue) * capacity + slot;
    waiting[at] = Entry(waits ? target : NO_CELL, distance, round_number);
    waiting_labels[at] = source;
  }
  // Places that were not needed after all.
  for (; place.x < min(last.x, capacity); ++place.x)
    waiting[near_queue * capacity + place.x].cell = NO_CELL;
  for (; place.y < min(last.y, capacity); ++place.y)
    waiting[far_queue * capacity + place.y].cell = NO_CELL;
}

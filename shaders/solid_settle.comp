#version 430
// The first half of a round in solids: the labels that this round expands are stored, so that in
// the second half all of them can be read by neighbours. Four invocations a label.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include front.glsl

layout(std430, binding = 2) writeonly buffer Labels { uvec4 labels[]; };
layout(std430, binding = 4) readonly buffer WaitingLabels { uvec4 waiting_labels[]; };

void main() {
  start_group();
  uint part = invocation() & 3u, number = invocation() >> 2;
  if (number >= round_count || part == 3u) return;
  uint place = current_queue * capacity + round_begin + number;
  uvec2 entry = waiting[place];
  if (entry.x == NO_CELL || best[entry.x] != entry.y) return;  // a better label waits elsewhere
  if (uintBitsToFloat(entry.y) >= limit) return;
  labels[3u * entry.x + part] = waiting_labels[3u * place + part];
}

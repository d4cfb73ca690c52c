#version 430
// Stores the labels that still wait when a propagation is stopped early. One invocation an entry.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include front.glsl

#ifdef PLEXWAY_WIRES
#define Label uint
#elif defined(PLEXWAY_SOLIDS)
struct Label { uvec4 a, b, c; };
#else
struct Label { uvec4 x, h; };
#endif

layout(std430, binding = 2) buffer Labels { Label labels[]; };
layout(std430, binding = 4) buffer WaitingLabels { Label waiting_labels[]; };

uniform uint first, count;  // places

void main() {
  uint i = invocation();
  if (i >= count) return;
  uvec2 entry = waiting[first + i];
  if (entry.x != NO_CELL && best[entry.x] == entry.y) labels[entry.x] = waiting_labels[first + i];
}

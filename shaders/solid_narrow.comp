#version 430
// Between settling and offers: every label that this round settled, if it has room for more limits,
// asks those of its neighbours again. One invocation an entry.
//
// What it heard stays with its entry until all have looked; then the same with PLEXWAY_ADOPT makes it
// the tetrahedron's label. So nobody reads what somebody writes.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include front.glsl

layout(std430, binding = 2) buffer Labels { uvec4 labels[]; };
layout(std430, binding = 4) buffer WaitingLabels { uvec4 waiting_labels[]; };

const uint HEARD = 0xffffffffu;  // as the round of an entry

#ifdef PLEXWAY_ADOPT
void look(uint place, Entry entry) {
  if (entry.round != HEARD) return;
  for (uint i = 0u; i < 4u; ++i) labels[4u * entry.cell + i] = waiting_labels[4u * place + i];
}
#else
//@include solid.glsl

void look(uint place, Entry entry) {
  uint at = 4u * place, t = entry.cell % tet_count;
  cell_base = entry.cell - t;
  uvec4 b = waiting_labels[at + 1u], c = waiting_labels[at + 2u];
  SolidLabel label = unpack(waiting_labels[at], b, c, waiting_labels[at + 3u]);
  if (!hears(t, label)) return;
  waiting_labels[at + 1u] = uvec4(b.x, label.ring, label.limit[0], label.limit[1]);
  waiting_labels[at + 2u] = uvec4(label.limit[2], label.limit[3], label.path, c.w);
  waiting_labels[at + 3u] = uvec4(label.limit[4], label.limit[5], 0u, 0u);
  waiting[place].round = HEARD;
}
#endif

void main() {
  start_group();
  uint number = invocation();
  if (number >= round_count) return;
  uint place = place_of(number);
  Entry entry = waiting[place];
  if (entry.cell != NO_CELL && uintBitsToFloat(entry.distance) < limit) look(place, entry);
}

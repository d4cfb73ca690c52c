#version 430
// The first pass of a round: what is no longer the least of its cell is taken out. Of equal
// distances the source with the lowest number counts, then the hinge. One invocation an entry.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include front.glsl
//@include front_label.glsl

void main() {
  start_group();
  uint number = invocation();
  if (number >= round_count) return;
  uint place = place_of(number);
  uvec2 entry = waiting[place];
  if (entry.x == NO_CELL) return;
  if (cells[entry.x].least != entry.y)
    waiting[place].x = NO_CELL;
  else if (uintBitsToFloat(entry.y) < limit)
    atomicMin(cells[entry.x].rank, rank_of(waiting_labels[place]));
}

#version 430
// Where two entries for one cell are of one distance, source and hinge: which is the older? One
// invocation an entry.

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
  Entry entry = waiting[place];
  if (entry.cell == NO_CELL || uintBitsToFloat(entry.distance) >= limit) return;
  if (cells[entry.cell].rank == rank_of(waiting_labels[place]))
    atomicMin(cells[entry.cell].age, age_of(entry.round, waiting_labels[place]));
}

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
  Entry entry = waiting[place];
  if (entry.cell == NO_CELL) return;
  if (cells[entry.cell].least != entry.distance) {
    waiting[place].cell = NO_CELL;
  } else if (uintBitsToFloat(entry.distance) < limit) {
    uint rank = rank_of(waiting_labels[place]);
    uint before = atomicMin(cells[entry.cell].rank, rank);
#ifndef PLEXWAY_WIRES  // where twins are alike
    // A twin: the same neighbour has offered the same distance before, by another label.
    if (before == rank) control.twin_dispatch[0] = control.settle_dispatch[0];
#endif
  }
}

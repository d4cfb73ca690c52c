#version 430
// The second pass of a round: who won becomes the label of its cell, who did not is taken out, and
// what is beyond the limit waits on. One invocation an entry.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include front.glsl
//@include front_label.glsl

bool wins(uint place, Entry entry) {
  uint rank = rank_of(waiting_labels[place]);
  if (control.twin_dispatch[0] != 0u) {
    if (cells[entry.cell].age != age_of(entry.round, waiting_labels[place])) return false;
  }
  // Only one of those that are alike in everything.
  return atomicCompSwap(cells[entry.cell].rank, rank, NO_RANK) == rank;
}

void main() {
  start_group();
  uint number = invocation(), place = place_of(number);
  if (number < round_count && waiting[place].cell != NO_CELL) {
    Entry entry = waiting[place];
    if (uintBitsToFloat(entry.distance) >= limit) {
      note_far(entry.distance);
    } else if (wins(place, entry)) {
      labels[entry.cell] = waiting_labels[place];
      if (cells[entry.cell].known == UNREACHED) note_reached();
      cells[entry.cell].known = entry.distance;
      cells[entry.cell].age = NO_RANK;
      note_settled();
    } else {
      waiting[place].cell = NO_CELL;
    }
  }
  end_group();
}

#version 430
// The second pass of a round: who won becomes the label of its cell, who did not is taken out, and
// what is beyond the limit waits on. One invocation an entry.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include front.glsl
//@include front_label.glsl

void main() {
  start_group();
  uint number = invocation(), place = place_of(number);
  uvec2 entry = number < round_count ? waiting[place] : uvec2(NO_CELL, UNREACHED);
  uint cell = entry.x;
  if (cell != NO_CELL) {
    if (uintBitsToFloat(entry.y) >= limit) {
      note_far(entry.y);
    } else {
      // Only one of those that are alike in everything.
      uint rank = rank_of(waiting_labels[place]);
      if (atomicCompSwap(cells[cell].rank, rank, NO_RANK) == rank) {
        labels[cell] = waiting_labels[place];
        if (cells[cell].known == UNREACHED) note_reached();
        cells[cell].known = entry.y;
        note_settled();
      } else {
        waiting[place].x = NO_CELL;
      }
    }
  }
  end_group();
}

#version 430
// Labels that were put into a queue without asking, seeds for one, are accepted or taken out again,
// as those of a round are. One invocation an entry.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include front.glsl

uniform uint first, count;  // places

void main() {
  start_group();
  uint i = invocation();
  if (i < count) {
    Entry entry = waiting[first + i];
    if (entry.cell != NO_CELL) {
      if (lower(entry.cell, entry.distance))
        note_accepted();
      else
        waiting[first + i].cell = NO_CELL;
    }
  }
  end_group();
}

#version 430
// Labels that were put into a queue without asking, seeds for one, are accepted or taken out again:
// the rule of the rounds, applied to what waits. One invocation an entry.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include front.glsl

uniform uint first, count;  // places

void main() {
  start_group();
  uint i = invocation();
  if (i < count) {
    uvec2 entry = waiting[first + i];
    if (entry.x != NO_CELL && !lower(entry.x, entry.y)) waiting[first + i].x = NO_CELL;
  }
  end_group();
}

// How a work group reserves room in the queues: its invocations count together, then one of them
// adds to the queue's end. All invocations of the group call each of these, in step.

layout(local_size_x = PLEXWAY_GROUP) in;

//@include front_control.glsl

/// Of each cell, by bits: the least distance offered, the least rank and age of those who offered
/// it while that is being found out, and the distance of the label it has.
struct Cell {
  uint least, rank, age, known;
};
layout(std430, binding = 1) coherent buffer Cells { Cell cells[]; };

/// A waiting label: cell, bits of the distance, and the round in which it was offered. The rest of
/// it lies in a buffer of its own.
struct Entry {
  uint cell, distance, round;
};
layout(std430, binding = 3) buffer Waiting { Entry waiting[]; };

// What holds during a round, fetched once a group.
shared uint current_queue, near_queue, far_queue;
shared uint round_begin, round_count, round_number, capacity;
shared float limit;

shared uint group_count[2];
shared uint group_base[2];
shared uint group_more;
shared uint group_nearest;
shared uint group_tally[3];  // settled, newly reached, accepted

uint invocation() {
  return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(PLEXWAY_GROUP) +
         gl_LocalInvocationID.x;
}

void in_step() {
  memoryBarrierShared();
  barrier();
}

void start_group() {
  if (gl_LocalInvocationID.x == 0u) {
    current_queue = control.current;
    near_queue = control.near;
    far_queue = control.far;
    round_begin = control.begin;
    round_count = control.count;
    round_number = control.rounds;
    capacity = control.capacity;
    limit = control.limit;
    group_nearest = UNREACHED;
    for (int i = 0; i < 3; ++i) group_tally[i] = 0u;
  }
  in_step();
}

/// The place of an entry of this round.
uint place_of(uint number) { return current_queue * capacity + round_begin + number; }

/// Room for so many near and far labels: places in the near and in the far queue.
uvec2 reserve(uvec2 wanted) {
  in_step();
  if (gl_LocalInvocationID.x == 0u) {
    group_count[0] = 0u;
    group_count[1] = 0u;
  }
  in_step();
  uvec2 place = uvec2(0u);
  if (wanted.x > 0u) place.x = atomicAdd(group_count[0], wanted.x);
  if (wanted.y > 0u) place.y = atomicAdd(group_count[1], wanted.y);
  in_step();
  if (gl_LocalInvocationID.x == 0u) {
    group_base[0] = 0u;
    group_base[1] = 0u;
    if (group_count[0] > 0u)
      group_base[0] = atomicAdd(control.waiting_in[near_queue], group_count[0]);
    if (group_count[1] > 0u)
      group_base[1] = atomicAdd(control.waiting_in[far_queue], group_count[1]);
  }
  in_step();
  return place + uvec2(group_base[0], group_base[1]);
}

/// True in all invocations if it is in one. (After a `reserve`, which keeps uses apart.)
bool any_in_group(bool mine) {
  if (gl_LocalInvocationID.x == 0u) group_more = 0u;
  in_step();
  if (mine) group_more = 1u;
  in_step();
  return group_more != 0u;
}

/// Lowers the least distance of a cell. True if this label must wait: nothing less is known yet, and
/// of equals contest.comp chooses.
bool lower(uint cell, uint distance) { return distance <= atomicMin(cells[cell].least, distance); }

/// Something waits on, so that the limit can jump to the nearest.
void note_far(uint distance) { atomicMin(group_nearest, distance); }
void note_settled() { atomicAdd(group_tally[0], 1u); }
void note_reached() { atomicAdd(group_tally[1], 1u); }
void note_accepted() { atomicAdd(group_tally[2], 1u); }

void end_group() {
  in_step();
  if (gl_LocalInvocationID.x != 0u) return;
  if (group_nearest != UNREACHED) atomicMin(control.nearest_far, group_nearest);
  uint settled = group_tally[0];
  if (settled > 0u) {
    atomicAdd(control.live, settled);
    uint before = atomicAdd(control.expansions[0], settled);
    if (before + settled < before) atomicAdd(control.expansions[1], 1u);
    before = atomicAdd(control.updates[0], settled);
    if (before + settled < before) atomicAdd(control.updates[1], 1u);
  }
  if (group_tally[1] > 0u) atomicAdd(control.reached, group_tally[1]);
  if (group_tally[2] > 0u) atomicAdd(control.accepted, group_tally[2]);
}

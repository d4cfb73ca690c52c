#version 430
// Between two rounds, by one invocation: which queue is expanded next, how much of it, and so how
// many work groups the passes of the next round have. A round that did not find room for all its
// offers stays where it is until the host has seen to it: its offers are made once more, from the
// labels that it settled.

layout(local_size_x = 1) in;

//@include front_control.glsl

uniform uint share;         // labels that one work group expands
uniform uint group;         // entries that one work group settles
uniform uint most_groups;   // in one dimension of a dispatch

void rest(uint why) {
  control.state = why;
  control.dispatch[0] = 0u;
  control.dispatch[1] = 1u;
  control.dispatch[2] = 1u;
  control.settle_dispatch[0] = 0u;
  control.settle_dispatch[1] = 1u;
  control.settle_dispatch[2] = 1u;
  control.twin_dispatch[0] = 0u;
}

// The dual queue's limit goes up by a step; where that brought nothing, to where something is.
void raise_limit() {
  bool stuck = control.was_far != 0u && control.live == 0u && control.nearest_far != UNREACHED;
  float from = stuck ? uintBitsToFloat(control.nearest_far) : control.limit;
  control.limit = from + control.step;
  if (!(from < control.limit))  // the step drowns in the distance
    control.limit = uintBitsToFloat(floatBitsToUint(from) + 1u);
  control.nearest_far = UNREACHED;
}

uint groups_for(uint entries, uint each) { return entries / each + (entries % each > 0u ? 1u : 0u); }

void main() {
  if (control.state != RUNNING) {
    rest(control.state);
    return;
  }
  uint near = control.near, far = control.far;
  if (control.waiting_in[near] > control.capacity || control.waiting_in[far] > control.capacity) {
    control.waiting_in[near] = control.near_before;
    control.waiting_in[far] = control.far_before;
    rest(OVERFLOWED);
    return;
  }
  control.begin += control.count;
  control.count = 0u;
  if (control.begin >= control.total) {
    control.waiting_in[control.current] = 0u;
    uint next = near;
    if (control.waiting_in[near] > 0u) {
      control.near = control.current;
      control.was_far = 0u;
    } else if (control.waiting_in[far] > 0u) {
      next = far;
      control.far = control.current;
      // What is still beyond the limit goes back to the far queue.
      raise_limit();
      control.was_far = 1u;
    } else {
      rest(DONE);
      return;
    }
    control.live = 0u;
    control.current = next;
    control.begin = 0u;
    control.total = control.waiting_in[next];
  }
  uint chunk = control.total - control.begin;
  if (control.budget[1] == 0u) {
    uint spent = control.expansions[0];
    uint left = control.expansions[1] > 0u || spent >= control.budget[0]
                    ? 0u
                    : control.budget[0] - spent;
    chunk = min(chunk, left);
  }
  if (chunk == 0u) {
    rest(OUT_OF_BUDGET);
    return;
  }
  // So many that a dispatch of two dimensions holds them.
  uint rows = groups_for(groups_for(chunk, share), most_groups);
  if (rows > most_groups) {
    rows = most_groups;
    chunk = min(chunk, most_groups * most_groups * share);
  }
  uint groups = groups_for(chunk, share), settling = groups_for(chunk, group);
  control.count = chunk;
  control.dispatch[0] = min(groups, most_groups);
  control.dispatch[1] = rows;
  control.dispatch[2] = 1u;
  control.settle_dispatch[0] = min(settling, most_groups);
  control.settle_dispatch[1] = groups_for(settling, most_groups);
  control.settle_dispatch[2] = 1u;
  control.twin_dispatch[0] = 0u;
  control.twin_dispatch[1] = control.settle_dispatch[1];
  control.twin_dispatch[2] = 1u;
  control.near_before = control.waiting_in[control.near];
  control.far_before = control.waiting_in[control.far];
  ++control.rounds;
}

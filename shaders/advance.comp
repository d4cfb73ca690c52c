#version 430
// Between two rounds, by one invocation: which queue is expanded next, how much of it, and so how
// many work groups the next round has. A round that did not find room for all its labels stays
// where it is until the host has seen to it: to repeat it does no harm, because a label that was
// accepted is not accepted again.

layout(local_size_x = 1) in;

//@include front_control.glsl

uniform uint share;         // labels that one work group expands
uniform uint most_groups;   // in one dimension of a dispatch

void rest(uint why) {
  control.state = why;
  control.count = 0u;
  control.dispatch[0] = 0u;
  control.dispatch[1] = 1u;
  control.dispatch[2] = 1u;
}

void main() {
  if (control.state != RUNNING) {
    rest(control.state);
    return;
  }
  uint near = control.near, far = control.far;
  if (control.waiting_in[near] > control.capacity || control.waiting_in[far] > control.capacity) {
    control.waiting_in[near] = min(control.waiting_in[near], control.capacity);
    control.waiting_in[far] = min(control.waiting_in[far], control.capacity);
    rest(OVERFLOWED);
    return;
  }
  control.begin += control.count;
  if (control.begin >= control.total) {
    control.waiting_in[control.current] = 0u;
    uint next = near;
    if (control.waiting_in[near] > 0u) {
      control.near = control.current;
    } else if (control.waiting_in[far] > 0u) {
      next = far;
      control.far = control.current;
      // What is still beyond the limit goes back to the far queue.
      float nearest = uintBitsToFloat(control.nearest_far);
      control.limit = max(control.limit, nearest) + control.step;
      if (!(nearest < control.limit))  // the step drowns in the distance
        control.limit = uintBitsToFloat(control.nearest_far + 1u);
      control.nearest_far = UNREACHED;
    } else {
      rest(DONE);
      return;
    }
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
  uint groups = chunk / share + (chunk % share > 0u ? 1u : 0u);
  uint rows = groups / most_groups + (groups % most_groups > 0u ? 1u : 0u);
  if (rows > most_groups) {
    rows = most_groups;
    chunk = min(chunk, most_groups * most_groups * share);
  }
  control.count = chunk;
  control.dispatch[0] = min(groups, most_groups);
  control.dispatch[1] = rows;
  control.dispatch[2] = 1u;
  ++control.rounds;
}

// What the host and all shaders of a propagation know of its state. The host's twin is
// FrontControl in src/executors/gl/front.hpp.
//
// Three queues change roles: labels being expanded, labels nearer than the limit that wait for the
// next round, and the others. `cell` is a simplex of one field: field times simplices, plus simplex.

const uint RUNNING = 0u;
const uint DONE = 1u;
const uint OVERFLOWED = 2u;
const uint OUT_OF_BUDGET = 3u;

const uint NO_CELL = 0xffffffffu;
const uint UNREACHED = 0x7f800000u;  // the bits of +inf

layout(std430, binding = 0) coherent buffer Control {
  uint dispatch[4];  // of the next round, for an indirect dispatch
  uint state;
  uint current, near, far;   // which queue has which role
  uint begin, count;         // of the current queue, what this round expands
  uint total;                // in the current queue
  uint capacity;             // of each queue
  uint waiting_in[4];        // in each queue; more than its capacity: it overflowed
  float limit, step;         // labels below the limit are near
  uint nearest_far;          // bits of the least distance in the far queue
  uint reached;              // cells that have a label
  uint expansions[2], updates[2];  // low and high word
  uint budget[2];            // expansions left
  uint rounds;
  uint spare;
} control;

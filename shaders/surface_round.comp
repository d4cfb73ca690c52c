#version 430
// The last pass of a round over surfaces: every label that this round settled is offered over the
// two hinges it did not come by, one invocation a hinge. Entries are fat: they carry the label, and
// a cell keeps no more than its least distance, lowered by an atomic minimum.
//
// With PLEXWAY_REVIVE: every reached triangle offers its label to unreached neighbours, taking
// updates that turn around a vertex where no path bends.

#define Real float
const int K = 1;

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include kernel/hinge_kernel.inl
//@include labels/surface/saddle_step.inl
//@include surface.glsl
//@include front.glsl

layout(std430, binding = 2) buffer Labels { SurfaceLabel labels[]; };
layout(std430, binding = 4) buffer WaitingLabels { SurfaceLabel waiting_labels[]; };

uniform float radius;       // triangles wholly beyond it are not expanded
uniform uint last_resort;
uniform uint cell_count;    // for PLEXWAY_REVIVE: fields times triangles

void main() {
  start_group();
  uint side = invocation() & 1u, number = invocation() >> 1;
  SurfaceLabel label;
  uint cell = 0u, bits = UNREACHED, made = 0u;
  bool alive = false, waits_on = false;
#ifdef PLEXWAY_REVIVE
  if (number < cell_count) {
    cell = number;
    bits = cells[cell].known;
    alive = bits != UNREACHED;
    if (alive) label = labels[cell];
  }
#else
  if (number < round_count) {
    uint place = place_of(number);
    cell = waiting[place].cell;
    bits = waiting[place].distance;
    made = waiting[place].round;
    alive = cell != NO_CELL;
    if (alive) label = waiting_labels[place];
  }
  bool later = alive && uintBitsToFloat(bits) >= limit;
  waits_on = later && side == 0u;
  alive = alive && !later;
  // What it heard of limits: this pass reads no labels.
  if (alive && side == 0u && made == HEARD) labels[cell] = label;
#endif

  uint f = cell % triangle_count, field = cell - f;
  uint in_edge = label.h.y & 3u;
  if (alive) {
    float distance = uintBitsToFloat(bits);
    if (distance > radius) {
      float longest = max(triangles[f].edge[0], max(triangles[f].edge[1], triangles[f].edge[2]));
      alive = distance - longest * (2.0 / 3.0) <= radius;  // no point is farther from its centre
    }
  }
  PosedSaddles here;
  uint cursor = 0u, out_edge = 0u;
  bool mirrored = false;
  SaddleHinge hinge;
  hinge.pivot = int(side);
  if (alive) {
    bool left = side == 0u;
    out_edge = left ? edge_before(in_edge) : edge_after(in_edge);
    uint corner = left ? in_edge : out_edge;
    here = turn_label(unpack(label), left, triangles[f].edge[in_edge], triangles[f].edge[out_edge],
                      triangles[f].cosine[corner], abs(triangles[f].signed_sine[corner]));
    cursor = triangles[f].across[out_edge];
    mirrored = (cursor & ACROSS_FLIP) != 0u;
  }

  // One triangle beyond, or all around an edge that several share.
  const float gain = 1.0 - 16.0 * 1.1920929e-7;
  for (bool more = true; more;) {
    uint g = cursor >> ACROSS_SHIFT, k = cursor & ACROSS_EDGE;
    alive = alive && g != triangle_count && !(g == f && k == out_edge);
    bool wanted = false;
    float distance = 0.0;
    SurfaceLabel offered;
    uint target = field + g;
    if (alive) {
      PosedSaddles entering = here;
      hinge.pivot = int(side);
      hinge.extent = triangles[g].edge[k];
      if (mirrored) {
        entering = mirror_label(entering, hinge.extent);
        hinge.pivot = 1 - hinge.pivot;
      }
      hinge.apex = apex_over(g, k);
      // By the sign bit: the sine itself may be 0.
      hinge.saddle[0] = (floatBitsToUint(triangles[g].signed_sine[k]) >> 31) != 0u;
      hinge.saddle[1] = (floatBitsToUint(triangles[g].signed_sine[edge_after(k)]) >> 31) != 0u;
      CrossedHinge crossed = cross_hinge(entering, hinge, last_resort != 0u);
      distance = crossed.distance;
      uint known = cells[target].known;
      // Around a bend all paths are equally long from both sides: a gain must be more than rounding.
      wanted = known == UNREACHED ? distance < uintBitsToFloat(UNREACHED)
                                  : distance < uintBitsToFloat(known) * gain;
#ifdef PLEXWAY_REVIVE
      wanted = wanted && known == UNREACHED;
#else
      wanted = wanted && floatBitsToUint(distance) <= cells[target].least;
#endif
      offered = pack(crossed.label, (label.h.y & ~3u) | k);
    }
#ifdef PLEXWAY_REVIVE
    bool near = false;
#else
    bool near = distance < limit;
#endif
    if (waits_on) {  // goes on as it is
      wanted = true;
      near = false;
      target = cell;
      distance = uintBitsToFloat(bits);
      offered = label;
    }
    uvec2 reserved = reserve(uvec2(wanted && near ? 1u : 0u, wanted && !near ? 1u : 0u));
    uint queue = near ? near_queue : far_queue;
    uint slot = near ? reserved.x : reserved.y;
    if (wanted && slot < capacity) {
      uint place = queue * capacity + slot;
#ifdef PLEXWAY_REVIVE
      bool waits = true;  // accepted by a pass of its own: no label that this pass reads may be new
#else
      bool waits = waits_on || lower(target, floatBitsToUint(distance));
#endif
      waiting[place] = Entry(waits ? target : NO_CELL, floatBitsToUint(distance),
                             waits_on ? made : round_number);
      waiting_labels[place] = offered;
    }
    waits_on = false;
    alive = alive && (cursor & ACROSS_FAN) != 0u;
    if (alive) {
      cursor = triangles[g].across[k];
      mirrored = mirrored == ((cursor & ACROSS_FLIP) != 0u);
    }
    more = any_in_group(alive);
  }
}

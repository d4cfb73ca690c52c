#version 430
// The last pass of a round in solids: every label that this round settled is offered over the three
// faces it did not come by; four invocations a label, one a face. Entries are fat, as on surfaces
// (surface_round.comp).

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include front.glsl

layout(std430, binding = 2) readonly buffer Labels { uvec4 labels[]; };
layout(std430, binding = 4) buffer WaitingLabels { uvec4 waiting_labels[]; };

//@include solid.glsl

uniform float radius;  // tetrahedra wholly beyond it are not expanded

void main() {
  start_group();
  uint face = invocation() & 3u, number = invocation() >> 2;
  uvec4 a, b;
  uint cell = 0u, bits = UNREACHED, made = 0u;
  bool alive = false, waits_on = false;
  if (number < round_count) {
    uint place = place_of(number);
    cell = waiting[place].cell;
    bits = waiting[place].distance;
    made = waiting[place].round;
    alive = cell != NO_CELL;
    if (alive) {
      a = waiting_labels[2u * place];
      b = waiting_labels[2u * place + 1u];
      bool later = uintBitsToFloat(bits) >= limit;
      waits_on = later && face == 0u;
      alive = !later && (b.x & 3u) != face;
    }
  }

  uint t = cell % tet_count;
  cell_base = cell - t;
  float distance = uintBitsToFloat(bits);
  if (alive && distance > radius) alive = distance - size_of(t) <= radius;
  uint across = 0u, u = 0u, known_bits = UNREACHED;
  if (alive) {
    across = tets[t].across[face];
    u = across >> 2;
    alive = u != tet_count;
  }
  if (alive) known_bits = cells[cell_base + u].known;

  bool wanted = false;
  SolidLabel label;
  if (alive) {
    // Around a bend all paths are equally long from both sides: a gain must be more than rounding.
    const float gain = 1.0 - 16.0 * HINGE_EPSILON;
    float known = known_bits == UNREACHED ? HINGE_INFINITY : uintBitsToFloat(known_bits) * gain;
    // Seeds were offered by the host: a source is never in t still.
    label = offer_plain(unpack(a, b), t, face, u, across & 3u, false, false);
    wanted = label.centre < known;
  }
  uint target = cell_base + u;
  bool near = false;
  if (wanted) {
    distance = label.centre;
    near = distance < limit;
    wanted = floatBitsToUint(distance) <= cells[target].least;
    a = floatBitsToUint(
        vec4(label.distance2[0], label.distance2[1], label.distance2[2], label.distance2[3]));
    b = uvec4((across & 3u) | KNOWN, floatBitsToUint(label.sigma), 0u, b.w);
  }
  if (waits_on) {  // goes on as it is
    wanted = true;
    target = cell;
  }
  uvec2 reserved = reserve(uvec2(wanted && near ? 1u : 0u, wanted && !near ? 1u : 0u));
  uint slot = near ? reserved.x : reserved.y;
  if (wanted && slot < capacity) {
    uint to = (near ? near_queue : far_queue) * capacity + slot;
    uint offered = floatBitsToUint(distance);
    waiting[to] = Entry(waits_on || lower(target, offered) ? target : NO_CELL, offered, waits_on ? made : round_number);
    waiting_labels[2u * to] = a;
    waiting_labels[2u * to + 1u] = b;
  }
}

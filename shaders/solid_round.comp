#version 430
// The last pass of a round in solids: every label that this round settled is offered over the three
// faces it did not come by; four invocations a label, one a face. Entries are fat, as on surfaces
// (surface_round.comp).
//
// As a repair: every reached tetrahedron offers its label to neighbours without one, or with one much
// longer than its own and the way between, with a bend on the face if need be. (Not a program of its
// own: the step takes long to compile.)

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include front.glsl

layout(std430, binding = 2) readonly buffer Labels { uvec4 labels[]; };
layout(std430, binding = 4) buffer WaitingLabels { uvec4 waiting_labels[]; };

//@include solid.glsl

uniform float radius;  // tetrahedra wholly beyond it are not expanded
uniform uint last_resort;
uniform uint repair;  // 0, or fields times tetrahedra

void main() {
  start_group();
  uint face = invocation() & 3u, number = invocation() >> 2;
  uvec4 a, b;
  uint cell = 0u, bits = UNREACHED, made = 0u;
  bool alive = false, waits_on = false;
  if (repair > 0u) {
    cell = min(number, repair - 1u);
    bits = cells[cell].known;
    alive = number < repair && bits != UNREACHED && uintBitsToFloat(bits) <= radius;
    if (alive) {
      a = labels[2u * cell];
      b = labels[2u * cell + 1u];
    }
  } else if (number < round_count) {
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
  if (alive && repair > 0u) {
    if (known_bits == UNREACHED) {
      atomicAdd(control.spare, 1u);
    } else {
      float excess = uintBitsToFloat(known_bits) - distance;
      alive = excess > norm(centre_of(u) - centre_of(t)) && excess > way(t, face);
    }
  }

  bool wanted = false;
  SolidLabel label;
  if (alive) {
    // Around a bend all paths are equally long from both sides: a gain must be more than rounding.
    const float gain = 1.0 - 16.0 * HINGE_EPSILON;
    float known = known_bits == UNREACHED ? HINGE_INFINITY : uintBitsToFloat(known_bits) * gain;
    SolidLabel from = unpack(a, b);
    from.centre = uintBitsToFloat(bits);
    vec3 q = centre_of(u);
    if (may_beat(from, straight_squared(from, q), known)) {
      if (any_reflex() || last_resort != 0u)
        wanted = offer_bent(from, t, face, u, known, last_resort != 0u, label);
      else
        wanted = offer_straight(from, t, face, q, label);
    }
  }
  uint target = cell_base + u;
  bool near = false;
  if (wanted) {
    distance = label.centre;
    near = distance < limit && repair == 0u;
    wanted = repair > 0u || floatBitsToUint(distance) <= cells[target].least;
    a = floatBitsToUint(vec4(label.source, label.sigma));
    uint state = (across & 3u) | KNOWN;
    if (is_unfolded(label)) state |= UNFOLDED | (label.door - unfolded_door) << 4;
    b = uvec4(state, label.bend[0], label.bend[1], b.w);
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
    // Repairs are accepted by a pass of its own: no label that this one reads may be new.
    bool waits = waits_on || repair > 0u || lower(target, offered);
    waiting[to] = Entry(waits ? target : NO_CELL, offered, waits_on ? made : round_number);
    waiting_labels[2u * to] = a;
    waiting_labels[2u * to + 1u] = b;
  }
}

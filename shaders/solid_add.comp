#version 430
// Labels found elsewhere wait to be accepted (accept.comp). One invocation a label.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include front.glsl

layout(std430, binding = 4) writeonly buffer WaitingLabels { uvec4 waiting_labels[]; };
struct Offer { uvec4 entry, a, b; };  // cell and bits of the distance; the label
layout(std430, binding = 5) readonly buffer Offers { Offer offers[]; };

uniform uint count;

void main() {
  start_group();
  uint i = invocation();
  uint slot = reserve(uvec2(0u, i < count ? 1u : 0u)).y;
  if (i < count && slot < capacity) {
    uint to = far_queue * capacity + slot;
    waiting[to] = Entry(offers[i].entry.x, offers[i].entry.y, round_number);
    waiting_labels[2u * to] = offers[i].a;
    waiting_labels[2u * to + 1u] = offers[i].b;
  }
}

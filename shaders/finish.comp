#version 430
// From the numbers and the unit inside to the caller's: nothing beyond the radius, +inf where
// unreached. One invocation a vertex of a field.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
layout(local_size_x = PLEXWAY_GROUP) in;

layout(std430, binding = 2) readonly buffer VertexSource { uint vertex_source[]; };
layout(std430, binding = 3) writeonly buffer Distances { uint distances[]; };
layout(std430, binding = 4) writeonly buffer Sources { uint sources[]; };
layout(std430, binding = 5) readonly buffer Inside { uint inside[]; };
layout(std430, binding = 6) readonly buffer VertexBest { uint vertex_best[]; };

uniform uint vertex_count, total;
uniform uint stride;  // of VertexBest; the last of so many numbers is meant
uniform float unit, radius;

void main() {
  uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(PLEXWAY_GROUP) +
           gl_LocalInvocationID.x;
  if (i >= total) return;
  uint v = i % vertex_count, from = i - v + inside[v];
  uint bits = vertex_best[from * stride + stride - 1u];
  float d = uintBitsToFloat(bits) * unit;
  bool known = bits < 0x7f800000u && d <= radius;
  distances[i] = known ? floatBitsToUint(d) : 0x7f800000u;
#ifdef PLEXWAY_LABELS
  uint source = vertex_source[from];  // surface_relax.comp puts a mark in the highest bit
  sources[i] = known && source != 0xffffffffu ? source & 0x7fffffffu : 0xffffffffu;
#endif
}

#version 430
// Vertices that have just the distance that a source itself offered them are that source's. One
// invocation an offer.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
layout(local_size_x = PLEXWAY_GROUP) in;

layout(std430, binding = 3) readonly buffer Offers { uvec4 offers[]; };  // vertex, distance, source
layout(std430, binding = 6) coherent buffer VertexBest { uint vertex_best[]; };
layout(std430, binding = 7) coherent buffer VertexSource { uint vertex_source[]; };

uniform uint count;
uniform uint who;  // 0: the offers are made, 1: they are looked up

void main() {
  uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(PLEXWAY_GROUP) +
           gl_LocalInvocationID.x;
  if (i >= count) return;
  uvec4 offer = offers[i];
  if (who == 0u)
    atomicMin(vertex_best[offer.x], offer.y);
  else if (vertex_best[offer.x] == offer.y)
    atomicMin(vertex_source[offer.x], offer.z);
}

#version 430
// One step per invocation over arrays of hinges: shows that the kernel text is legal GLSL for every
// K, and serves to compare a driver's arithmetic with the C++ build.
//
// GLSL has no include. Whoever loads this file replaces the marker line below by the text it names
// and puts `#define PLEXWAY_K 0..3` (and `#define PLEXWAY_DOUBLE` for doubles) after #version.

#ifdef PLEXWAY_DOUBLE
#define Real double
#define HINGE_EPSILON 2.220446049250313e-16LF
#define HINGE_TINY 4.5131406989220354e-277LF
#else
#define Real float
#endif
const int K = PLEXWAY_K;

//@include kernel/hinge_kernel.inl

layout(local_size_x = 64) in;

struct Input {  // squared lengths: edges of I, S and q and v to the vertices of I
  Real edge2[KE];
  Real source2[K + 1];
  Real probe2[K + 1];
  Real vertex2[K + 1];
};
struct Output { Real sigma; Real distance; Real visible; Real behind; };

layout(std430, binding = 0) readonly buffer Inputs { Input inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { Output outputs[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(outputs.length())) return;
  HingePose hinge = make_pose(inputs[i].edge2);
  HingePoint S = locate(hinge, inputs[i].source2);
  HingePoint q = locate(hinge, inputs[i].probe2);
  HingePoint v = locate(hinge, inputs[i].vertex2);
  HingeStep next = carry(hinge, S, Real(0), q, false, Real(0));
  HingeOffset o = offset(hinge, q, v, feet_squared(hinge, q, v));
  outputs[i].sigma = next.sigma;
  outputs[i].distance = sqrt(distance_squared(hinge, next.source, v));
  outputs[i].visible = next.visible ? Real(1) : Real(0);
  outputs[i].behind = behind(hinge, S, v, o.r2);
}

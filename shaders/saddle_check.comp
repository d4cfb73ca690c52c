#version 430
// One hinge per invocation by the default rule's step: serves to compare a driver's arithmetic with
// the C++ build.

#define Real float
const int K = 1;

//@include plexway/kernel/hinge_kernel.inl
//@include plexway/propagate/saddle_step.inl

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
layout(local_size_x = PLEXWAY_GROUP) in;

struct Input {
  float x[3], h[3];  // source, left and right limit
  float sigma, width, hinge, cosine, sine, apex_x, apex_h;
  uint flags;  // 1 left, 2 mirror, 4 and 8 saddles, 16 last resort
};
struct Output { float x[3], h[3]; float sigma, distance, corner; };

layout(std430, binding = 0) readonly buffer Inputs { Input inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { Output outputs[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(outputs.length())) return;
  PosedSaddles label;
  label.source = saddle_point(inputs[i].x[0], inputs[i].h[0]);
  label.limit[0] = saddle_point(inputs[i].x[1], inputs[i].h[1]);
  label.limit[1] = saddle_point(inputs[i].x[2], inputs[i].h[2]);
  label.sigma = inputs[i].sigma;
  uint flags = inputs[i].flags;
  bool left = (flags & 1u) != 0u;
  float hinge = inputs[i].hinge;
  label = turn_label(label, left, inputs[i].width, hinge, inputs[i].cosine, inputs[i].sine);
  SaddleHinge beyond;
  beyond.extent = hinge;
  beyond.apex = saddle_point(inputs[i].apex_x, inputs[i].apex_h);
  beyond.saddle[0] = (flags & 4u) != 0u;
  beyond.saddle[1] = (flags & 8u) != 0u;
  beyond.pivot = left ? 0 : 1;
  if ((flags & 2u) != 0u) {
    label = mirror_label(label, hinge);
    beyond.pivot = 1 - beyond.pivot;
  }
  CrossedHinge crossed = cross_hinge(label, beyond, (flags & 16u) != 0u);
  outputs[i].x[0] = crossed.label.source.x[0];
  outputs[i].h[0] = crossed.label.source.h;
  outputs[i].x[1] = crossed.label.limit[0].x[0];
  outputs[i].h[1] = crossed.label.limit[0].h;
  outputs[i].x[2] = crossed.label.limit[1].x[0];
  outputs[i].h[2] = crossed.label.limit[1].h;
  outputs[i].sigma = crossed.label.sigma;
  outputs[i].distance = crossed.distance;
  outputs[i].corner = path_length(crossed.label, hinge, beyond.apex);
}

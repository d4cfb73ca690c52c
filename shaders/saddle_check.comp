#version 430
// One hinge per invocation by the default rule's step: serves to compare a driver's arithmetic with
// the C++ build.

#define Real float
const int K = 1;

//@include kernel/hinge_kernel.inl
//@include labels/surface/saddle_step.inl

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
layout(local_size_x = PLEXWAY_GROUP) in;

struct Input {
  float x[3], h[3];  // source, left and right limit
  float sigma, width, hinge, cosine, sine, apex_x, apex_h;
  uint flags;  // 1 left, 2 mirror, 4 and 8 saddles, 16 last resort
};
struct Output {
  float x[3], h[3];
  float sigma, distance, corner;
  float limit_x[2], limit_h[2];
  uint narrower;
};

layout(std430, binding = 0) readonly buffer Inputs { Input inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { Output outputs[]; };

/// A label turned onto an edge, as a neighbour there would have posed it if it knew the same source
/// and limits halfway to it.
PosedSaddles seen_across(PosedSaddles turned, float hinge) {
  PosedSaddles other;
  other.sigma = turned.sigma;
  other.source = saddle_point(hinge - turned.source.x[0], -turned.source.h);
  for (int n = 0; n < 2; ++n)
    other.limit[n] = saddle_point(0.5 * (other.source.x[0] + (n == 0 ? 0.25 : 0.75) * hinge),
                                  0.5 * other.source.h);
  return other;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(outputs.length())) return;
  PosedSaddles label;
  label.source = saddle_point(inputs[i].x[0], inputs[i].h[0]);
  label.limit[0] = saddle_point(inputs[i].x[1], inputs[i].h[1]);
  label.limit[1] = saddle_point(inputs[i].x[2], inputs[i].h[2]);
  label.sigma = inputs[i].sigma;
  uint flags = inputs[i].flags;
  PosedSaddles arriving = label;
  bool left = (flags & 1u) != 0u;
  float hinge = inputs[i].hinge;
  label = turn_label(label, left, inputs[i].width, hinge, inputs[i].cosine, inputs[i].sine);
  PosedSaddles other = seen_across(label, hinge);
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
  HingePoint apex =
      left ? saddle_point(hinge * inputs[i].cosine, hinge * inputs[i].sine)
           : saddle_point(inputs[i].width - hinge * inputs[i].cosine, hinge * inputs[i].sine);
  NarrowedLimits found =
      narrow_limits(arriving, other, left, inputs[i].width, hinge, inputs[i].cosine,
                    inputs[i].sine, apex, 0.01 * inputs[i].width);
  for (int n = 0; n < 2; ++n) {
    outputs[i].limit_x[n] = found.limit[n].x[0];
    outputs[i].limit_h[n] = found.limit[n].h;
  }
  outputs[i].narrower = (found.narrower[0] ? 1u : 0u) | (found.narrower[1] ? 2u : 0u);
}

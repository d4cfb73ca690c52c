#version 430 core
// A corner of the draw list (src/render/draw_list.hpp).

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in float value;
layout(location = 3) in vec4 paint;
layout(location = 4) in vec2 other_values;
layout(location = 5) in vec4 other_paint_1;
layout(location = 6) in vec4 other_paint_2;

uniform mat4 to_clip;
uniform float inflate;  // along the normal, where w is 1
uniform float pull;     // towards the camera
uniform vec4 eye;       // the camera; or where it lies, fourth 0

out vec3 place;
out vec3 across;
out vec3 values;  // of up to three cells: the least counts
flat out vec4 paints[3];

void main() {
  float w = (to_clip * vec4(position, 1.0)).w;
  place = position + inflate * w * normal.xyz;
  place += pull * (eye.w > 0.5 ? normalize(eye.xyz - place) : eye.xyz);
  across = normal.xyz;
  values = vec3(value, other_values);
  paints[0] = paint;
  paints[1] = other_paint_1;
  paints[2] = other_paint_2;
  gl_Position = to_clip * vec4(place, 1.0);
}

#version 460
// For the test of inserted passes: how many groups the next step has, for the upper half of a picture.
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) uniform sampler2DArray picture;
layout(set = 0, binding = 1) writeonly buffer Arguments { uint groups[3]; };

void main() {
  ivec3 size = textureSize(picture, 0);
  groups[0] = uint(size.x + 7) / 8u;
  groups[1] = uint(size.y / 2) / 8u;
  groups[2] = uint(size.z);
}

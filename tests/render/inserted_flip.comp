#version 460
// For the test of inserted passes: red and blue of the picture so far change places where this runs; elsewhere
// it stays as it was copied.
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2DArray picture;
layout(set = 0, binding = 1, rgba16f) writeonly uniform image2DArray outputImage;

void main() {
  ivec3 at = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(at.xy, imageSize(outputImage).xy))) return;
  imageStore(outputImage, at, texelFetch(picture, at, 0).bgra);
}

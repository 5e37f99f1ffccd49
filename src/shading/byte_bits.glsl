// Flags in a channel of 8 bits.
#ifndef SCUMBLE_BYTE_BITS_GLSL
#define SCUMBLE_BYTE_BITS_GLSL
uint bitsOf(float channel) { return uint(channel * 255.0 + 0.5); }
float channelOf(uint bits) { return float(bits) / 255.0; }
#endif

// A hash of 32 bits, once for C++, its lanes and GLSL: words are `word`. Include after defining SHARED and that.

// Wellons's lowbias32. Seeds of scrambles must go through it: neighbouring or related ones would tie the coordinates of a point
// together.
SHARED word hash_bits(word x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

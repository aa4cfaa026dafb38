// Even random points, once for C++ and GLSL: words of 32 bits are `word`. Include after defining SHARED and that, and
// reverse_bits where the language has it, and after shading_hash.h.

#ifndef reverse_bits
// The bits in the other order.
SHARED word reverse_bits(word x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}
#endif

// Nested uniform scramble of a number whose bits are reversed: every bit flipped by a hash of the lower ones (Laine & Karras
// 2011; constants of Burley, JCGT 9(4), 2020).
SHARED word owen_hash(word x, word seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}
SHARED word owen_scramble(word x, word seed) { return reverse_bits(owen_hash(reverse_bits(x), seed)); }

// The second coordinate of Sobol's point `index` in units of 2^-32; the first is the index with its bits reversed.
SHARED word sobol_second(word index) {
  word y = 0u;
  word v = 0x80000000u;
  for (word i = index; i != 0u; i >>= 1) {
    if ((i & 1u) != 0u) y ^= v;
    v ^= v >> 1;
  }
  return y;
}

// [0, 1) in steps of 2^-24.
SHARED float unit_of(word x) { return float(x >> 8) * (1.0f / 16777216.0f); }

// Pixels take their rays one after the other from one sequence, so that no number is left out: leaving out every second one, say,
// would leave out half of the sphere. Number of the first ray of pixel `place`, at most 256, where pixels want `wanted`
// (1 ... 256) on average; the next pixel's first ray is where it ends.
SHARED word first_ray(word place, float wanted, word seed) { return (word(wanted * 4096.0f) * place + (hash_bits(seed) >> 20)) >> 12; }

// How many rounds of rays a tile of pixels takes, after the light of the first: `sum` and `squares` are those of the luminances
// of its `phases` phases, each the mean over pixels that look into the same directions; `around` and `sun` are what is seen of
// such light and of sunlight, which hides noise; `wanted` is as in first_ray; `open` is the luminance of the irradiance under the
// whole sky, 0 without one. The noise of the tile comes to a tenth of what is seen at the most, as far as sixteen rounds reach and a
// byte can count their rays. Tiles of less than four phases are not judged.
SHARED word rounds_of(float sum, float squares, float phases, float around, float sun, float wanted, float open) {
  if (phases < 4.0f || !(sum > 0.0f) || !(around > 0.0f)) return 1u;
  const float mean = sum / phases, seen = around / (around + sun);
  // What one ray in all would bring that met the sky: in a deep alley tiles whose rays missed it by chance know of no noise.
  const float missed = open / (phases * wanted);
  const float measured = (squares / phases - mean * mean) / phases, unknown = missed * missed;
  const float noise = (measured > unknown ? measured : unknown) / (mean * mean) * seen * seen;
  word rounds = 1u;
  while (rounds < 16u && noise > 0.01f * float(rounds) && float(rounds + 1u) * (wanted + 1.0f) < 255.0f) rounds += 1u;
  return rounds;
}

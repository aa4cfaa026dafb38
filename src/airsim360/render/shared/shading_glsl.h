// What GLSL lacks of the words that shading_shared.h uses. Pasted before it into a shader (GLSL 4.5).
#define real float
#define real3 vec3
#define ufloat float
#define ufloat3 vec3
#define mask_t bool
#define SHARED
#define INOUT(T) inout T
#define IN(T) T
#define make3 vec3
#define rmin min
#define rmax max
#define rroot sqrt
#define rfloor floor
#define rabs abs
#define dot3 dot
#define any_lane(m) (m)
float sel(bool m, float a, float b) { return m ? a : b; }
vec3 sel3(bool m, vec3 a, vec3 b) { return m ? a : b; }
float rsqrt_exact(float a) { return 1.0 / sqrt(a); }
float pow2_int(float i) { return intBitsToFloat((int(i) + 127) << 23); }
float exponent_of(float a) { return float((floatBitsToInt(a) >> 23) - 127); }
float mantissa_of(float a) { return intBitsToFloat((floatBitsToInt(a) & 0x007fffff) | 0x3f800000); }
// Tables by the low four or five bits of the exponent.
#define SHADE_TABLE16(name, a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15) \
  const float name[16] = float[16](a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15);
#define SHADE_TABLE32(name, a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, a16, a17, a18, a19, a20, a21, a22, a23, \
                      a24, a25, a26, a27, a28, a29, a30, a31)                                                                             \
  const float name[32] = float[32](a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, a16, a17, a18, a19, a20, a21,    \
                                   a22, a23, a24, a25, a26, a27, a28, a29, a30, a31);
#define octave16(table, a) (table[(floatBitsToInt(a) >> 23) & 15])
#define octave32(table, a) (table[(floatBitsToInt(a) >> 23) & 31])

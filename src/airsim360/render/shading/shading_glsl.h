// What GLSL lacks of the words that shading_shared.h uses. Pasted before it into a shader (GLSL 4.5).
#define real float
#define real3 vec3
#define ufloat float
#define ufloat3 vec3
#define mask_t bool
#define SHARED
#define INOUT(T) inout T
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

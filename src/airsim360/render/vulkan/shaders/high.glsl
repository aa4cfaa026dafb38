// Tier `high`: what its passes keep of a frame, plane after plane of one number a canonical pixel (render/high/high_buffers.h,
// render/filter/filter_planes.h), and its even random points (render/shading/sampling.h).

const uint kRange = 0, kId = 1, kShadingNormal = 2, kLight = 5, kData = 11, kSamples = 13, kWindow = 14, kOwn = 15, kLoose = 16,
           kVariance = 17, kTerms = 18, kSunFirst = 27, kKept = 28, kPlace = 29, kFacing = 32, kSunSeen = 35, kLeaf = 36, kClear = 37;
// Planes that later passes use for something else.
const uint kSunSmooth = kFacing, kRadiance = kWindow, kLuma = kVariance;
const uint kNoSurface = 0xffffffffu;

GpuCamera camera;
uint plane_size;
Floats planes;
Uints words;

/// False where the camera has no such pixel.
bool OpenPlanes(out uvec2 pixel) {
  camera = push.frame.v.cameras.v[gl_LaunchIDEXT.z];
  plane_size = camera.width * camera.height;
  planes = camera.planes;
  words = Uints(uvec2(camera.planes));
  pixel = gl_LaunchIDEXT.xy;
  return pixel.x < camera.width && pixel.y < camera.height;
}
float Get(uint plane, uint i) { return planes.v[plane * plane_size + i]; }
vec3 Get3(uint plane, uint i) { return vec3(Get(plane, i), Get(plane + 1, i), Get(plane + 2, i)); }
uint GetWord(uint plane, uint i) { return words.v[plane * plane_size + i]; }
void Put(uint plane, uint i, float x) { planes.v[plane * plane_size + i] = x; }
void Put3(uint plane, uint i, vec3 x) { Put(plane, i, x.x), Put(plane + 1, i, x.y), Put(plane + 2, i, x.z); }
void PutWord(uint plane, uint i, uint x) { words.v[plane * plane_size + i] = x; }

vec2 SobolPoint(uint index, uint seed) {
  const uint hash = hash_bits(seed);
  return vec2(unit_of(owen_scramble(bitfieldReverse(index), hash)), unit_of(owen_scramble(sobol_second(index), hash_bits(hash))));
}

vec3 SpherePoint(vec2 u) {
  const float z = 1.0 - 2.0 * u.x;
  const PlanePoint at = disc_place(sqrt(max(0.0, 1.0 - z * z)), u.y);
  return vec3(at.x, at.y, z);
}

/// Direction to a point of the sun's disc.
vec3 SunDiscPoint(vec2 u) {
  const vec3 s = Vec(view.to_sun), reference = abs(s.z) < kUpright ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
  const vec3 right = normalize(cross(reference, s)) * kSunRayRadius, up = cross(s, right);
  const PlanePoint at = disc_place(sqrt(u.x), u.y);
  return normalize(s + right * at.x + up * at.y);
}

/// How the pixels of a 16 x 16 tile share random directions (TileLayout, TileSampling).
struct Sampling {
  uint seed, tile, phase;
};
Sampling SamplingOf(uvec2 pixel) {
  Sampling s;
  const uvec2 at = pixel >> 4, q = pixel & 15u;
  const uint across = (camera.width + 15u) >> 4;
  s.seed = Mix(Add(uvec2(camera.high_seed[0], camera.high_seed[1]), uvec2((at.y >> 2) * across + (at.x >> 2), 0u))).x;
  s.tile = (at.x & 1u) | (at.y & 1u) << 1 | (at.x & 2u) << 1 | (at.y & 2u) << 2;
  s.phase = (q.x + 4u * q.y + (q.y >> 2)) & 15u;
  return s;
}

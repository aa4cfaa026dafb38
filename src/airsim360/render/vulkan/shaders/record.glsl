// Rays of a picture, kept to be traced once more by themselves: what is measured against (GpuRenderer::TraceAloneMs).
// Of each pixel up to kMostRays rays of eight numbers, then how many there are, then a sum of distances.

const uint kMostRays = 12;

Floats recorded;
uint record_pixel, record_pixels, record_count = 0;

uint RayPlace(uint k) { return 8 * (k * record_pixels + record_pixel); }
void OpenRecord(GpuCamera camera, uvec2 pixel) {
  recorded = camera.planes;
  record_pixel = pixel.y * camera.width + pixel.x;
  record_pixels = camera.width * camera.height;
}
void RecordRay(vec3 origin, vec3 direction, float reach, bool looks) {
  if (record_count == kMostRays) return;
  const uint at = RayPlace(record_count++);
  for (int k = 0; k < 3; ++k) recorded.v[at + k] = origin[k], recorded.v[at + 3 + k] = direction[k];
  recorded.v[at + 6] = reach, recorded.v[at + 7] = looks ? 1.0 : 0.0;
}
uint CountPlace() { return 8 * kMostRays * record_pixels + record_pixel; }

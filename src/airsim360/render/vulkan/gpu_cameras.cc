#include "airsim360/render/vulkan/gpu_cameras.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/render/frame/antialias.h"
#include "airsim360/render/high/high_frame.h"
#include "airsim360/render/reference/path_tracer.h"

namespace airsim360::internal {
namespace {

constexpr size_t kMostTables = 64;

int Padded(int n) { return (n + kTileSize - 1) / kTileSize * kTileSize; }

bool IsFinite(const RigidTransform& X) {
  double sum = X.p.x + X.p.y + X.p.z;
  for (int i = 0; i < 9; ++i) sum += X.R.m[i / 3][i % 3];
  return std::isfinite(sum);
}

// Of a lens, as GpuCamera::lens has them.
std::vector<double> Coefficients(const CalibratedLens& lens) {
  std::vector<double> all(lens.shape.begin(), lens.shape.end());
  all.insert(all.end(), lens.radial.begin(), lens.radial.end());
  all.insert(all.end(), lens.divisor.begin(), lens.divisor.end());
  all.insert(all.end(), lens.tangential.begin(), lens.tangential.end());
  all.insert(all.end(), lens.prism.begin(), lens.prism.end());
  all.push_back(2 * std::tan(lens.shape[0] / 2));
  return all;
}

// All that makes a camera, in one list.
std::vector<double> KeyOf(const Camera& camera) {
  std::vector<double> key{static_cast<double>(camera.index()), static_cast<double>(Width(camera)), static_cast<double>(Height(camera))};
  if (const auto* c = std::get_if<CubeFace>(&camera)) key.push_back(static_cast<double>(c->face));
  if (const auto* c = std::get_if<Pinhole>(&camera)) key.insert(key.end(), {c->fx, c->fy, c->cx, c->cy});
  if (const auto* c = std::get_if<Fisheye>(&camera)) {
    key.insert(key.end(), {c->fx, c->fy, c->cx, c->cy, c->max_theta});
    key.insert(key.end(), c->k.begin(), c->k.end());
  }
  if (const auto* c = std::get_if<CalibratedLens>(&camera)) {
    key.insert(key.end(), {static_cast<double>(c->law), c->fx, c->fy, c->cx, c->cy, c->max_theta});
    const std::vector<double> coefficients = Coefficients(*c);
    key.insert(key.end(), coefficients.begin(), coefficients.end());
  }
  return key;
}

void PutMatrix(const Mat3d& R, float* out) {
  for (int i = 0; i < 9; ++i) out[i] = static_cast<float>(R.m[i / 3][i % 3]);
}

void PutVector(Vec3d v, float* out) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

// Planes of `count` numbers in double precision to single, one after another.
void PutPlanes(std::initializer_list<const double*> planes, int count, std::byte* to) {
  auto* out = reinterpret_cast<float*>(to);
  for (const double* plane : planes) {
    for (int i = 0; i < count; ++i) *out++ = static_cast<float>(plane[i]);
  }
}

void PutProjection(const Camera& camera, GpuCamera& out) {
  const auto pinhole = [&](double fx, double fy, double cx, double cy) {
    out.focal[0] = static_cast<float>(fx), out.focal[1] = static_cast<float>(fy);
    out.center[0] = static_cast<float>(cx), out.center[1] = static_cast<float>(cy);
  };
  out.projection = kProjectEquirectangular;
  if (const auto* c = std::get_if<CubeFace>(&camera)) {
    out.projection = kProjectPinhole;
    pinhole(c->size / 2.0, c->size / 2.0, c->size / 2.0, c->size / 2.0);
  } else if (const auto* p = std::get_if<Pinhole>(&camera)) {
    out.projection = kProjectPinhole;
    pinhole(p->fx, p->fy, p->cx, p->cy);
  } else if (const auto* f = std::get_if<Fisheye>(&camera)) {
    out.projection = kProjectFisheye;
    pinhole(f->fx, f->fy, f->cx, f->cy);
    for (size_t i = 0; i < 4; ++i) out.distortion[i] = static_cast<float>(f->k[i]);
    out.max_theta = static_cast<float>(f->max_theta);
  } else if (const auto* l = std::get_if<CalibratedLens>(&camera)) {
    out.projection = kProjectLens;
    pinhole(l->fx, l->fy, l->cx, l->cy);
    out.max_theta = static_cast<float>(l->max_theta);
    out.law = static_cast<uint32_t>(l->law);
  }
}

void PutSeed(uint64_t seed, GpuCamera& out) {
  const uint64_t mixed = MixBits(seed);
  out.high_seed[0] = static_cast<uint32_t>(mixed), out.high_seed[1] = static_cast<uint32_t>(mixed >> 32);
}

}  // namespace

Mat3d FromProjection(const Camera& camera, const RayField& field) {
  Mat3d R;
  for (int i = 0; i < 9; ++i) R.m[i / 3][i % 3] = field.R[i];
  if (const auto* face = std::get_if<CubeFace>(&camera)) R = R * CubeFaceRotation(face->face);
  return R;
}

int PathSamples(const RenderRequest& request) { return request.samples > 0 ? request.samples : PathTracerOptions::kDefaultSamples; }

int ColorSamples(const RenderRequest& request) {
  const Products& products = request.products;
  if (!products.rgb && !request.light && !(request.tier == Tier::kHigh && products.radiance)) return 1;
  if (request.tier != Tier::kFast && request.tier != Tier::kHigh) return 1;
  return EdgeSamples(request);
}

int PointsOfPixel(const RenderRequest& request) { return request.products.coverage ? EdgeSamples(request) : ColorSamples(request); }

std::byte* UploadCursor::Take(size_t bytes, uint64_t& where) {
  std::byte* to = mapped + next;
  where = address + next;
  next += (bytes + 63) / 64 * 64;
  if (next > size) throw RuntimeError("GPU: a frame's parameters do not fit");
  return to;
}

size_t GpuCameras::Size(const RenderRequest& request) {
  const int points = PointsOfPixel(request);
  size_t size = 256 + (points > 1 ? static_cast<size_t>(8 * 6 * 4 * (points - 1)) : 0);
  const Camera& camera = request.camera;
  if (std::holds_alternative<Equirectangular>(camera))
    size += sizeof(float) * 5 * static_cast<size_t>(Padded(Width(camera)) + Padded(Height(camera)));
  if (std::holds_alternative<CalibratedLens>(camera)) size += 128;
  if (request.tier == Tier::kHigh) size += 64 + 2 * sizeof(float) * static_cast<size_t>(Height(camera));
  return size;
}

void GpuCameras::Trim() {
  if (tables_.size() > kMostTables) tables_.clear();
}

VkDeviceAddress GpuCameras::Table(const Camera& camera, const RayField& field) {
  GpuBuffer& buffer = tables_[KeyOf(camera)];
  if (buffer.size() > 0) return buffer.address();
  buffer = GpuBuffer(device_, 12 * static_cast<size_t>(field.width) * field.height + 16, MemoryKind::kUpload);
  auto* out = reinterpret_cast<float*>(buffer.mapped());
  for (int y = 0; y < field.height; ++y) {
    for (int x = 0; x < field.width; ++x) {
      const int64_t i = static_cast<int64_t>(y) * field.stride + x;
      const bool sees = field.has_ray[i] != 0;
      *out++ = sees ? field.ray_x[i] : 0.0f;
      *out++ = sees ? field.ray_y[i] : 0.0f;
      *out++ = sees ? field.ray_z[i] : 0.0f;
    }
  }
  return buffer.address();
}

void GpuCameras::Fill(const RenderRequest& request, uint64_t frames, UploadCursor& upload, GpuCamera& out) {
  if (!IsFinite(request.X_WC)) throw InputError("camera pose is not finite");
  rays_.Update(request.camera, request.X_WC.R);
  const RayField& field = rays_.field();
  out.width = static_cast<uint32_t>(field.width), out.height = static_cast<uint32_t>(field.height);
  out.separable = field.separable ? 1 : 0;
  out.column_shift = rays_.column_shift();
  out.cone_angle = static_cast<float>(rays_.cone_angle());
  PutVector(request.X_WC.p, out.origin);
  for (int i = 0; i < 9; ++i) out.R[i] = static_cast<float>(field.R[i]);
  PutProjection(request.camera, out);
  PutMatrix(FromProjection(request.camera, field), out.projection_R);
  if (field.separable) {
    const int columns = Padded(field.width), rows = Padded(field.height);
    out.stride = static_cast<uint32_t>(columns), out.stride_rows = static_cast<uint32_t>(rows);
    // Sines and cosines from the turned tables: right . h = sin theta, forward . h = cos theta, down . v = -sin phi.
    std::vector<double> sine(static_cast<size_t>(columns)), cosine(sine.size()), up(static_cast<size_t>(rows));
    const double* R = field.R;
    for (int x = 0; x < columns; ++x) {
      const double hx = field.column_x[x], hy = field.column_y[x], hz = field.column_z[x];
      sine[static_cast<size_t>(x)] = R[0] * hx + R[3] * hy + R[6] * hz;
      cosine[static_cast<size_t>(x)] = R[2] * hx + R[5] * hy + R[8] * hz;
    }
    for (int y = 0; y < rows; ++y) up[static_cast<size_t>(y)] = -(R[1] * field.row_x[y] + R[4] * field.row_y[y] + R[7] * field.row_z[y]);
    PutPlanes({field.column_x, field.column_y, field.column_z, sine.data(), cosine.data()}, columns,
              upload.Take(20 * static_cast<size_t>(columns), out.columns));
    PutPlanes({field.row_scale, field.row_x, field.row_y, field.row_z, up.data()}, rows,
              upload.Take(20 * static_cast<size_t>(rows), out.rows));
  } else {
    out.rays = Table(request.camera, field);
    if (const auto* lens = std::get_if<CalibratedLens>(&request.camera)) {
      const std::vector<double> coefficients = Coefficients(*lens);
      PutPlanes({coefficients.data()}, static_cast<int>(coefficients.size()), upload.Take(4 * coefficients.size(), out.lens));
    }
  }
  if (const int points = PointsOfPixel(request); points > 1) FillOffsets(points, upload, out);
  out.samples = static_cast<uint32_t>(ColorSamples(request));
  if (request.products.flow) FillNext(request, out);
  if (request.tier == Tier::kHigh) FillHigh(request, frames, upload, out);
  if (request.tier == Tier::kReference) {
    PutSeed(request.seed, out);
    out.paths = static_cast<uint32_t>(PathSamples(request));
  }
}

void GpuCameras::FillHigh(const RenderRequest& request, uint64_t frames, UploadCursor& upload, GpuCamera& out) {
  const RayField& field = rays_.field();
  PutSeed(request.seed + frames * 0x9e3779b97f4a7c15ull, out);
  out.edge_seed = static_cast<uint32_t>(request.seed << 8);
  out.denoise = request.denoise ? 1 : 0;
  auto* const to = reinterpret_cast<float*>(upload.Take(2 * sizeof(float) * static_cast<size_t>(field.height), out.row_tables));
  for (int y = 0; y < field.height; ++y) {
    to[y] = AmbientRays(request, field, y / kTileSize * kTileSize);
    to[field.height + y] = field.separable ? static_cast<float>(1 / std::cos(std::numbers::pi * (0.5 - (y + 0.5) / field.height))) : 1.0f;
  }
}

void GpuCameras::FillOffsets(int points, UploadCursor& upload, GpuCamera& out) {
  std::vector<PixelOffset> offsets;
  MakeSampleOffsets(rays_, points, offsets);
  auto* to = reinterpret_cast<float*>(upload.Take(24 * offsets.size(), out.offsets));
  for (const PixelOffset& o : offsets) {
    for (const double x : {o.dx, o.dy, o.sin_theta, o.cos_theta, o.sin_phi, o.cos_phi}) *to++ = static_cast<float>(x);
  }
  out.points = static_cast<uint32_t>(points);
}

void GpuCameras::FillNext(const RenderRequest& request, GpuCamera& out) {
  if (!request.X_WC_next) throw InputError("flow needs the pose of the next frame (X_WC_next)");
  if (!IsFinite(*request.X_WC_next)) throw InputError("next camera pose is not finite");
  next_rays_.Update(request.camera, request.X_WC_next->R);
  const int width = rays_.field().width;
  out.column_turn = ((rays_.column_shift() - next_rays_.column_shift()) % width + width) % width;
  // Rays start from positions in single precision.
  const Vec3d eye = VecCast<double>(VecCast<float>(request.X_WC_next->p));
  PutVector(eye, out.next_origin);
  PutVector(VecCast<double>(VecCast<float>(request.X_WC.p)) - eye, out.eye_offset);
  PutMatrix(FromProjection(request.camera, next_rays_.field()), out.next_R);
}

}  // namespace airsim360::internal

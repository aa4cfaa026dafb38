#include "airsim360/render/indoor/light_solver.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

constexpr int64_t kChunk = 128;
constexpr float kHomeCell = 0.12f;     // m
constexpr double kMostCoarse = 70000;  // cells of surface, about
constexpr int kFirstBounces = 6, kMostBounces = 200;
constexpr float kConverged = 2e-5f;                     // of all light, that the last bounce brings
constexpr float kOutsideCell = 0.12f;                   // m
constexpr uint32_t kOutsidePlaces = 8;                  // of a cell that are looked at
constexpr float kStratified = 0.6f;                     // of the variance of random rays
constexpr float kRefine = 1.5f;                         // ratio of neighbours
constexpr double kMostFine = 300000;                    // surfels, about
constexpr float kFinest = 1.0f / 3, kLeastFine = 0.6f;  // cells of the fine level, of the coarse one's
constexpr float kTolerance = 10;                        // variances of light that are taken for noise
constexpr float kLampTolerance = 4;                     // the same of lamps
constexpr float kOnePlane = 0.2f;                       // of a cell: what is farther off is another surface
constexpr float kLampShare = 2.5f;                      // of all light, inverse: as much by lamps deserves all rays to them
constexpr int kLeastLampRays = 12;
constexpr int kPilot = 2;              // rays to lamps over those of the first look at them
constexpr float kAlikeNormals = 0.7f;  // least cosine between those of surfels that see about the same
constexpr float kNear = 0.6f;          // of a cell: something as near needs the fine level

Vec3f DirectionOf(const Surfel& s, const LightLink& link) { return LinkDirection(LinkSteps(), s, link.u, link.v); }

// Calls body(first, end, chunk) for chunks of surfels.
template <class Body>
void ForChunks(size_t count, const Body& body) {
  ParallelFor((static_cast<int64_t>(count) + kChunk - 1) / kChunk, [&](int64_t chunk) {
    const FlushDenormals flush;
    body(static_cast<size_t>(chunk * kChunk), std::min(count, static_cast<size_t>((chunk + 1) * kChunk)), static_cast<size_t>(chunk));
  });
}

template <class Body>
void ForSurfels(size_t count, const Body& body) {
  ForChunks(count, [&](size_t first, size_t end, size_t chunk) {
    for (size_t i = first; i < end; ++i) body(i, chunk);
  });
}

template <class Each>
void ForNeighbours(const SurfelSet& set, const Surfel& s, int step, const Each& each) {
  for (int k = 0; k < 27; ++k) {
    const auto [first, count] = set.In(s.cell[0] + (k % 3 - 1) * step, s.cell[1] + (k / 3 % 3 - 1) * step, s.cell[2] + (k / 9 - 1) * step);
    for (uint32_t i = first; i < first + count; ++i) each(i, set.surfels()[i]);
  }
}

// Irradiance of what the first `even` rays met. Returns how much every other ray brought of the luminance of `held`, less the rest.
float AddGlow(std::span<const Landing> landings, int even, Vec3f& held, Vec3f& others) {
  float difference = 0;
  for (size_t k = 0; k < static_cast<size_t>(even); ++k) {
    const MetGlow& glow = landings[k].glow;
    const Vec3f light = glow.radiance * (kPiF / static_cast<float>(even));
    (glow.held ? held : others) += light;
    if (glow.held) difference += k % 2 != 0 ? -Luminance(light) : Luminance(light);
  }
  return difference;
}

// Of a sum of which two halves have that difference: about as noisy as the sum itself.
float VarianceOf(float difference) { return difference * difference; }

float CellOf(std::span<const SurfacePiece> pieces, float wanted) {
  if (wanted > 0) return wanted;
  return std::max(kHomeCell, static_cast<float>(std::sqrt(AreaOf(pieces) / kMostCoarse)));
}

}  // namespace

/// What the rays of one surfel bring.
struct LightSolver::Sum {
  Vec3f light, bend;
  float mean = 0, first = 0, second = 0, open = 0, whole = 0, found = 0;
  int rays = 0;

  void Add(Vec3f radiance, Vec3f d, float cosine, float weight) {
    light += radiance * weight;
    const float l = Luminance(radiance) * weight, part = l / std::max(0.05f, cosine);
    mean += part, bend += d * part;
    first += l, second += l * l;
    ++rays;
  }
  void Put(size_t i, Vec3f others, LevelLight& out) const {
    // What was lost is as what was found.
    const float scale = found > 0 ? whole / found : 1;
    out.light[i] = light * scale + others;
    out.variance[i] = std::max(0.0f, second - first * first / static_cast<float>(std::max(1, rays))) * kStratified;
    out.mean[i] = mean, out.bend[i] = bend, out.open[i] = open;
  }
};

LightSolver::LightSolver(const IndoorWorld& world, const Enclosure& enclosure, const IndoorOptions& options)
    : LightSolver(world, EnclosedPieces(world, enclosure, Reflectance(world.tables)), options) {}

LightSolver::LightSolver(const IndoorWorld& world, const std::vector<SurfacePiece>& pieces, const IndoorOptions& options)
    : world_(world), options_(options), reflectance_(world.tables), plain_(world), coarse_(world, pieces, CellOf(pieces, options.cell)) {
  FindLamps();
  TraceEven();
  FindDirect();
  Bounce(kFirstBounces);
  TraceGuided();
  Bounce(kMostBounces);
  Finish();
  if (options_.fine) MakeFine(pieces);
}

uint16_t LightSolver::WeightOf(float share) const {
  return static_cast<uint16_t>(std::clamp(share * static_cast<float>(options_.rays) * 65535 + 0.5f, 0.0f, 65535.0f));
}

Vec3f LightSolver::Seen(uint32_t target, const Surfel& from, const LightLink& link) const {
  if (target == LightLink::kSky) return SkyAlong(world_, DirectionOf(from, link));
  return target == LightLink::kNothing ? Vec3f{} : radiance_[target];
}

// By the tree alone, for those that count to be sent where lamps are seen.
void LightSolver::FindLamps() {
  const auto& surfels = coarse_.surfels();
  found_.resize(surfels.size());
  ForSurfels(surfels.size(), [&](size_t i, size_t) {
    const LampMix lamps{&plain_, std::max(1, options_.lamp_rays / kPilot), options_.rays, nullptr, &found_[i]};
    LampsAround(world_, surfels[i].InPlane(), surfels[i].n, lamps, static_cast<uint32_t>(i) ^ 0x40000000u);
    JoinFound(found_[i]);
  });
}

LampGuide LightSolver::LampsNear(uint32_t at) const {
  if (world_.lights == nullptr) return {};
  LampTally tally(world_.lights->size());
  const Surfel& s = coarse_.surfels()[at];
  for (const int step : {1, 2}) {
    ForNeighbours(coarse_, s, step, [&](uint32_t j, const Surfel& other) {
      if (Dot(other.n, s.n) > kAlikeNormals && (step == 1 || j != at)) tally.Add(found_[j]);
    });
  }
  return LampGuide(tally);
}

void LightSolver::TraceEven() {
  const auto rays = static_cast<size_t>(options_.rays);
  const size_t count = coarse_.surfels().size();
  others_.assign(count, {});
  coarse_light_.lamps.assign(count, {});
  coarse_light_.lamp_variance.assign(count, 0);
  links_.assign(count * 2 * rays, {LightLink::kNothing, 0, 0, 0});
  radiance_.assign(count, {});
  std::vector<std::vector<std::pair<size_t, OutsidePlace>>> outside(count / kChunk + 1);
  std::vector<std::vector<FoundLamp>> found(count);
  ForSurfels(count, [&](size_t i, size_t chunk) {
    const Surfel& s = coarse_.surfels()[i];
    const LampGuide guide = LampsNear(static_cast<uint32_t>(i));
    const LampMix lamps{&plain_, options_.lamp_rays, options_.rays, &guide, &found[i]};
    const DirectLight direct = LampsAround(world_, s.InPlane(), s.n, lamps, static_cast<uint32_t>(i));
    coarse_light_.lamps[i] = direct.held, others_[i] = direct.others;
    coarse_light_.lamp_variance[i] = VarianceOf(direct.held_difference);
    std::vector<Vec2f> points;
    std::vector<Landing> landings;
    SampleEvenly(options_.rays, ShiftOf(i), points);
    SendRays(world_, reflectance_, coarse_, s, points, lamps, landings);
    coarse_light_.lamp_variance[i] += VarianceOf(AddGlow(landings, options_.rays, coarse_light_.lamps[i], others_[i]));
    for (size_t k = 0; k < rays; ++k) {
      const size_t at = i * 2 * rays + k;
      if (landings[k].target == Landing::kOutside) outside[chunk].push_back({at, landings[k].outside});
      links_[at] = {landings[k].target, WeightOf(landings[k].share / static_cast<float>(rays)), LinkStep(points[k].x),
                    LinkStep(points[k].y)};
    }
  });
  for (size_t i = 0; i < count; ++i) {
    found_[i].insert(found_[i].end(), found[i].begin(), found[i].end());
    JoinFound(found_[i]);
  }
  AddOutside(outside);
}

// Places in one cell are one, with the mean of their light: beside a window sun and shade lie close together. In the order of links.
void LightSolver::AddOutside(std::vector<std::vector<std::pair<size_t, OutsidePlace>>>& found) {
  std::unordered_map<uint64_t, uint32_t> known;
  const auto cell = [](float x) { return static_cast<int32_t>(std::floor(std::clamp(x / kOutsideCell, -5e5f, 5e5f))); };
  const size_t first = radiance_.size();
  std::vector<std::pair<uint32_t, OutsidePlace>> asked;  // from `first` on
  std::vector<uint32_t> count;
  for (auto& part : found) {
    for (const auto& [at, place] : part) {
      const Vec3f n = place.n;
      const int side = std::fabs(n.x) > std::fabs(n.y) && std::fabs(n.x) > std::fabs(n.z) ? (n.x > 0 ? 0 : 1)
                       : std::fabs(n.y) > std::fabs(n.z)                                  ? (n.y > 0 ? 2 : 3)
                                                                                          : (n.z > 0 ? 4 : 5);
      auto id = static_cast<uint32_t>(count.size());
      const bool alone = place.radiance != Vec3f{} || n == Vec3f{};
      if (!alone) {
        const uint64_t key = IndoorKey(cell(place.p.x), cell(place.p.y), cell(place.p.z)) * 6 + static_cast<uint64_t>(side);
        id = known.try_emplace(key, id).first->second;
      }
      if (id == count.size()) count.push_back(0);
      if (count[id] < kOutsidePlaces) ++count[id], asked.emplace_back(id, place);
      links_[at].target = static_cast<uint32_t>(first) + id;
    }
    part = {};
  }
  std::vector<Vec3f> light(asked.size());
  ForSurfels(asked.size(), [&](size_t k, size_t) { light[k] = RadianceOutside(asked[k].second, k); });
  radiance_.resize(first + count.size());
  for (size_t k = 0; k < asked.size(); ++k) radiance_[first + asked[k].first] += light[k] * (1 / static_cast<float>(count[asked[k].first]));
}

void LightSolver::FindDirect() {
  const auto& surfels = coarse_.surfels();
  direct_.assign(surfels.size(), {});
  ForSurfels(surfels.size(), [&](size_t i, size_t) {
    const Surfel& s = surfels[i];
    const Vec3f sun = SunFromAbove(world_, {s.points, static_cast<size_t>(s.point_count)}, s.n, static_cast<uint32_t>(i), kSunRays);
    direct_[i] = sun + coarse_light_.lamps[i] + others_[i];
    radiance_[i] = s.albedo * direct_[i] * (1 / kPiF);
  });
}

// Jacobi steps: every one adds a bounce to what is known.
void LightSolver::Bounce(int most) {
  const auto& surfels = coarse_.surfels();
  const auto rays = static_cast<size_t>(2 * options_.rays);
  const float unit = kPiF / (static_cast<float>(options_.rays) * 65535);
  std::vector<Vec3f> sky(surfels.size()), next(surfels.size());
  std::vector<float> scale(surfels.size());
  ForSurfels(surfels.size(), [&](size_t i, size_t) {
    double whole = 0, lost = 0;
    for (size_t k = i * rays; k < (i + 1) * rays; ++k) {
      const LightLink& link = links_[k];
      whole += link.weight;
      if (link.target == LightLink::kNothing) lost += link.weight;
      if (link.target == LightLink::kSky)
        sky[i] += SkyAlong(world_, DirectionOf(surfels[i], link)) * (static_cast<float>(link.weight) * unit);
    }
    scale[i] = whole > lost ? static_cast<float>(whole / (whole - lost)) : 1;
  });
  for (int step = 0; step < most; ++step) {
    ForSurfels(surfels.size(), [&](size_t i, size_t) {
      Vec3f light = sky[i];
      for (size_t k = i * rays; k < (i + 1) * rays; ++k) {
        const LightLink& link = links_[k];
        if (link.target < LightLink::kNothing) light += radiance_[link.target] * (static_cast<float>(link.weight) * unit);
      }
      next[i] = surfels[i].albedo * (direct_[i] + light * scale[i]) * (1 / kPiF);
    });
    double all = 0, new_light = 0;
    for (size_t i = 0; i < surfels.size(); ++i) {
      all += Luminance(next[i]) * surfels[i].area;
      new_light += std::fabs(Luminance(next[i] - radiance_[i])) * surfels[i].area;
      radiance_[i] = next[i];
    }
    if (!(new_light > kConverged * all)) break;
  }
}

LightGuide LightSolver::GuideOf(const Surfel& s, uint32_t at, bool own) const {
  std::array<float, LightGuide::kCells> sum{}, count{};
  const auto rays = static_cast<size_t>(options_.rays);
  const Surfel& middle = coarse_.surfels()[at];
  ForNeighbours(coarse_, middle, 1, [&](uint32_t j, const Surfel& other) {
    if (Dot(other.n, s.n) < kAlikeNormals || (j == at && !own) || (j != at && coarse_.Weight(other, middle.p, middle.n) <= 0)) return;
    const bool same = other.n == s.n;
    for (size_t k = 0; k < rays; ++k) {
      const LightLink& link = links_[j * 2 * rays + k];
      size_t cell = static_cast<size_t>(link.u >> 4) * LightGuide::kSide + (link.v >> 4);
      if (!same) {
        const Vec3f d = DirectionOf(other, link);
        const float c = Dot(d, s.n);
        if (c <= 0) continue;
        const float turn = std::atan2(Dot(d, s.b), Dot(d, s.t)) / 6.2831853f;
        cell = LightGuide::CellOf({1 - c * c, turn < 0 ? turn + 1 : turn});
      }
      sum[cell] += bright_[j * rays + k], count[cell] += 1;
    }
  });
  return {sum, count};
}

void LightSolver::TraceGuided() {
  const auto rays = static_cast<size_t>(options_.rays);
  const auto& surfels = coarse_.surfels();
  bright_.assign(surfels.size() * rays, 0);
  ForSurfels(surfels.size(), [&](size_t i, size_t) {
    for (size_t k = 0; k < rays; ++k) {
      const LightLink& link = links_[i * 2 * rays + k];
      bright_[i * rays + k] = Luminance(Seen(link.target, surfels[i], link)) * static_cast<float>(link.weight) / 65535;
    }
  });
  std::vector<std::vector<std::pair<size_t, OutsidePlace>>> outside(surfels.size() / kChunk + 1);
  ForSurfels(surfels.size(), [&](size_t i, size_t chunk) {
    // Not of its own even rays: where one of them has met a small bright place its own weight would be less for that, and light
    // would be lost.
    const LightGuide guide = GuideOf(surfels[i], static_cast<uint32_t>(i), false);
    std::vector<Vec2f> points;
    std::vector<Landing> landings;
    guide.Sample(options_.rays, ShiftOf(i + 0x100000000ull), points);
    SendRays(world_, reflectance_, coarse_, surfels[i], points, {&plain_, 0, 0}, landings);
    // The balance heuristic of both kinds of rays.
    const auto share = [&](Vec2f point) { return 1 / (static_cast<float>(rays) * (1 + guide.Density(point))); };
    for (size_t k = 0; k < rays; ++k) {
      LightLink& even = links_[i * 2 * rays + k];
      const float kept = static_cast<float>(even.weight) / 65535;
      even.weight = WeightOf(kept * share({(even.u + 0.5f) / 256, (even.v + 0.5f) / 256}));
      const size_t at = i * 2 * rays + rays + k;
      if (landings[k].target == Landing::kOutside) outside[chunk].push_back({at, landings[k].outside});
      const LightLink link{landings[k].target, 0, LinkStep(points[k].x), LinkStep(points[k].y)};
      links_[at] = link;
      links_[at].weight = WeightOf(landings[k].share * share({(link.u + 0.5f) / 256, (link.v + 0.5f) / 256}));
    }
  });
  AddOutside(outside);
}

LightGuide LightSolver::KeptGuide(const Surfel& s, uint32_t at, std::unordered_map<uint32_t, LightGuide>& kept) const {
  if (s.n != coarse_.surfels()[at].n) return GuideOf(s, at, true);
  const auto [it, fresh] = kept.try_emplace(at);
  if (fresh) it->second = GuideOf(s, at, true);
  return it->second;
}

namespace {

void Resize(size_t count, LevelLight& light) {
  light.light.assign(count, {});
  light.variance.assign(count, 0);
  light.mean.assign(count, 0);
  light.bend.assign(count, {});
  light.open.assign(count, 0);
}

}  // namespace

void LightSolver::Finish() {
  const auto& surfels = coarse_.surfels();
  const auto rays = static_cast<size_t>(2 * options_.rays);
  Resize(surfels.size(), coarse_light_);
  ForSurfels(surfels.size(), [&](size_t i, size_t) {
    Sum sum;
    for (size_t k = i * rays; k < (i + 1) * rays; ++k) {
      const LightLink& link = links_[k];
      const float weight = static_cast<float>(link.weight) * (kPiF / (static_cast<float>(options_.rays) * 65535));
      sum.whole += weight;
      if (link.target != LightLink::kNothing) sum.found += weight;
      if (link.target == LightLink::kSky) sum.open += weight / kPiF;
      sum.Add(Seen(link.target, surfels[i], link), DirectionOf(surfels[i], link), LinkSteps().up[link.u], weight);
    }
    sum.Put(i, others_[i], coarse_light_);
  });
  double whole = 0, lost = 0;
  for (const LightLink& link : links_) {
    whole += link.weight;
    lost += link.target == LightLink::kNothing ? link.weight : 0;
  }
  lost_ = whole > 0 ? lost / whole : 0;
  Smooth(coarse_, 4, coarse_light_);
}

// Where coarse neighbours differ, or something stands close.
std::vector<uint8_t> LightSolver::NeedFine() const {
  const auto& surfels = coarse_.surfels();
  std::vector<uint8_t> need(surfels.size());
  ForSurfels(surfels.size(), [&](size_t i, size_t) {
    const Surfel& s = surfels[i];
    const auto of = [&](uint32_t j) { return Luminance(coarse_light_.light[j] + coarse_light_.lamps[j]); };
    float least = of(static_cast<uint32_t>(i)), most = least;
    ForNeighbours(coarse_, s, 1, [&](uint32_t j, const Surfel& other) {
      if (Dot(other.n, s.n) < 0.8f) return;
      least = std::min(least, of(j)), most = std::max(most, of(j));
    });
    bool near = false;
    for (const float clear : s.clear) near |= clear < kNear * coarse_.cell();
    need[i] = near || most > kRefine * least + 1e-9f;
  });
  return need;
}

void LightSolver::MakeFine(std::span<const SurfacePiece> pieces) {
  const std::vector<uint8_t> need = NeedFine();
  const auto coarse = static_cast<double>(std::count(need.begin(), need.end(), uint8_t{1}));
  const float finer = std::clamp(static_cast<float>(std::sqrt(coarse / kMostFine)), kFinest, kLeastFine);
  fine_ = std::make_unique<SurfelSet>(world_, pieces, coarse_.cell() * finer, [&](Vec3f p, Vec3f n) {
    const uint32_t at = coarse_.Nearest(p, n);
    return at != SurfelSet::kNone && need[at] != 0;
  });
  const auto& surfels = fine_->surfels();
  Resize(surfels.size(), fine_light_);
  fine_light_.lamps.assign(surfels.size(), {});
  fine_light_.lamp_variance.assign(surfels.size(), 0);
  ForChunks(surfels.size(), [&](size_t first, size_t end, size_t) {
    KeptGuides kept;
    for (size_t i = first; i < end; ++i) LightFine(i, kept);
  });
  Smooth(*fine_, 4, fine_light_);
}

// Where lamps bring little beside daylight their noise is little of all light, too.
int LightSolver::FineLampRays(uint32_t near) const {
  if (near == SurfelSet::kNone) return options_.lamp_rays;
  const float lamps = Luminance(coarse_light_.lamps[near] + others_[near]);
  const float all = Luminance(coarse_light_.lamps[near] + coarse_light_.light[near]);
  const float share = all > 0 ? lamps / all : 1;
  const auto wanted = static_cast<int>(std::ceil(kLampShare * share * static_cast<float>(options_.lamp_rays)));
  return std::clamp(wanted, std::min(options_.lamp_rays, kLeastLampRays), options_.lamp_rays);
}

void LightSolver::LightFine(size_t i, KeptGuides& kept) {
  const Surfel& s = fine_->surfels()[i];
  const uint32_t near = coarse_.Nearest(s.p, s.n);
  LampMix lamps{&plain_, FineLampRays(near), options_.fine_rays};
  if (near != SurfelSet::kNone) {
    const auto [it, fresh] = kept.lamps.try_emplace(near);
    if (fresh) it->second = LampsNear(near);
    lamps.guide = &it->second;
  }
  DirectLight direct = LampsAround(world_, s.InPlane(), s.n, lamps, static_cast<uint32_t>(i) ^ 0x80000000u);
  const LightGuide guide = near == SurfelSet::kNone ? LightGuide() : KeptGuide(s, near, kept.light);
  std::vector<Vec2f> points;
  std::vector<Landing> landings;
  SampleEvenly(options_.fine_rays, ShiftOf(i + 0x200000000ull), points);
  guide.Sample(options_.fine_rays, ShiftOf(i + 0x300000000ull), points);
  SendRays(world_, reflectance_, coarse_, s, points, lamps, landings);
  fine_light_.lamp_variance[i] = VarianceOf(direct.held_difference);
  fine_light_.lamp_variance[i] += VarianceOf(AddGlow(landings, options_.fine_rays, direct.held, direct.others));
  fine_light_.lamps[i] = direct.held;
  Sum sum;
  for (size_t k = 0; k < landings.size(); ++k) {
    const Landing& landing = landings[k];
    const float weight = kPiF * landing.share / (static_cast<float>(options_.fine_rays) * (1 + guide.Density(points[k])));
    sum.whole += weight;
    if (landing.target == LightLink::kNothing) continue;
    sum.found += weight;
    if (landing.target == LightLink::kSky) sum.open += weight / kPiF;
    const Vec3f light = landing.target == LightLink::kSky     ? SkyAlong(world_, landing.direction)
                        : landing.target == Landing::kOutside ? RadianceOutside(landing.outside, i)
                                                              : radiance_[landing.target];
    sum.Add(light, landing.direction, std::sqrt(std::max(0.0f, 1 - points[k].x)), weight);
  }
  sum.Put(i, direct.others, fine_light_);
}

namespace {

// Calls each(j) for the neighbours of a surfel in one plane that see it.
template <class Each>
void ForOnePlane(const SurfelSet& set, size_t i, int step, const Each& each) {
  const Surfel& s = set.surfels()[i];
  ForNeighbours(set, s, step, [&](uint32_t j, const Surfel& other) {
    if (j == i || Dot(other.n, s.n) < 0.9f || std::fabs(Dot(other.p - s.p, s.n)) > kOnePlane * set.cell()) return;
    if (set.Weight(s, other.p, other.n) <= 1e-5f || set.Weight(other, s.p, s.n) <= 1e-5f) return;
    each(j);
  });
}

// How far the difference of two is noise: as much as is expected of it says nothing.
float Alike(const std::vector<Vec3f>& light, const std::vector<float>& variance, size_t i, size_t j, float tolerance) {
  const float own = Luminance(light[i]), other = Luminance(light[j]), noise = variance[i] + variance[j];
  const float d2 = std::max(0.0f, (other - own) * (other - own) - noise);
  return std::exp(-d2 / (tolerance * noise + 2e-4f * (own * own + other * other) + 1e-20f));
}

}  // namespace

// How many neighbours a surfel has in its plane, and the noise of all of them: those whose few rays missed a far window think that they
// have none.
LightSolver::Plane LightSolver::PlaneOf(const SurfelSet& set, int step, const LevelLight& light) const {
  Plane plane;
  const size_t count = set.surfels().size();
  plane.neighbours.resize(count), plane.variance.resize(count), plane.lamp_variance.resize(count);
  ForSurfels(count, [&](size_t i, size_t) {
    float n = 0, sum = light.variance[i], of_lamps = light.lamp_variance[i];
    ForOnePlane(set, i, step, [&](uint32_t j) { n += 1, sum += light.variance[j], of_lamps += light.lamp_variance[j]; });
    plane.neighbours[i] = n, plane.variance[i] = sum / (n + 1), plane.lamp_variance[i] = of_lamps / (n + 1);
  });
  return plane;
}

// Neighbours exchange light, that of surfels and that of lamps each by its own noise: what one gives another one gets, so that none is
// lost where few have found the light of all around.
void LightSolver::Smooth(const SurfelSet& set, int passes, LevelLight& light) const {
  Plane plane;
  for (int pass = 0; pass < passes; ++pass) {
    const int step = pass >= 2 ? 2 : 1;
    if (pass == 0 || pass == 2) {
      plane = PlaneOf(set, step, light);
      if (pass == 0) light.variance = plane.variance, light.lamp_variance = plane.lamp_variance;
    }
    LevelLight next = light;
    ForSurfels(set.surfels().size(), [&](size_t i, size_t) {
      float kept = 1, variance = 0, lamps_kept = 1, lamp_variance = 0;
      Vec3f sum, bend, lamps;
      float mean = 0;
      const auto share = [&](uint32_t j) { return 1 / (1 + std::max(plane.neighbours[i], plane.neighbours[j])); };
      ForOnePlane(set, i, step, [&](uint32_t j) {
        float w = share(j) * Alike(light.light, light.variance, i, j, kTolerance);
        sum += light.light[j] * w, bend += light.bend[j] * w, mean += light.mean[j] * w;
        kept -= w, variance += w * w * light.variance[j];
        if (!(light.lamp_variance[i] > 0)) return;
        w = share(j) * Alike(light.lamps, light.lamp_variance, i, j, kLampTolerance);
        lamps += light.lamps[j] * w, lamps_kept -= w, lamp_variance += w * w * light.lamp_variance[j];
      });
      next.light[i] = sum + light.light[i] * kept, next.bend[i] = bend + light.bend[i] * kept;
      next.mean[i] = mean + light.mean[i] * kept;
      next.variance[i] = variance + kept * kept * light.variance[i];
      next.lamps[i] = lamps + light.lamps[i] * lamps_kept;
      next.lamp_variance[i] = lamp_variance + lamps_kept * lamps_kept * light.lamp_variance[i];
    });
    light = std::move(next);
  }
}

Vec3f LightSolver::RadianceOutside(const OutsidePlace& place, size_t seed) const {
  if (place.n == Vec3f{}) return place.radiance;
  Vec3f irradiance = SunFromAbove(world_, {&place.p, 1}, place.n, static_cast<uint32_t>(seed), 1);
  if (world_.around) irradiance += world_.around(place.p, place.n);
  return place.radiance + place.albedo * irradiance * (1 / kPiF);
}

}  // namespace airsim360::internal

// Numbers that the CPU and the shaders must agree on and that stand in no function of shading_*.h. A header of C++, and text that
// a shader includes before all else.
#ifdef __cplusplus
#pragma once
namespace airsim360::internal {
#else
#define constexpr const
#endif

// ---- surfaces
/// SurfaceKind; 0 is all else.
constexpr float kFoliage = 1.0f, kGlass = 2.0f, kWater = 3.0f;
/// Steps of packed directions, of vertex colours and of colours in bytes.
constexpr float kDirectionStep = 2.0f / 65534.0f, kColorStep = 1.0f / 65535.0f, kByteStep = 1.0f / 255.0f;
/// Material::beam of a lit window without a room.
constexpr float kWindowBeam = 1e6f;
/// z of the axis (0, -1, z) of low beams, in the mesh frame.
constexpr float kBeamDrop = -0.06f;
/// From random bits to [0, 1).
constexpr float kTwelveBits = 1.0f / 4096.0f, kTenBits = 1.0f / 1024.0f;
/// Radius of the sun's disc of 0.53 degrees, where rays to it end: radians.
constexpr float kSunRayRadius = 0.00462f;
/// x^2 + y^2 of a direction from which on it counts as straight up.
constexpr float kSteepest2 = 1e-6f;
/// |z| of a direction from which on a vector across it is made with x, not with z.
constexpr float kUpright = 0.9f;

// ---- air
constexpr float kAirAsymmetry = 0.76f, kFogAsymmetry = 0.80f;
/// Rain leans with the wind: metres east for each metre of height.
constexpr float kRainLean = 0.12f;
/// Length of a way through the whole air.
constexpr float kFarAir = 2e5f;

// ---- light
/// Radiance of a glint that still averages well over few samples.
constexpr float kBrightestGlint = 400.0f;
/// Cosine of the steepest view of a bent normal.
constexpr float kViewCosine = 0.02f;
/// Thinner coats mirror nothing that a ray would be worth.
constexpr float kThinCoat = 0.05f;
/// Skins of at least so much metal show highlights whatever their roughness; others not of lamps from this roughness on.
constexpr float kShinyMetal = 0.2f, kLampMatt = 0.6f;
/// Rank of a lamp that no corner of its cell sees, against one that all see; of all light: not worth a ray; least weight of a
/// corner; radii of a lamp before its centre where its light ends.
constexpr float kUnseenLamp = 0.15f, kFaintLamp = 0.01f, kCornerWeight = 1e-4f, kLampEnd = 1.02f;
/// Least share of a cell's width by which its probes are asked in front of a surface; how far the last cell reaches; of the points
/// that choose a probe in a metre.
constexpr float kProbeBias = 0.45f, kProbeReach = 0.9999f, kProbeGrains = 1024.0f;
/// Albedo of what ambient light's rays meet, at the most.
constexpr float kMostBounced = 0.9f;
/// Closed rooms that glow do so less where something is near: a share of the glow, and one that grows with the distance.
constexpr float kRoomNear = 0.35f, kRoomFar = 0.65f;
/// Things close above level ground keep ambient light off: length and slant of the ray that looks for them, how level the ground
/// is and how far away at the most.
constexpr float kContactReach = 1.2f, kContactX = 0.0123f, kContactY = 0.0071f, kContactLevel = 0.7f, kContactFarthest = 40.0f;
/// A ray of a mirror is wider by what it came and went, but not for less than so many metres.
constexpr float kLeastRange = 0.01f;

// ---- antialiasing
/// Weights of the channels in what counts as bright.
constexpr float kEdgeRed = 0.25f, kEdgeGreen = 0.625f, kEdgeBlue = 0.125f;
/// How unlike a pixel beside is: least range, weight of its place, and up to where it shows the same surface.
constexpr float kEdgeRange = 1e-6f, kEdgePlace = 1e-3f, kSameSurfaceCost = 0.1f;
/// Exposed luminance that a sample may have: more would make pixels of a few samples sparkle.
constexpr float kNearWhite = 3.0f;

// ---- flow
/// A surface this much nearer than the point hides it: far above rounding, far below things worth seeing.
constexpr float kFlowRelative = 1e-4f, kFlowMetres = 1e-4f;

// ---- tier high
/// Radiance per irradiance that matters.
constexpr float kVisibleTerm = 1e-3f;
/// Skins of less roughness and more reflectance send a ray where they mirror something.
constexpr float kScattered = 0.25f, kVisibleSkin = 0.08f;
/// Width of the sun's disc, radians (0.53 degrees); HighTile::penumbra counts a pixel in so many steps; least width of a pixel.
constexpr float kSunAngle = 0.0093f, kPenumbraSteps = 8.0f, kLeastPixel = 1e-6f;
/// How far light is mixed (a normal distribution's deviation, in pixels), by a penumbra's width: where the sum of blur and of the
/// noise left of eight rays is least, in shadows of leaves 3 to 8 pixels wide.
constexpr float kOfPenumbra = 0.13f, kLeastSpread = 0.45f, kMostSpread = 2.5f;
/// Pixels of about the same plane: least cosine of their normals, and how far apart at the most, in metres and by the range: where
/// light is mixed, where shadows end.
constexpr float kSamePlane = 0.9f, kMixedApart = 0.02f, kMixedApartByRange = 0.01f, kEdgeApart = 0.01f, kEdgeApartByRange = 0.002f;
/// Least width of a pixel by its height, at a panorama's poles.
constexpr float kLeastAspect = 1e-4f;

// ---- denoiser
/// x_normal = kFilterNormal (1 - cos): a sixth is left at 16 degrees. Leaves only avoid opposite sides.
constexpr float kFilterNormal = 48.0f, kFilterLooseNormal = 1.5f;
/// How much thicker than a pixel's width a plane is where there are no like neighbours.
constexpr float kFilterLoosePlane = 16.0f, kFilterThinnest = 1e-12f;
/// A neighbourhood whose samples all agree has still an uncertain mean (rule of succession): variance of a pixel of n samples,
/// about l^2 / (9 n) / n, halved.
constexpr float kFilterAgreement = 0.5f / 9.0f;
/// A harmonic mean of variances of nine values is too small by (9 - 1 - 2) / (9 - 1).
constexpr float kFilterHarmonicBias = 8.0f / 6.0f;
/// The noise is never taken for less than this part of the mean variance around: where light is rare (a sunlit wall at the end of
/// a dark street, windows by night) most windows met none and agree. With a 64th such pixels stayed as specks, and the rest as dark
/// blotches.
constexpr float kFilterLeastShare = 1.0f / 14.0f;
/// x_light = difference^2 / (2 (kFilterSigmas sigma)^2).
constexpr float kFilterSigmas = 3.1f;
/// A pixel's own weight beside taps of 0.125 and 0.0625: below 0.25, so that four levels leave nothing of a firefly.
constexpr float kFilterOwn = 0.22f, kFilterSide = 0.125f, kFilterCorner = 0.0625f;
/// Numbers of like pixels from which on variances and extremes are believed.
constexpr float kFilterEnough = 2.5f, kFilterSome = 3.5f, kFilterMany = 5.5f;
/// Weights below which nothing was found, and what is divided by at the least; variance where nothing is known.
constexpr float kFilterFound = 1e-3f, kFilterTiny = 1e-20f, kFilterLeastWeight = 1e-10f, kFilterLeastInverse = 1e-30f,
                kFilterUnknown = 1e20f;

/// Tolerances of the plane test, in pixel widths a pixel of step: flat surfaces need none, a shading normal leans away from its
/// plane.
constexpr float kFilterFlatSlope = 0.05f, kFilterSlope = 0.15f;
/// Of earlier frames: no more than so many count, for what has changed since fades away; a point is the same if it lies within so
/// many pixel widths of the plane and its normal within 37 degrees; less than a share of the four pixels around says too little.
constexpr float kHistoryFrames = 16.0f, kHistoryThickness = 2.0f, kHistoryCosine = 0.8f, kHistoryShare = 0.1f;

// ---- tier reference
/// Bounces of a path at the most (closed rooms have more on the CPU), from which one on chance may end it, and the panes that a path
/// or a shadow ray may pass beside.
constexpr int kMaxBounces = 8, kFirstRoulette = 3, kMostPanes = 16;
/// Texture footprint of a camera ray in pixels: samples filter the pixel, not the texture look-up.
constexpr float kPathFootprint = 0.25f;
/// Rays of a lobe see textures through a cone a quarter as wide as the circle that holds its density.
constexpr float kPathLobe = 0.25f, kPathWidest = 0.2f;
/// In a closed room the light of a mirror is what is seen in it.
constexpr float kMirrorPdf = 50.0f;
/// Densities below which a direction is not taken; what is divided by at the least; most probable survival of a path; share of the
/// way to a light that is looked at.
constexpr float kLeastPdf = 1e-12f, kDividedPdf = 1e-20f, kDividedShare = 1e-6f, kMostSurvival = 0.95f, kShadowReach = 1.0f - 1e-4f;
/// `event` of bsdf_sample from which on a path goes straight on.
constexpr float kStraightEvent = 1.5f;
/// Light just below the horizon still counts a little, so that rounding never hides a lamp that can be seen.
constexpr float kLampMargin = 0.01f, kLampLeastCosine = 0.005f, kLampDistance2 = 1e-12f, kLampDistance = 1e-6f, kLampGrazing = 1e-5f;
/// Of the sky's running shares: least step, and below 1.
constexpr float kLeastStep = 1e-12f, kBelowOne = 0.9999999f;

#ifdef __cplusplus
}  // namespace airsim360::internal
#endif

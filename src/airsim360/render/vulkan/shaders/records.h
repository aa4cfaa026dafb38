// What the CPU writes and shaders read, once for C++ and GLSL: scalar layout, addresses of 8 bytes first.
// Not a normal header of either: C++ includes it through gpu_records.h, GLSL after the buffer references of common.glsl.

struct GpuMesh {
  ADDRESS(Floats) positions;    // x y z
  ADDRESS(Uints) indices;       // three of each primitive: opaque triangles, then alpha-tested ones, then clear panes
  ADDRESS(Floats) uvs;          // u v, of the mesh; not read where flags lack kGpuHasUvs
  ADDRESS(Uints) colors;        // two words a vertex, r g and b a of 16 bits; not read where flags lack kGpuHasColors
  ADDRESS(Uints) triangle_of;   // primitive -> triangle of the mesh; not read without kGpuSorted
  ADDRESS(Uints) entity_of;     // triangle -> entity; not read without kGpuHasEntities
  ADDRESS(Uints) material_of;   // triangle -> material
  uint first[4];                // primitive where the geometries 0, 1, 2 begin, and the end
  uint flags;
  uint pad;
};

struct GpuInstance {
  ADDRESS(Floats) positions;    // of the mesh at this instant
  uint mesh;
  uint entity;
  float A[9];                   // mesh frame to W, row-major
  float p[3];
  uint hidden;
  uint normals;                 // bent meshes: where vertex normals begin in `positions`; 0 = there are none
};

// Holes of a material.
struct GpuAlpha {
  ADDRESS(Uints) texels;        // four 8-bit alphas a word, rows padded to whole words
  float uv[6];                  // m00 m01 m10 m11 t.x t.y
  float scale, cutoff;
  uint width, height;           // 0 = no texture
  uint wrap_u, wrap_v;
};

// One picture.
struct GpuCamera {
  ADDRESS(Floats) columns;      // equirectangular: x y z sin cos planes of `stride` columns ...
  ADDRESS(Floats) rows;         // ... and scale x y z sin planes of `stride_rows` rows
  ADDRESS(Floats) rays;         // others: x y z of every pixel in C; 0 0 0 = no ray
  ADDRESS(Floats) lens;         // of kProjectLens: shape 6, radial 4, divisor 3, tangential 2, prism 4, 2 tan(shape0 / 2)
  ADDRESS(Floats) range;        // the pictures; 0 = not wanted
  ADDRESS(Uints) entity;
  ADDRESS(Shorts) semantic;
  ADDRESS(Floats) normal;
  ADDRESS(Floats) position;
  ADDRESS(Shorts) material;
  ADDRESS(Flows) flow;
  ADDRESS(Coverages) coverage;
  ADDRESS(Floats) albedo;
  ADDRESS(Floats) radiance;
  ADDRESS(Bytes) rgb;
  ADDRESS(Uints) centers;       // antialiasing: colours of the centre rays, 8 bits a channel ...
  ADDRESS(Floats) offsets;      // ... and 8 sets of samples - 1 points of a pixel: dx dy sin cos sin cos
  float origin[3];
  float R[9];                   // camera to W
  uint width, height, stride, stride_rows;
  uint separable;
  int column_shift;             // canonical columns to image columns
  float cone_angle;
  uint wanted;                  // kWant...
  // The next instant.
  float eye_offset[3];          // origin less next origin
  float next_origin[3];
  float next_R[9];              // its R0; of cube faces, of the face
  int column_turn;
  uint projection;              // kProject...
  float focal[2], center[2];
  float distortion[4];
  float max_theta;
  uint law;                     // LensLaw of kProjectLens
  float projection_R[9];        // from the frame of the projection (of cube faces: the face's) to W
  float exposure;
  uint samples;                 // of a pixel on an edge; 0, 1 = no antialiasing
  uint points;                  // of a pixel in `offsets`, its centre included: those of `samples` and of coverage
  uint paths;                   // of a pixel; tier reference
  // Tiers high and reference.
  ADDRESS(Floats) planes;       // high.glsl; of tier reference sums of radiance, then numbers of paths
  ADDRESS(Floats) row_tables;   // by row: ambient rays of a pixel; then its height over its width
  uint high_seed[2];
  uint edge_seed;
  uint history_use;             // kHistory...: light of the last frame
  ADDRESS(Floats) history;      // filter.rgen
  float history_R[9];           // its frame of the projection to W
  float history_offset[3];      // origin less its origin
  uint denoise;                 // 0 or 1
};

struct GpuFlow {
  float dx, dy, range;
  uint occluded;
  float motion[3];
};

struct GpuCoverage {            // CoveragePixel
  uint entity[4];
  float share[4];
};

struct GpuFrameParams {
  ADDRESS(Meshes) meshes;
  ADDRESS(Instances) instances;
  ADDRESS(Instances) next_instances;
  ADDRESS(Uints) category_of;   // entity -> category
  ADDRESS(Alphas) alphas;       // material -> holes
  ADDRESS(Cameras) cameras;
  ADDRESS(Shade) shade;         // colour tiers; else 0
  ADDRESS(High) high;           // tier `high`; else 0
  ADDRESS(PathTables) path;     // tier `reference`; else 0
  uvec2 tlas, next_tlas;        // addresses
  uint sky_entity;
  uint flags;
};

// What tier `reference` needs beyond the tables of shade_records.h. Included as records.h is.

struct GpuLightNode {             // LightTree::Node
  float center[3], radius2;       // of the box
  float power, axis[3], spread;
  uint second, parent, lamp;      // second 0 = a leaf
};

struct GpuPathLamp {
  uint first, count;              // of its parts
  uint leaf;                      // its node
  float area;
  float glow[3], beam[3];         // Instance::glow; Lamp::beam
  uint hash;                      // of the instance
};

struct GpuLampPart {
  float corner[9], normal[3];     // in W
  float share;                    // of the lamp's area up to and including this part
  uint triangle;                  // of the tables for shading
};

struct GpuPath {
  ADDRESS(Floats) sky_density;    // SkySampler; of 256 x 256 cells
  ADDRESS(Floats) sky_cumulative;
  ADDRESS(Floats) sky_rows;
  ADDRESS(LightNodes) nodes;
  ADDRESS(PathLamps) lamps;
  ADDRESS(LampParts) parts;
  ADDRESS(Uints) lamp_of;         // by triangle of instances with lamps: 1 + lamp; 0 = none ...
  ADDRESS(Uints) lamp_of_first;   // ... where each instance begins; 0 = it has none
  float room_light[3];
  uint has_sky, has_sun, lamp_count, clear_panes;
};

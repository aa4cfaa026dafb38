// What tier `high` needs beyond the tables of shade_records.h. Included as records.h is.

struct GpuHigh {
  ADDRESS(Floats) sun_heights;  // SunMapView; size 0 = no sun
  ADDRESS(Floats) lamp_sides;   // by cell, six mean irradiances
  ADDRESS(Uints) lamp_bits;     // 1 = a triangle that is a lamp of the grid ...
  ADDRESS(Uints) lamp_bits_of;  // ... the first of each instance; 0 = it has none
  float sun_axes[12];           // column, row, height of a point
  float sun_bias;
  uint sun_size;
};

// The shapes of the cars, from the proportions of common models.
#include "airsim360/worlds/props/car_shape.h"

namespace airsim360::internal {

// clang-format off
const CarShape& Sedan() {
  static const CarShape shape{{{-2.26f, 0.60f}, {-2.22f, 0.68f}, {-2.05f, 0.745f}, {-1.6f, 0.84f}, {-1.02f, 0.935f}, {-0.12f, 1.37f}, {0.15f, 1.425f}, {0.55f, 1.435f}, {0.95f, 1.385f}, {1.68f, 1.08f}, {2.08f, 1.04f}, {2.22f, 0.96f}, {2.27f, 0.80f}},
                              {{-2.26f, 0.56f}, {-2.1f, 0.68f}, {-1.5f, 0.80f}, {-1.0f, 0.885f}, {0.5f, 0.94f}, {1.6f, 0.98f}, {2.1f, 0.95f}, {2.27f, 0.76f}},
                              {{-2.26f, 0.58f}, {-2.20f, 0.70f}, {-2.0f, 0.81f}, {-1.6f, 0.875f}, {-0.8f, 0.895f}, {0.9f, 0.90f}, {1.7f, 0.875f}, {2.1f, 0.80f}, {2.24f, 0.70f}, {2.27f, 0.60f}},
                              0.59f,
                              -1.36f,
                              1.36f,
                              0.325f, {-0.98f, -0.16f}, {0.99f, 1.64f}, {-0.80f, 1.40f},
                              {{0.20f, 0.29f}, {1.02f, 1.12f}}};
  return shape;
}

const CarShape& Hatchback() {
  static const CarShape shape{{{-2.02f, 0.62f}, {-1.98f, 0.72f}, {-1.8f, 0.80f}, {-1.4f, 0.90f}, {-0.98f, 0.98f}, {-0.15f, 1.41f}, {0.2f, 1.47f}, {0.9f, 1.475f}, {1.35f, 1.43f}, {1.86f, 1.02f}, {1.98f, 0.92f}, {2.02f, 0.75f}},
                              {{-2.02f, 0.58f}, {-1.85f, 0.72f}, {-1.3f, 0.86f}, {-0.9f, 0.92f}, {0.6f, 0.97f}, {1.6f, 1.0f}, {1.9f, 0.93f}, {2.02f, 0.72f}},
                              {{-2.02f, 0.58f}, {-1.96f, 0.68f}, {-1.75f, 0.80f}, {-1.3f, 0.86f}, {-0.6f, 0.875f}, {1.0f, 0.875f}, {1.6f, 0.84f}, {1.9f, 0.78f}, {2.02f, 0.66f}},
                              0.60f,
                              -1.24f,
                              1.26f,
                              0.31f, {-0.94f, -0.18f}, {1.40f, 1.82f}, {-0.72f, 1.52f},
                              {{0.22f, 0.31f}, {1.08f, 1.17f}}};
  return shape;
}

const CarShape& Suv() {
  static const CarShape shape{{{-2.28f, 0.72f}, {-2.24f, 0.86f}, {-2.05f, 0.98f}, {-1.5f, 1.08f}, {-1.05f, 1.13f}, {-0.32f, 1.62f}, {0.0f, 1.70f}, {0.9f, 1.725f}, {1.75f, 1.68f}, {2.12f, 1.16f}, {2.24f, 1.02f}, {2.28f, 0.80f}},
                              {{-2.28f, 0.70f}, {-2.1f, 0.90f}, {-1.5f, 1.01f}, {-0.9f, 1.06f}, {0.6f, 1.10f}, {1.8f, 1.13f}, {2.15f, 1.05f}, {2.28f, 0.78f}},
                              {{-2.28f, 0.66f}, {-2.2f, 0.78f}, {-2.0f, 0.88f}, {-1.5f, 0.93f}, {-0.6f, 0.945f}, {1.2f, 0.945f}, {1.8f, 0.92f}, {2.15f, 0.86f}, {2.28f, 0.74f}},
                              0.66f,
                              -1.40f,
                              1.42f,
                              0.37f, {-1.00f, -0.35f}, {1.80f, 2.08f}, {-0.85f, 1.92f},
                              {{0.18f, 0.29f}, {1.14f, 1.25f}}};
  return shape;
}

const CarShape& PanelVan() {
  static const CarShape shape{
      {{-2.75f, 0.75f}, {-2.70f, 0.95f}, {-2.5f, 1.10f}, {-1.95f, 1.24f}, {-1.30f, 2.02f}, {-1.0f, 2.28f}, {-0.6f, 2.40f}, {0.5f, 2.44f}, {2.55f, 2.42f}, {2.72f, 2.32f}, {2.76f, 1.2f}},
      {{-2.75f, 0.72f}, {-2.5f, 1.02f}, {-1.9f, 1.16f}, {-1.0f, 1.22f}, {2.6f, 1.24f}, {2.76f, 1.1f}},
      {{-2.75f, 0.72f}, {-2.66f, 0.86f}, {-2.4f, 0.95f}, {-1.8f, 0.985f}, {-1.0f, 0.995f}, {2.5f, 0.995f}, {2.72f, 0.96f}, {2.76f, 0.92f}},
      0.84f,
      -1.78f,
      1.62f,
      0.36f, {-1.92f, -1.12f},
      {9, 9}, {-1.72f, -0.52f},
      {}};
  return shape;
}
// clang-format on

float Lookup(const std::vector<Vec2f>& line, float y) {
  if (y <= line.front().x) return line.front().y;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    if (y > line[i + 1].x) continue;
    return line[i].y + (line[i + 1].y - line[i].y) * (y - line[i].x) / (line[i + 1].x - line[i].x);
  }
  return line.back().y;
}

}  // namespace airsim360::internal

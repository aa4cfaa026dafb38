#include "airsim360/worlds/interior/building_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <queue>
#include <set>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr BuildingUse kUses[] = {BuildingUse::kApartment, BuildingUse::kOffice,  BuildingUse::kWarehouse,
                                 BuildingUse::kMall,      BuildingUse::kCarPark, BuildingUse::kLibrary};

InteriorPlan PlanOf(BuildingUse use, uint64_t seed = 0) { return PlanBuilding({.use = use}, seed); }

template <class Visit>
void ForPlans(const Visit& visit) {
  for (const BuildingUse use : kUses)
    for (uint64_t seed = 0; seed < 8; ++seed) {
      SCOPED_TRACE(std::string(kBuildingUses[static_cast<size_t>(use)]) + " seed " + std::to_string(seed));
      visit(PlanOf(use, seed));
      if (use == BuildingUse::kLibrary) visit(PlanBuilding({.use = use, .atrium = true}, seed));
    }
}

TEST(InteriorPlan, RoomsOfAStoreyTileItsOutline) {
  ForPlans([](const InteriorPlan& plan) {
    for (int s = 0; s < static_cast<int>(plan.spec.storeys); ++s) {
      double sum = 0;
      for (size_t i = 0; i < plan.rooms.size(); ++i) {
        if (plan.rooms[i].storey != s) continue;
        const PlanRect a = plan.rooms[i].cell;
        sum += static_cast<double>(a.area());
        for (size_t j = 0; j < i; ++j) {
          const PlanRect b = plan.rooms[j].cell;
          if (plan.rooms[j].storey != s) continue;
          EXPECT_FALSE(a.x0 < b.x1 - 1e-3f && b.x0 < a.x1 - 1e-3f && a.y0 < b.y1 - 1e-3f && b.y0 < a.y1 - 1e-3f)
              << plan.rooms[i].name << " overlaps " << plan.rooms[j].name;
        }
      }
      EXPECT_NEAR(sum, static_cast<double>(plan.outline.area()), 0.1);
    }
  });
}

// Widths: DIN 18101 and ADA 404 (0.71 … 1.3 m a leaf); heights: habitable rooms from 2.4 m (IRC R305: 2.13), offices 2.5 … 3.2 m
// (ASR A1.2: 2.5 m and more), car parks from 2.1 m (IBC 406.2.2), racks of 8 … 12 m below warehouse roofs.
TEST(InteriorPlan, DoorsAndCeilingsAreWithinPublishedRanges) {
  ForPlans([](const InteriorPlan& plan) {
    for (const PlanWall& wall : plan.walls) {
      for (const PlanOpening& o : wall.openings) {
        const float width = o.to - o.from;
        if (o.kind == OpeningKind::kDoor) {
          EXPECT_GE(width, 0.79f);
          EXPECT_LE(width, 1.31f);
        }
        if (o.kind == OpeningKind::kDoubleDoor) {
          EXPECT_GE(width, 1.39f);
          EXPECT_LE(width, 2.6f);
        }
        if (IsDoor(o.kind) && o.kind != OpeningKind::kDockDoor) {
          EXPECT_GE(o.head, 2.05f);
          EXPECT_LE(o.head, 2.7f);
        }
        if (o.kind == OpeningKind::kDockDoor) {
          EXPECT_GE(width, 2.4f);
          EXPECT_LE(width, 4.2f);
        }
      }
    }
    for (const PlanRoom& room : plan.rooms) {
      if (!room.has_floor || !room.has_ceiling) continue;
      const float height = room.ceiling_z - room.floor_z;
      EXPECT_GE(height, 2.4f) << room.name;
      if (plan.spec.use == BuildingUse::kApartment) {
        EXPECT_LE(height, 3.0f) << room.name;
      }
      if (room.type == RoomType::kOpenOffice) {
        EXPECT_GE(height, 2.5f);
        EXPECT_LE(height, 3.2f);
      }
      if (room.type == RoomType::kWarehouseHall) {
        EXPECT_GE(height, 10.0f);
        EXPECT_LE(height, 14);
      }
      if (room.type == RoomType::kParkingDeck) {
        EXPECT_LE(height, 3.2f);
      }
    }
  });
}

TEST(InteriorPlan, HasTheAreaThatIsAsked) {
  const auto least = [](BuildingUse use, double area) {
    for (uint64_t seed = 0; seed < 8; ++seed) EXPECT_GE(PlanOf(use, seed).area_m2(), area) << kBuildingUses[static_cast<size_t>(use)];
  };
  least(BuildingUse::kApartment, 150);
  least(BuildingUse::kOffice, 600);
  least(BuildingUse::kWarehouse, 2000);
  least(BuildingUse::kMall, 3000);
  least(BuildingUse::kCarPark, 2500);
}

// Rooms are joined by doors, passages and missing walls; storeys by stairs, ramps and escalators.
TEST(InteriorPlan, EveryRoomIsReachedFromOutside) {
  ForPlans([](const InteriorPlan& plan) {
    std::set<int> reached;
    std::queue<int> next;
    const auto reach = [&](int room) {
      if (room >= 0 && reached.insert(room).second) next.push(room);
    };
    for (const PlanWall& wall : plan.walls)
      for (const PlanOpening& o : wall.openings)
        if (o.outer && (IsDoor(o.kind) || o.kind == OpeningKind::kPassage)) reach(std::max(wall.low, wall.high));
    ASSERT_FALSE(reached.empty()) << "no door leads outside";
    while (!next.empty()) {
      const int room = next.front();
      next.pop();
      for (const PlanWall& wall : plan.walls) {
        if (wall.low != room && wall.high != room) continue;
        const bool way = wall.kind == WallKind::kOpen || std::any_of(wall.openings.begin(), wall.openings.end(), [](const PlanOpening& o) {
                           return IsDoor(o.kind) || o.kind == OpeningKind::kPassage;
                         });
        if (way) reach(wall.low == room ? wall.high : wall.low);
      }
      // Up and down where a room is open to the one above it.
      for (size_t i = 0; i < plan.rooms.size(); ++i) {
        const PlanRoom &a = plan.rooms[static_cast<size_t>(room)], &b = plan.rooms[i];
        if (std::abs(a.storey - b.storey) == 1 && a.cell.Contains(b.cell.center()) && !(a.storey < b.storey ? a : b).has_ceiling &&
            a.type != RoomType::kAtrium)
          reach(static_cast<int>(i));
      }
    }
    for (size_t i = 0; i < plan.rooms.size(); ++i) {
      EXPECT_TRUE(!plan.rooms[i].has_floor || reached.contains(static_cast<int>(i))) << plan.rooms[i].name;
    }
  });
}

TEST(InteriorPlan, OpeningsLieInTheirWallsAndApart) {
  ForPlans([](const InteriorPlan& plan) {
    for (const PlanWall& wall : plan.walls) {
      float at = 0;
      for (const PlanOpening& o : wall.openings) {
        EXPECT_GE(o.from, at);
        EXPECT_GT(o.to, o.from);
        EXPECT_LT(o.sill, o.head);
        EXPECT_LE(o.to, wall.length() + 1e-3f);
        EXPECT_LE(o.head, static_cast<float>(plan.spec.storey_height) - kSlab + 1e-3f);
        at = o.to;
      }
    }
  });
}

TEST(InteriorPlan, LibrariesHaveAnAtriumWhereItIsAskedFor) {
  const auto open = [](const InteriorPlan& plan) {
    return std::count_if(plan.rooms.begin(), plan.rooms.end(), [](const PlanRoom& r) { return r.type == RoomType::kAtrium; });
  };
  for (const uint64_t storeys : {1, 2, 3}) {
    const InteriorPlan plan = PlanBuilding({.use = BuildingUse::kLibrary, .storeys = storeys}, 0);
    EXPECT_EQ(open(plan), 0);
    // Floors go through: only stairs and lifts have none.
    for (const PlanRoom& room : plan.rooms)
      EXPECT_TRUE(room.has_floor || room.type == RoomType::kStairwell || room.type == RoomType::kLiftShaft) << room.name;
    if (storeys > 1) {
      const InteriorPlan asked = PlanBuilding({.use = BuildingUse::kLibrary, .storeys = storeys, .atrium = true}, 0);
      EXPECT_EQ(open(asked), static_cast<int>(2 * storeys));
      EXPECT_LT(asked.area_m2(), plan.area_m2());
    }
  }
}

TEST(InteriorPlan, RampsAndEscalatorsAreAsSteepAsRealOnes) {
  for (uint64_t seed = 0; seed < 4; ++seed) {
    const InteriorPlan deck = PlanOf(BuildingUse::kCarPark, seed), mall = PlanOf(BuildingUse::kMall, seed);
    ASSERT_EQ(deck.ramps.size(), deck.spec.storeys - 1);
    for (const PlanSlope& ramp : deck.ramps) EXPECT_LE((ramp.z1 - ramp.z0) / ramp.rect.depth(), 0.15f);  // most garage rules
    ASSERT_EQ(mall.escalators.size(), 2u);
    for (const PlanSlope& e : mall.escalators)
      EXPECT_NEAR((e.z1 - e.z0) / (e.rect.width() - 2.4f), 0.577f, 0.01f);  // 30 degrees (EN 115-1)
  }
}

TEST(InteriorPlan, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const auto text = [](const InteriorPlan& plan) {
    std::string all;
    for (const PlanRoom& r : plan.rooms) all += r.name + " " + std::to_string(r.cell.x0) + " " + std::to_string(r.cell.y1) + "\n";
    return all;
  };
  EXPECT_EQ(text(PlanOf(BuildingUse::kApartment, 3)), text(PlanOf(BuildingUse::kApartment, 3)));
  EXPECT_NE(text(PlanOf(BuildingUse::kApartment, 3)), text(PlanOf(BuildingUse::kApartment, 4)));
}

TEST(BuildingSpec, RefusesWhatNoBuildingOfItsUseHas) {
  const auto refused = [](const BuildingSpec& spec, const char* word) {
    try {
      spec.Check("building: ");
      ADD_FAILURE() << word;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refused({.use = BuildingUse::kWarehouse, .storeys = 2}, "storeys");
  refused({.use = BuildingUse::kMall, .width = 20}, "width");
  refused({.use = BuildingUse::kApartment, .storey_height = 9}, "storey_height");
  refused({.use = BuildingUse::kCarPark, .atrium = true}, "atrium");
  refused({.use = BuildingUse::kOffice, .storeys = 1, .atrium = true}, "atrium");
  refused({.use = BuildingUse::kOffice, .storeys = 70}, "storeys");
}

TEST(BuildingSpec, EveryAllowedSizeCanBePlanned) {
  for (const BuildingUse use : kUses) {
    for (const double side : {0.0, 66.0, 120.0})
      for (const uint64_t storeys : {1, 2, 6}) {
        BuildingSpec spec{.use = use, .width = side, .depth = side, .storeys = use == BuildingUse::kWarehouse ? 1 : storeys};
        const InteriorPlan plan = PlanBuilding(spec, 1);
        EXPECT_GT(plan.rooms.size(), 5u);
      }
  }
}

}  // namespace
}  // namespace airsim360::internal

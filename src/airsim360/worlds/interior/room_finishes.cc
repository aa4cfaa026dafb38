// Which finishes a room has, by its type, its number and the seed.
#include "airsim360/base/random.h"
#include "airsim360/worlds/interior/interior.h"

namespace airsim360::internal {
namespace {

using F = Finish;
using T = RoomType;

F HomeWall(RngStream& rng) {
  constexpr F kWalls[] = {F::kPlasterWhite, F::kPlasterWarm,  F::kPlasterSage, F::kPlasterBlue,
                          F::kPlasterRose,  F::kPlasterWhite, F::kPlasterWarm};
  return kWalls[rng.Index(7)];
}

// Of rooms that no home and no office desk stands in.
RoomFinish FinishOfHall(const InteriorPlan& plan, const PlanRoom& room, F carpet, RngStream& rng) {
  switch (room.type) {
    case T::kPrintRoom:
    case T::kDispatchOffice:
      return {F::kEpoxy, F::kPlasterGrey, F::kCeilingTiles, true};
    case T::kLobby:
      return {plan.spec.use == BuildingUse::kMall ? F::kTerrazzo : F::kStone, F::kPlasterWhite, F::kCeilingPlaster, false};
    case T::kStairwell:
      return {F::kConcreteFloor, F::kPlasterGrey, F::kCeilingConcrete, false};
    case T::kLiftShaft:
      return {F::kConcreteFloor, F::kConcreteWall, F::kCeilingConcrete, false};
    case T::kWarehouseHall:
      return {F::kEpoxy, F::kRibbedWhite, F::kSteelDeck, false};
    case T::kShop:
      return {rng.Chance(0.4)   ? F::kOak
              : rng.Chance(0.5) ? F::kTileWhite
                                : F::kTileGrey,
              rng.Chance(0.4) ? HomeWall(rng) : F::kPlasterWhite, F::kCeilingPlaster, true};
    case T::kSupermarket:
      return {F::kTileWhite, F::kPlasterWhite, F::kCeilingTiles, false};
    case T::kFoodCourt:
      return {F::kTileGrey, F::kPlasterWarm, F::kCeilingPlaster, false};
    case T::kConcourse:
    case T::kAtrium:
    case T::kGallery:
      if (plan.spec.use == BuildingUse::kLibrary)
        return {room.storey == 0 ? F::kStone : carpet, F::kPlasterWhite, F::kCeilingPlaster, false};
      return {plan.spec.use == BuildingUse::kOffice ? F::kStone : F::kTerrazzo, F::kPlasterWhite, F::kCeilingPlaster, false};
    case T::kParkingDeck:
    case T::kRamp:
      return {F::kDeck, F::kConcreteWall, F::kCeilingConcrete, false};
    case T::kReadingRoom:
    case T::kBookStacks:
      return {carpet, rng.Chance(0.5) ? F::kPlasterWarm : F::kPlasterWhite, F::kCeilingTiles, true};
    default:
      return {F::kConcreteFloor, F::kPlasterWhite, F::kCeilingPlaster, false};
  }
}

}  // namespace

RoomFinish FinishOf(const InteriorPlan& plan, int index) {
  const PlanRoom& room = plan.rooms[static_cast<size_t>(index)];
  RngStream rng(plan.seed, "room finish", static_cast<uint64_t>(index)), house(plan.seed, "house finish");
  const bool home = plan.spec.use == BuildingUse::kApartment;
  const F wood = house.Chance(0.6) ? F::kOak : F::kWalnut, carpet = house.Chance(0.5) ? F::kCarpetGrey : F::kCarpetBlue;
  switch (room.type) {
    case T::kLivingRoom:
    case T::kDiningRoom:
      return {wood, house.Chance(0.5) ? F::kPlasterWarm : F::kPlasterWhite, F::kCeilingPlaster, true};
    case T::kBedroom:
    case T::kChildRoom:
    case T::kStudy:
      return {wood, HomeWall(rng), F::kCeilingPlaster, true};
    case T::kKitchen:
      return {F::kTileGrey, F::kPlasterWhite, F::kCeilingPlaster, true};
    case T::kBathroom:
      return {F::kTileGrey, F::kBathTiles, F::kCeilingPlaster, false};
    case T::kToilet:
      return {home ? F::kTileGrey : F::kTileWhite, F::kBathTiles, home ? F::kCeilingPlaster : F::kCeilingTiles, false};
    case T::kHall:
      return {home ? wood : F::kStone, F::kPlasterWhite, F::kCeilingPlaster, true};
    case T::kCorridor:
      return {home ? wood : carpet, F::kPlasterWhite, home ? F::kCeilingPlaster : F::kCeilingTiles, true};
    case T::kStorage:
      return {F::kConcreteFloor, F::kPlasterGrey, F::kCeilingPlaster, false};
    case T::kOpenOffice:
      return {carpet, rng.Chance(0.5) ? F::kPlasterWhite : F::kPlasterGrey, F::kCeilingTiles, true};
    case T::kCellOffice:
      return {carpet, rng.Chance(0.3) ? F::kPlasterSage : F::kPlasterWhite, F::kCeilingTiles, true};
    case T::kMeetingRoom:
      return {carpet, rng.Chance(0.5) ? F::kPlasterBlue : F::kPlasterWarm, F::kCeilingTiles, true};
    case T::kPantry:
    case T::kBreakRoom:
      return {F::kTileWhite, F::kPlasterWarm, F::kCeilingTiles, true};
    default:
      return FinishOfHall(plan, room, carpet, rng);
  }
}

Finish FacadeOf(const InteriorPlan& plan) {
  switch (plan.spec.use) {
    case BuildingUse::kWarehouse:
      return F::kFacadeRibbed;
    case BuildingUse::kCarPark:
      return F::kConcreteWall;
    case BuildingUse::kApartment:
      return F::kFacadeRender;
    default:
      return F::kFacadePanel;
  }
}

}  // namespace airsim360::internal

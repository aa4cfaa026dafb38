// The families of furnishings. A new piece is a row and a function in the file of its family; a new family is one file
// that defines its function, declared here and listed in furnishings.cc.
#pragma once

#include <vector>

#include "airsim360/worlds/furnishings/furnishings.h"

namespace airsim360::internal {

/// One kind and where it goes.
struct FurnishingRow {
  PropKind kind;
  Mount mount = Mount::kFloor;
  float sill = 0;
};
using FurnishingRows = std::vector<FurnishingRow>;

FurnishingRows BedRows();         // beds, nightstands
FurnishingRows StorageRows();     // wardrobes, dressers, shelves, coat racks
FurnishingRows SofaRows();        // sofas, armchairs
FurnishingRows TableRows();       // tables and chairs of homes
FurnishingRows MediaRows();       // television and its stand
FurnishingRows KitchenRows();     // counters, stove, fridge, cabinets, microwave
FurnishingRows BathroomRows();    // toilet, basin, bath, shower, washing machine
FurnishingRows TextileRows();     // rugs, curtains
FurnishingRows WallPieceRows();   // pictures, mirrors
FurnishingRows PlantRows();       // potted plants of rooms and halls
FurnishingRows SmallThingRows();  // vases, books, dishes, shoes
FurnishingRows HomeLampRows();    // lamps of homes
FurnishingRows HallLampRows();    // lamps of offices, halls and car parks; exit signs
FurnishingRows OfficeRows();      // desks, chairs, cabinets, partitions
FurnishingRows DeviceRows();      // screens, computers, printers
FurnishingRows RackRows();        // pallets, cartons, pallet racks
FurnishingRows WarehouseRows();   // fork lift trucks, drums, ladders
FurnishingRows ShopRows();        // shelves of goods, clothes, checkouts
FurnishingRows MallRows();        // benches, planters, kiosks
FurnishingRows EscalatorRows();   // escalators, lift doors
FurnishingRows ServiceRows();     // ducts, pipes, safety
FurnishingRows CarParkRows();     // barriers, tickets, guards

}  // namespace airsim360::internal

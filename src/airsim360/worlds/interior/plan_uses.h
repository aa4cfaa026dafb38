// One function a use of buildings: its rooms, doors and windows by rules.
#pragma once

#include "airsim360/worlds/interior/plan_pen.h"

namespace airsim360::internal {

void PlanApartment(PlanPen& pen);
void PlanOffice(PlanPen& pen);
void PlanWarehouse(PlanPen& pen);
void PlanMall(PlanPen& pen);
void PlanCarPark(PlanPen& pen);
void PlanLibrary(PlanPen& pen);

}  // namespace airsim360::internal

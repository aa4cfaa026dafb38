// Names of nodes (n), materials (m) and files (f) from public model collections, with what a person who saw the
// models would call them; written down before the keyword table was tuned. For tests alone.
#pragma once

namespace airsim360::internal {

struct LabelledName {
  char kind;
  const char* name;
  const char* is;  ///< category path or the start of one, '|' between choices; "" = the name tells nothing
};

inline constexpr LabelledName kLabelledNames[] = {
    // Names of 3ds Max, Blender and other programs for things that nobody named.
    {'n', "Box001", ""}, {'n', "Box111", ""}, {'n', "Box04", ""}, {'n', "Box005", ""}, {'n', "Cone.003", ""},
    {'n', "Cylinder", ""}, {'n', "Plane.002", ""}, {'n', "TwoSidedPlane", ""}, {'n', "BackPlane", ""}, {'n', "Circle", ""},
    {'n', "Torus", ""}, {'n', "polySurface14", ""}, {'n', "pCube1", ""}, {'n', "Object_5", ""}, {'n', "RootNode", ""},
    {'n', "Sketchfab_model", ""}, {'n', "defaultMaterial", ""}, {'n', "Suzanne.001", ""}, {'n', "LightOmni", ""},
    {'n', "CameraOrtho", ""}, {'n', "Sun", ""}, {'n', "Bone.005_end", ""}, {'n', "DEF-forearm.L_047", ""},
    {'n', "R_handPointer0003_bind_JNT", ""}, {'n', "LeftPalm", ""}, {'n', "WalkCycle", ""}, {'n', "AutoSmooth", ""},
    {'n', "mesh-split_2", ""}, {'n', "TruncatedIndexedLines", ""}, {'n', "RowLabel_4", ""}, {'n', "Rotation - Correct", ""},
    {'n', "Band 5R", ""}, {'n', "body_14", ""}, {'n', "Piston_123-844_0_Parts_1", ""}, {'n', "LAST.001", ""}, {'n', "All", ""},
    // Parts of things that are no part of the tree.
    {'n', "TempleLeft", ""}, {'n', "TempleRight", ""}, {'n', "EarhookLeft", ""}, {'n', "Frames", ""}, {'m', "temples", ""},
    {'m', "nose_pads", ""}, {'n', "PortalFrame_PortalFrame_0", ""}, {'n', "Sill-01", ""}, {'n', "Raft-l-04", ""},
    {'n', "SecondGlass_Glass_0", ""}, {'n', "Flat Backdrop", ""}, {'n', "F-2-landingOnLight_7", ""}, {'n', "collision", ""},
    {'n', "Love", ""}, {'n', "Kopf", ""}, {'n', "Bein2Re", ""}, {'n', "Timestep", ""}, {'n', "Step_Index", ""},
    // Materials.
    {'m', "WhiteCloth", ""}, {'m', "Snow", ""}, {'m', "White_Piece", ""}, {'m', "Hard Shiny Plastic White", ""},
    {'m', "Rose Gold", ""}, {'m', "jet black", ""}, {'m', "Cornea", ""}, {'m', "Windows", "construction/window"},
    {'m', "M_Cat_Statue", "construction/statue"}, {'m', "asphalt", "ground/road"}, {'m', "grass_dry", "ground/grass"},
    {'m', "Roof_Tiles", "construction/building/roof"}, {'m', "bark", "vegetation/tree"}, {'m', "water_blue", "water"},
    {'m', "Rubber", ""}, {'m', "Metal_Table", ""}, {'m', "Box_Texture", ""}, {'m', "CarPaint", ""},
    // Files: samples and tests.
    {'f', "ABeautifulGame", ""}, {'f', "AnimatedCube", ""}, {'f', "AnisotropyBarnLamp", "furniture/lighting"},
    {'f', "Avocado", ""}, {'f', "BarramundiFish", "animal"}, {'f', "BoomBox", ""}, {'f', "BoomBoxWithAxes", ""},
    {'f', "BoxTextured", ""}, {'f', "BoxVertexColors", ""}, {'f', "BrainStem", ""}, {'f', "CarConcept", "vehicle/car"},
    {'f', "CarbonFibre", ""}, {'f', "CesiumMan", "human"}, {'f', "CesiumMilkTruck", "vehicle/truck"},
    {'f', "ChairDamaskPurplegold", "furniture/seating"}, {'f', "ChronographWatch", ""}, {'f', "ClearCoatCarPaint", ""},
    {'f', "CommercialRefrigerator", "furniture/electronics/refrigerator"}, {'f', "Corset", ""},
    {'f', "DiffuseTransmissionPlant", "vegetation"}, {'f', "DiffuseTransmissionTeacup", ""}, {'f', "DirectionalLight", ""},
    {'f', "Duck", "animal"}, {'f', "EnvironmentTest", ""}, {'f', "FlightHelmet", ""}, {'f', "Fox", "animal"},
    {'f', "GlamVelvetSofa", "furniture/sofa"}, {'f', "GlassBrokenWindow", "construction/window"},
    {'f', "GlassHurricaneCandleHolder", ""}, {'f', "GlassVaseFlowers", "furniture/vase|vegetation/flower"},
    {'f', "Lantern", "furniture/lighting"}, {'f', "SheenWoodLeatherSofa", "furniture/sofa"}, {'f', "StainedGlassLamp", "furniture/lighting"},
    {'f', "SunglassesKhronos", ""}, {'f', "ToyCar", "vehicle/car"}, {'f', "WaterBottle", ""}, {'f', "PropertyTable", ""},
    {'f', "zero-sized-bin-chunk", ""}, {'f', "hotel-room-lotus-carpet", ""}, {'f', "cornellBox", ""}, {'f', "snowMan", ""},
    {'f', "snowBall", ""}, {'f', "bowlingBall", ""}, {'f', "runeSword", ""}, {'f', "coffin", ""}, {'f', "angel", ""},
    {'f', "ExplodingBarrel", "furniture/box"}, {'f', "fenceACorner1", "barrier/fence"}, {'f', "fenceAGate", "barrier/fence|construction/door"},
    {'f', "coastalCliff", "nature"}, {'f', "underwaterGround", "ground"}, {'f', "clothFolds", ""}, {'f', "enzo_star_field", ""},
    {'f', "RocketShip", ""}, {'f', "Astronaut", "human"}, {'f', "soldier", "human"}, {'f', "Canoe", "vehicle/boat"},
    {'f', "GeoPlanter", "furniture/planter"}, {'f', "Mixer", ""}, {'f', "ToyTrain", "vehicle/train"}, {'f', "AntiqueCamera", ""},
    {'f', "shishkebab", ""}, {'f', "jet-fighter", "vehicle/airplane"}, {'f', "chess-board", ""}, {'f', "vr-controller", ""},
    {'f', "glass-table", "furniture/table"}, {'f', "low-poly-tree", "vegetation/tree"}, {'f', "2CylinderEngine", ""},
    {'f', "lumberjack", "human"}, {'f', "magnolia", "vegetation"}, {'f', "rifle", ""}, {'f', "tv", "furniture/electronics/television"},
    // Building kits.
    {'f', "building_A_withoutBase", "construction/building"}, {'f', "bench", "furniture/seating"}, {'f', "bush", "vegetation/shrub"},
    {'n', "box_A", "furniture/box"}, {'f', "car_hatchback", "vehicle/car"}, {'f', "car_police", "vehicle/car"},
    {'f', "car_stationwagon", "vehicle/car"}, {'f', "dumpster", "furniture/waste"}, {'n', "road_straight_crossing", "ground"},
    {'n', "road_tsplit", "ground/road"}, {'n', "trash_A", "furniture/waste"}, {'n', "streetlight", "furniture/lighting"},
    {'n', "trafficlight_B", "traffic/control/traffic_light"}, {'n', "watertower", "construction/tower"},
    {'n', "building-small-d", "construction/building"}, {'n', "pavement-fountain", "construction/fountain"},
    {'n', "grass-trees-tall", "vegetation/tree"}, {'n', "road-intersection", "ground/road"}, {'n', "apartment_complex", "construction/building"},
    {'n', "aqueduct", "construction/bridge"}, {'n', "brewery", "construction/building"}, {'n', "coffee_roastery", "construction/building"},
    {'n', "community_center", "construction/building"}, {'n', "farm_house", "construction/house"}, {'n', "fire_station", "construction/building"},
    {'n', "fruit_stand", "furniture/vending"}, {'n', "general_store", "construction/building"}, {'n', "power_plant", "construction/building"},
    {'n', "radio_tower", "construction/tower"}, {'n', "research_lab", "construction/building"}, {'n', "school_house", "construction"},
    {'n', "shipping_dock", ""}, {'n', "tool_shed", "construction/house"}, {'n', "university", "construction/building"},
    {'n', "workshop", "construction/building"}, {'n', "character-female-a", "human"}, {'n', "character-male-b", "human"},
    {'n', "Tree_winding_01", "vegetation/tree"}, {'n', "Arbol.005", "vegetation/tree"}, {'n', "House2", "construction/house"},
    {'n', "Street_Lamp_02", "furniture/lighting"}, {'n', "stone_wall", "construction/wall"}, {'n', "Wooden Table", "furniture/table"},
    {'n', "table.004", "furniture/table"}, {'n', "Cardboard_Box_3", "furniture/box"}, {'n', "Temple", "construction/building"},
    {'n', "trash bin", "furniture/waste"}, {'n', "Traffic_Cone", "traffic/temporary/cone"}, {'n', "Pool_Table", "furniture/table"},
    {'n', "PalmTree_03", "vegetation/tree/palm"}, {'n', "MailBox_01", "furniture/mail"}, {'n', "Tree House", "construction/house"},
    {'n', "Lamborghini_Body", "vehicle/car"}, {'n', "Water", "water"}, {'n', "rock_large", "nature/rock"},
};

}  // namespace airsim360::internal

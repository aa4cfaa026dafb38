#include "airsim360/dataset/export/indoor_classes.h"

namespace airsim360::internal {
namespace {

constexpr const char* kNyu40[] = {"wall",       "floor",          "cabinet",        "bed",
                                  "chair",      "sofa",           "table",          "door",
                                  "window",     "bookshelf",      "picture",        "counter",
                                  "blinds",     "desk",           "shelves",        "curtain",
                                  "dresser",    "pillow",         "mirror",         "floor mat",
                                  "clothes",    "ceiling",        "books",          "refridgerator",
                                  "television", "paper",          "towel",          "shower curtain",
                                  "box",        "whiteboard",     "person",         "night stand",
                                  "toilet",     "sink",           "lamp",           "bathtub",
                                  "bag",        "otherstructure", "otherfurniture", "otherprop"};
constexpr const char* kMpcat40[] = {"wall",
                                    "floor",
                                    "chair",
                                    "door",
                                    "table",
                                    "picture",
                                    "cabinet",
                                    "cushion",
                                    "window",
                                    "sofa",
                                    "bed",
                                    "curtain",
                                    "chest_of_drawers",
                                    "plant",
                                    "sink",
                                    "stairs",
                                    "ceiling",
                                    "toilet",
                                    "stool",
                                    "towel",
                                    "mirror",
                                    "tv_monitor",
                                    "shower",
                                    "column",
                                    "bathtub",
                                    "counter",
                                    "fireplace",
                                    "lighting",
                                    "beam",
                                    "railing",
                                    "shelving",
                                    "blinds",
                                    "gym_equipment",
                                    "seating",
                                    "board_panel",
                                    "furniture",
                                    "appliances",
                                    "clothes",
                                    "objects",
                                    "misc"};
constexpr const char* kStanford13[] = {"beam", "board", "bookcase", "ceiling", "chair", "clutter", "column",
                                       "door", "floor", "sofa",     "table",   "wall",  "window"};

struct IndoorRow {
  std::string_view path;
  int nyu40, mpcat40, stanford13;
};
// Stanford's clutter is what stands in a room and has no class; ground and sky outside have none in any list.
constexpr int kClutter = 6;
constexpr IndoorRow kIndoorRows[] = {
    {"animal", 40, 39, kClutter},
    {"barrier", 38, 30, kClutter},
    {"construction", 38, 40, kClutter},
    {"construction/building", -1, -1, -1},
    {"construction/ceiling", 22, 17, 4},
    {"construction/column", 38, 24, 7},
    {"construction/door", 8, 4, 8},
    {"construction/house", -1, -1, -1},
    {"construction/pillar", 38, 24, 7},
    {"construction/stairs", 38, 16, kClutter},
    {"construction/wall", 1, 1, 12},
    {"construction/window", 9, 9, 13},
    {"furniture", 39, 36, kClutter},
    {"furniture/bathtub", 36, 25, kClutter},
    {"furniture/bed", 4, 11, kClutter},
    {"furniture/book", 23, 39, kClutter},
    {"furniture/bookcase", 10, 31, 3},
    {"furniture/box", 29, 39, kClutter},
    {"furniture/cabinet", 3, 7, kClutter},
    {"furniture/chest_of_drawers", 17, 13, kClutter},
    {"furniture/clothes", 21, 38, kClutter},
    {"furniture/counter", 12, 26, 11},
    {"furniture/curtain", 16, 12, kClutter},
    {"furniture/desk", 14, 5, 11},
    {"furniture/electronics", 40, 37, kClutter},
    {"furniture/electronics/monitor", 25, 22, kClutter},
    {"furniture/electronics/refrigerator", 24, 37, kClutter},
    {"furniture/electronics/television", 25, 22, kClutter},
    {"furniture/kitchen", 40, 37, kClutter},
    {"furniture/lighting", 35, 28, kClutter},
    {"furniture/mirror", 19, 21, kClutter},
    {"furniture/misc", 40, 39, kClutter},
    {"furniture/painting", 11, 6, kClutter},
    {"furniture/partition", 38, 35, kClutter},
    {"furniture/planter", 40, 14, kClutter},
    {"furniture/rack", 15, 31, 3},
    {"furniture/rug", 20, 2, 9},
    {"furniture/seating", 5, 34, 5},
    {"furniture/seating/armchair", 5, 3, 5},
    {"furniture/seating/chair", 5, 3, 5},
    {"furniture/seating/office_chair", 5, 3, 5},
    {"furniture/shelf", 15, 31, 3},
    {"furniture/shower", 39, 23, kClutter},
    {"furniture/sink", 34, 15, kClutter},
    {"furniture/sofa", 6, 10, 10},
    {"furniture/table", 7, 5, 11},
    {"furniture/toilet", 33, 18, kClutter},
    {"furniture/wardrobe", 3, 7, kClutter},
    {"furniture/whiteboard", 30, 35, 2},
    {"ground/floor", 2, 2, 9},
    {"ground/parking", 2, 2, 9},
    {"human", 31, 40, kClutter},
    {"object", 40, 39, kClutter},
    {"object/bag", 37, 39, kClutter},
    {"signage", 40, 39, 2},
    {"vehicle", 40, 39, kClutter},
};

const IndoorRow* RowOf(std::string_view path) {
  while (!path.empty()) {
    for (const IndoorRow& row : kIndoorRows)
      if (row.path == path) return &row;
    const size_t slash = path.rfind('/');
    path = slash == std::string_view::npos ? std::string_view{} : path.substr(0, slash);
  }
  return nullptr;
}

}  // namespace

std::span<const char* const> IndoorNames(IndoorList list) {
  switch (list) {
    case IndoorList::kNyu40:
      return kNyu40;
    case IndoorList::kMpcat40:
      return kMpcat40;
    case IndoorList::kStanford13:
      break;
  }
  return kStanford13;
}

int IndoorId(IndoorList list, std::string_view path) {
  const IndoorRow* row = RowOf(path);
  if (!row) return -1;
  return list == IndoorList::kNyu40 ? row->nyu40 : list == IndoorList::kMpcat40 ? row->mpcat40 : row->stanford13;
}

}  // namespace airsim360::internal

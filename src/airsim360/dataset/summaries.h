// The files of a dataset that are made from its index once all frames are there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "airsim360/dataset/index.h"

namespace airsim360 {

/// frames.jsonl: one line for each frame, in order.
std::string FramesJsonl(const DatasetIndex& index);
/// entities.json: id -> name, category, category_path, kind, first_frame of every entity seen.
std::string EntitiesJson(const DatasetIndex& index, const Scene& scene);
/// panoptic.json: COCO panoptic over entity/*.png, with bbox_wrap and solid_angle beside the standard keys.
std::string PanopticJson(const DatasetIndex& index, const DatasetSpec& spec, const Scene& scene);
/// people.jsonl: one line for each picture, in order.
std::string PeopleJsonl(const DatasetIndex& index, const DatasetSpec& spec);
/// materials.json: value in material/*.png -> name and appearance of every material of the scene.
std::string MaterialsJson(const Scene& scene);
/// parts.json: value in part/*.png -> name of the part.
std::string PartsJson();
/// README.md: the dataset card.
std::string CardMarkdown(const DatasetIndex& index, const DatasetSpec& spec, const Scene& scene);
/// contact_sheet.png: colour | range | semantic | entity, one row for each of up to kContactRows frames
/// spread evenly, and below what the colours of ranges and categories mean. Reads the pictures from `folder`.
inline constexpr int kContactRows = 8;
std::vector<std::byte> ContactSheetPng(const DatasetIndex& index, const DatasetSpec& spec, const Scene& scene,
                                       const std::filesystem::path& folder);

}  // namespace airsim360

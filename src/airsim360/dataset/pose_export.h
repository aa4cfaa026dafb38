// Poses and intrinsics of pinholes, fisheyes and calibrated lenses as COLMAP and nerfstudio read them.
#pragma once

#include <string>
#include <vector>

#include "airsim360/dataset/people/people_export.h"
#include "airsim360/dataset/record/spec.h"

namespace airsim360 {

/// Names of the files that ExportPoses makes; none if no view has intrinsics of COLMAP or there are no colour pictures.
/// Lenses that COLMAP has no model of are left out, of nerfstudio's files those that are not OPENCV or OPENCV_FISHEYE.
std::vector<std::string> PoseFileNames(const DatasetSpec& spec);

/// COLMAP's text model (cameras.txt, images.txt, an empty points3D.txt): poses map W to the camera, axes right, down,
/// forward, names are relative to rgb/. nerfstudio's transforms.json: poses map the camera to W, axes right, up, backward;
/// a rig that has fisheyes beside pinholes has those in transforms_fisheye.json, for a file has one camera model.
/// `frames_jsonl` holds the frames of this dataset.
std::vector<ExportedFile> ExportPoses(const std::string& frames_jsonl, const DatasetSpec& spec);

}  // namespace airsim360

// A scene as a binary glTF 2.0 file: meshes, instances, materials, textures, names and labels.
#pragma once

#include "airsim360/base/file.h"
#include "airsim360/scene/scene.h"

namespace airsim360 {

/// The scene as .glb, frame G (+Y up), metres. One node for each instance and entity in it, named after the
/// entity, in the order of entity ids; custom properties of nodes ("extras") hold `airsim360_entity`,
/// `airsim360_category` and `airsim360_tint`, those of materials what glTF has no word for. ImportScene reads
/// them back: the same geometry, bit for bit, names and categories. The sun is a directional light; the sky,
/// having no surface, is left out. Deterministic. InputError if the file would be larger than glTF's 4 GiB.
Bytes EncodeGlb(const Scene& scene);

}  // namespace airsim360

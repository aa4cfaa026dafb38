// Garments over skin: nothing of what lies under shows through, near or far.
#pragma once

#include <vector>

#include "piece.h"

namespace airsim360::bake {

/// Unit normals by vertex, smooth over uv seams.
std::vector<Vec3f> SmoothNormals(const Piece& piece);

/// Moves what lies under a garment inwards until the garment is `gap` metres outside of it, also where it
/// sticks out by up to 2 cm. What lies within 3 cm under one follows the garment's bones, so that it stays under in every
/// pose. What no garment covers stays as it is.
void TuckIn(std::vector<Piece>& pieces, float gap);

/// Drops triangles that nobody can see, at rest: from their corners and those of two rings around, all 48 ways out
/// end on another piece or the piece itself. Loose pieces neither hide nor go.
void DropHidden(std::vector<Piece>& pieces);

/// Takes the skin under the hair, the face excepted, out of `skin`; the result has its own vertices.
Piece TakeScalp(Piece& skin, const Piece& hair, Vec3f eyes, Vec3f head_top);

/// Cloth that hangs from the hips, as a skirt does: its front and back go over from one thigh to the other within
/// `band` metres, and nothing of it follows knees.
void HangFromHips(Piece& piece, float band);

/// Cloth that is taut around both legs: below `height` it does not go in between them, every level cut is convex.
void MakeTaut(Piece& piece, float height);

}  // namespace airsim360::bake

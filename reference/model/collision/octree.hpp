#pragma once

namespace lockstep {

/// The octree the thesis compares its image with (chapter 5), as far as both sides agree on it.
///
/// The root is a cube of side Constants::octree_size round the origin, divided octree_depth times whatever it holds,
/// so that there are 8^octree_depth leaves. A node holds a position when min <= position < max in every coordinate, a
/// magnitude of 2^-126 or less counting as 0; its eight children meet at (min + max) * 0.5F. What lies outside the
/// root, or is NaN, is in no leaf.
///
/// A leaf's entries are the particles of the frame's start in it, ascending, then the obstacles' vertices, ascending:
/// the thesis has its octree particles collide with meshes and does not say how. With obstacles_in_cdt = off they stay
/// out. A particle that searches looks at the entries of its own leaf, itself left out, and at no other leaf; nearest,
/// range and answer are the listing's (Fig. 3-3).
inline constexpr int octree_depth = 3;

} // namespace lockstep

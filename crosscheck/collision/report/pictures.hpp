#pragma once
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// A CDT as colours: x, y, z across the box of what it holds become red, green, blue; empty texels are dark.
/// Both sides of a check must be pictured with the same `box`.
ColorImage picture(const CollisionImage& cdt, const Box& box);

/// The box of the stored codes of all drawn, finite texels.
Box code_box(const CollisionImage& cdt);

/// Where two CDTs differ: grey equal, dark empty on both, red a differing value, yellow drawn on one side only.
ColorImage difference_picture(const CollisionImage& reference, const CollisionImage& gpu);

} // namespace lockstep

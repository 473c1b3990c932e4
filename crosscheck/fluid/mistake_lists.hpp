#pragma once
#include "crosscheck/fluid/mistake_words.hpp"
#include "reference/model/fluid/host.hpp"

namespace lockstep::fluid {

/// Of what is stored of a depth.
void add_depth_mistakes(Of of, const Host& host);
/// Of the rays through pixels.
void add_ray_mistakes(Of of, const Host& host);
/// The same, and of the points on them, which the last depth image has.
void add_point_mistakes(Of of, const Host& host);
void add_sphere_mistakes(Of of, const Host& host);
void add_thickness_mistakes(Of of, const Host& host);
void add_filter_mistakes(Of of, const Host& host);
void add_normal_mistakes(Of of, const Host& host);
void add_shading_mistakes(Of of, const Host& host);
void add_encoding_mistakes(Of of);

} // namespace lockstep::fluid

// GL discards a point whose centre lies outside the clip volume (4.5, 13.5). A driver with a guard band may let it
// pass, and NaN decides differently everywhere, so the rule is written out. At w = 0 (or subnormal, which drivers flush)
// and at infinity a point has no place on the image.
bool in_clip_volume(vec4 clip) {
#ifdef CLIP_DEPTH_FROM_ZERO // a host with glClipControl
    if (!(clip.z >= 0.0))
        return false;
#endif
    bool has_place = clip.w >= 1.17549435e-38 && clip.w <= 3.402823466e38;
    return has_place && abs(clip.x) <= clip.w && abs(clip.y) <= clip.w && abs(clip.z) <= clip.w;
}

// The position itself, or one outside every clip volume.
vec4 kept_position(vec4 clip) { return in_clip_volume(clip) ? clip : vec4(0.0, 0.0, 2.0, 1.0); }

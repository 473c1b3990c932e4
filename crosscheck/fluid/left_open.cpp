#include "crosscheck/fluid/left_open.hpp"

#include <fmt/format.h>

#include "reference/fluid/by_driver.hpp"

namespace lockstep::fluid {

namespace {

void add_filter(const Switches& on, const Profile& profile, std::vector<std::string>& lines) {
    if (linear_filter(profile) != LinearFilter::open)
        return;
    const auto open = [&lines](const char* value, const char* portable) {
        lines.push_back(fmt::format("{}: this driver is not followed in it (probe: {}), so legal is what places and "
                                    "weights of 8 fraction bits give; {} promises bits",
                                    value, plane_filter_row, portable));
    };
    if (on.depth_fetch == DepthFetch::linear)
        open("depth_fetch=linear", "depth_fetch=texel");
    if (on.scene_fetch == SceneFetch::linear)
        open("scene_fetch=linear", "scene_fetch=bilinear");
}

void add_points(const Profile& profile, std::vector<std::string>& lines) {
    constexpr const char* portable = "sprite=quad promises bits";
    if (!profile.follows(dropped_outside_row))
        lines.push_back(
            !profile.follows(drawn_beside_row)
                ? fmt::format("sprite=points: this driver departs from GL 4.5, 13.5, which drops a point whose middle "
                              "lies outside the view volume (probe: {}), and is not followed in it, so each such point "
                              "may be drawn or not; {}",
                              dropped_outside_row, portable)
                : fmt::format("sprite=points: this driver departs from GL 4.5, 13.5, which drops a point whose middle "
                              "lies outside the view volume: it draws one whose middle lies beside the image (probe: "
                              "{}), and so do the twins; {}",
                              drawn_beside_row, portable));
    if (!profile.follows(point_coord_row) && !profile.follows(cut_point_coord_row))
        lines.push_back(fmt::format("sprite=points: this driver is not followed in gl_PointCoord (probe: {}), so legal "
                                    "is what a middle right to 2/256 pixel and sizes in steps of 1/8 give; {}",
                                    point_coord_row, portable));
}

} // namespace

std::vector<std::string> left_open(const Switches& on, const Profile& profile) {
    std::vector<std::string> lines;
    add_filter(on, profile, lines);
    if (on.sprite == Sprite::points)
        add_points(profile, lines);
    return lines;
}

} // namespace lockstep::fluid

#include "crosscheck/dust/drawing_mistakes.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "crosscheck/dust/mistake_words.hpp"
#include "reference/dust/sites.hpp"

namespace lockstep::dust {
namespace {

using Axes = std::array<const Site*, 3>;

/// The corner turned by other axes, or from another place in the mesh.
template <const Site& x, const Site& y, const Site& right, const Site& up>
void turned_by(std::span<float> value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = (run.of(right)[c] * run.of(x)[0] + run.of(up)[c] * run.of(y)[0]) +
                   run.of(site::back)[c] * run.of(site::corner_z)[0];
}

void not_turned(std::span<float> value, const CameBy& run) {
    value[0] = run.of(site::corner_x)[0];
    value[1] = run.of(site::corner_y)[0];
    value[2] = run.of(site::corner_z)[0];
}

/// The axes for the columns of a matrix, where they are its rows.
void turned_back(std::span<float> value, const CameBy& run) {
    const Axes axes{&site::right, &site::up, &site::back};
    const Axes place{&site::corner_x, &site::corner_y, &site::corner_z};
    for (std::size_t c = 0; c < value.size(); ++c) {
        value[c] = 0.0F;
        for (std::size_t axis = 0; axis < axes.size(); ++axis)
            value[c] += run.of(*axes[c])[axis] * run.of(*place[axis])[0];
    }
}

void scaled_with_place(std::span<float> value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = (run.of(site::turned)[c] + run.of(site::before)[c]) * run.of(site::scale)[0];
}

void by_its_w(std::span<float> value, const CameBy& /*run*/) {
    for (float& x : value)
        x /= value[3];
}

void red_is_blue(std::span<float> value, const CameBy& run) {
    const auto& colour = run.of(site::colour_before);
    value[0] = colour[2];
    value[2] = colour[0];
}

template <std::size_t axis> void from_the_other_end(std::span<float> value, const CameBy& /*run*/) {
    value[axis] = 1.0F - value[axis];
}

void of_the_mesh(std::span<float> value, const CameBy& /*run*/) {
    value[0] -= 0.5F;
    value[1] -= 0.5F;
}

void negated_places(std::span<float> value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = run.of(site::turned)[c] * run.of(site::scale)[0] - run.of(site::before)[c];
}

} // namespace

const std::vector<NamedMistake>& drawing_mistakes() {
    using site::corner_x, site::corner_y, site::right, site::up;
    const std::string draw = "draw";
    static const Mistake place_swapped = mistake_at(site::texel_place, Change::swapped);
    static const std::vector<NamedMistake> all{
        {"scale_missing", "grains are as large as their mesh", draw, mistake_at(site::scale, Change::one)},
        {"grains_twice_as_large", "the scale is taken for half of a side", draw,
         mistake_at(site::scale, Change::doubled)},
        {"grains_half_as_large", "the scale is halved", draw, mistake_at(site::scale, Change::halved)},
        {"place_missing", "all grains are drawn at the origin", draw, mistake_at(site::before, Change::zero)},
        free_formula("place_subtracted", "a grain's place is taken away from its corners, not added", draw,
                     spoiled_at(site::world_corner, negated_places)),
        free_formula("place_scaled", "a grain's place is scaled as its corners are", draw,
                     spoiled_at(site::world_corner, scaled_with_place)),
        {"not_turned", "quads lie in the world's plane of x and y, wherever the camera is", draw,
         spoiled_at(site::turned, not_turned)},
        free_formula("turned_back", "the camera's axes are a matrix's rows, not its columns", draw,
                     spoiled_at(site::turned, turned_back)),
        {"axes_swapped", "the camera's right is taken for its up, and its up for its right", draw,
         formula_at(site::turned, turned_by<corner_x, corner_y, up, right>)},
        {"right_twice", "corners go along the camera's right in both directions", draw,
         formula_at(site::turned, turned_by<corner_x, corner_y, right, right>)},
        {"up_twice", "corners go along the camera's up in both directions", draw,
         formula_at(site::turned, turned_by<corner_x, corner_y, up, up>)},
        {"x_for_both", "a corner's x stands for its y as well", draw,
         formula_at(site::turned, turned_by<corner_x, corner_x, right, up>)},
        {"y_for_both", "a corner's y stands for its x as well", draw,
         formula_at(site::turned, turned_by<corner_y, corner_y, right, up>)},
        {"corners_swapped", "a corner's x is its y, and its y its x", draw,
         with(formula_at(site::turned, turned_by<corner_y, corner_x, right, up>), place_swapped)},
        {"mirrored", "a corner's x has the other sign", draw, mistake_at(corner_x, Change::negated)},
        {"upside_down", "a corner's y has the other sign", draw, mistake_at(corner_y, Change::negated)},
        {"right_reversed", "the camera's right is its left", draw, mistake_at(right, Change::negated)},
        {"up_reversed", "the camera's up is its down", draw, mistake_at(up, Change::negated)},
        {"matrix_transposed", "the matrix to clip space is transposed", draw,
         mistake_at(site::view_projection, Change::transposed)},
        free_formula("divided_by_w", "the stage divides by w, which GL does later", draw,
                     spoiled_at(site::clip, by_its_w)),
        {"red_is_blue", "red and blue are swapped", draw, spoiled_at(site::tint, red_is_blue)},
        {"dead_drawn", "the dead are drawn", draw, mistake_at(site::drawn, Change::one)},
        {"dead_alone_drawn", "the dead are drawn, and the living are not", draw,
         mistake_at(site::drawn, Change::opposite)},
        {"nothing_drawn", "no grain is drawn", draw, mistake_at(site::drawn, Change::zero)},
        {"texture_swapped", "a texture's x and y are swapped", draw, place_swapped},
        {"texture_mirrored", "a texture's left is its right", draw,
         spoiled_at(site::texel_place, from_the_other_end<0>)},
        {"texture_upside_down", "a texture's top is its bottom", draw,
         spoiled_at(site::texel_place, from_the_other_end<1>)},
        {"texture_not_moved", "a texture's places are those of the mesh, from -0.5 to 0.5", draw,
         spoiled_at(site::texel_place, of_the_mesh)},
    };
    return all;
}

} // namespace lockstep::dust

#include "reference/collision/formulas/words.hpp"

#include <utility>

#include <glm/common.hpp>

#include "reference/half.hpp"

namespace lockstep::formulas {

namespace {

constexpr std::array tiles{4.0F, 8.0F, 16.0F, 32.0F, 64.0F};
constexpr std::array stored_steps{15.0F,   16.0F,   127.0F,  128.0F,  255.0F,  256.0F,
                                  1000.0F, 1023.0F, 1024.0F, 4096.0F, 65535.0F};

} // namespace

void add_fetches(std::vector<FormulaMistake>& all) {
    all.push_back(
        {"radius_is_one", "1 for u_TexelCollideRange", {.site = site::texel_collide_range.id, .change = Change::one}});
    all.push_back(
        {"radius_halved", "u_TexelCollideRange / 2", {.site = site::texel_collide_range.id, .change = Change::halved}});
    all.push_back({"radius_doubled",
                   "2 * u_TexelCollideRange",
                   {.site = site::texel_collide_range.id, .change = Change::doubled}});
    all.push_back(
        {"range_doubled", "2 * u_CollisionRange", {.site = site::collision_range.id, .change = Change::doubled}});
    all.push_back(
        {"range_halved", "u_CollisionRange / 2", {.site = site::collision_range.id, .change = Change::halved}});
    all.push_back({"border_never_read", "the image's outermost texels are never read", fetch([](Floats v, Run) {
                       if (v[0] < 1.0F || v[1] < 1.0F || v[0] > v[2] - 2.0F || v[1] > v[3] - 2.0F)
                           leave_out(v);
                   })});
    all.push_back({"last_column_never_read", "the image's last column is never read", fetch([](Floats v, Run) {
                       if (v[0] > v[2] - 2.0F)
                           leave_out(v);
                   })});
    all.push_back({"last_row_never_read", "the image's last row is never read", fetch([](Floats v, Run) {
                       if (v[1] > v[3] - 2.0F)
                           leave_out(v);
                   })});
    all.push_back({"first_column_never_read", "the image's first column is never read", fetch([](Floats v, Run) {
                       if (v[0] < 1.0F)
                           leave_out(v);
                   })});
    all.push_back({"first_row_never_read", "the image's first row is never read", fetch([](Floats v, Run) {
                       if (v[1] < 1.0F)
                           leave_out(v);
                   })});
    all.push_back({"last_texels_never_read", "the image's last row and column are never read", fetch([](Floats v, Run) {
                       if (v[0] > v[2] - 2.0F || v[1] > v[3] - 2.0F)
                           leave_out(v);
                   })});
    all.push_back(
        {"first_texels_never_read", "the image's first row and column are never read", fetch([](Floats v, Run) {
             if (v[0] < 1.0F || v[1] < 1.0F)
                 leave_out(v);
         })});
    all.push_back({"outside_mirrored", "texels outside are mirrored at the border", fetch([](Floats v, Run) {
                       for (std::size_t c = 0; c < 2; ++c)
                           v[c] = v[c] < 0.0F ? -v[c] - 1.0F : v[c] >= v[2 + c] ? 2.0F * v[2 + c] - 1.0F - v[c] : v[c];
                   })});
    all.push_back(
        {"outside_mirrored_without_edge", "texels outside are mirrored at the edge texels", fetch([](Floats v, Run) {
             for (std::size_t c = 0; c < 2; ++c)
                 v[c] = v[c] < 0.0F ? -v[c] : v[c] >= v[2 + c] ? 2.0F * v[2 + c] - 2.0F - v[c] : v[c];
         })});
    all.push_back({"bounds_of_width_alone", "a texel's y is held against the width", fetch([](Floats v, Run) {
                       if (v[1] >= v[2])
                           leave_out(v);
                   })});
    all.push_back({"bounds_of_height_alone", "a texel's x is held against the height", fetch([](Floats v, Run) {
                       if (v[0] >= v[3])
                           leave_out(v);
                   })});
    all.push_back(
        {"bounds_swapped", "a texel's x is held against the height, its y against the width", fetch([](Floats v, Run) {
             if (v[0] >= v[3] || v[1] >= v[2])
                 leave_out(v);
         })});
    all.push_back({"fetched_x_and_y_swapped", "the texel read has x and y swapped",
                   fetch([](Floats v, Run) { std::swap(v[0], v[1]); })});
    all.push_back({"fetched_upside_down", "the texel read is size.y - 1 - y",
                   fetch([](Floats v, Run) { v[1] = v[3] - 1.0F - v[1]; })});
    all.push_back(
        {"offsets_doubled", "the texel read is twice as far from the base texel", fetch([](Floats v, Run run) {
             const auto& base = run.of(site::base_texel);
             for (std::size_t c = 0; c < 2; ++c)
                 v[c] = 2.0F * v[c] - base[c];
         })});
    all.push_back({"offsets_halved", "the texel read is half as far from the base texel", fetch([](Floats v, Run run) {
                       const auto& base = run.of(site::base_texel);
                       for (std::size_t c = 0; c < 2; ++c)
                           v[c] = base[c] + std::trunc((v[c] - base[c]) / 2.0F);
                   })});
    all.push_back({"rows_read_base_row", "every row reads the base texel's row",
                   fetch([](Floats v, Run run) { v[1] = run.of(site::base_texel)[1]; })});
    all.push_back({"columns_read_base_column", "every column reads the base texel's column",
                   fetch([](Floats v, Run run) { v[0] = run.of(site::base_texel)[0]; })});
    all.push_back({"base_texel_read_for_all", "the base texel is read for every one", fetch([](Floats v, Run run) {
                       const auto& base = run.of(site::base_texel);
                       v[0] = base[0], v[1] = base[1];
                   })});
    all.push_back({"offsets_swapped", "the texel read is base + (ty, tx)", fetch([](Floats v, Run run) {
                       const auto& base = run.of(site::base_texel);
                       const float x = v[0] - base[0], y = v[1] - base[1];
                       v[0] = base[0] + y, v[1] = base[1] + x;
                   })});
    all.push_back({"offsets_subtracted", "the texel read is base - (tx, ty)", fetch([](Floats v, Run run) {
                       const auto& base = run.of(site::base_texel);
                       for (std::size_t c = 0; c < 2; ++c)
                           v[c] = 2.0F * base[c] - v[c];
                   })});
    all.push_back(
        {"texel_after_read", "the texel read is one further right", fetch([](Floats v, Run) { v[0] += 1.0F; })});
    all.push_back(
        {"texel_before_read", "the texel read is one further left", fetch([](Floats v, Run) { v[0] -= 1.0F; })});
    all.push_back({"texel_above_read", "the texel read is one higher", fetch([](Floats v, Run) { v[1] += 1.0F; })});
    all.push_back({"texel_below_read", "the texel read is one lower", fetch([](Floats v, Run) { v[1] -= 1.0F; })});
    all.push_back({"beyond_tile_skipped", "texels beyond the base texel's tile of an image are skipped",
                   fetch([](Floats v, Run run) {
                       const auto& base = run.of(site::base_texel);
                       for (std::size_t c = 0; c < 2; ++c)
                           if (std::floor(v[c] / run.constants[0]) != std::floor(base[c] / run.constants[0]))
                               return leave_out(v);
                   }),
                   tiles});
    all.push_back({"fetched_upside_down_from_height", "the texel read is size.y - y",
                   fetch([](Floats v, Run) { v[1] = v[3] - v[1]; })});
    all.push_back({"fetched_mirrored", "the texel read is size.x - 1 - x",
                   fetch([](Floats v, Run) { v[0] = v[2] - 1.0F - v[0]; })});
    all.push_back(
        {"first_texel_of_row_for_all", "every column reads the row's first texel", fetch([](Floats v, Run run) {
             if (v[0] >= 0.0F && v[0] < v[2])
                 v[0] = std::clamp(run.of(site::base_texel)[0] - static_cast<float>(reach(run)), 0.0F, v[2] - 1.0F);
         })});
    all.push_back(
        {"corner_sampled", "a texel is sampled at its corner, x / width, not at its centre", fetch([](Floats v, Run) {
             for (std::size_t c = 0; c < 2; ++c)
                 if (v[c] >= 0.0F && v[c] < v[2 + c])
                     v[c] = std::floor(v[c] / v[2 + c] * v[2 + c]);
         })});
    all.push_back({"origin_is_empty", "a texel is empty where its position is the origin", holds([](Floats v, Run run) {
                       const auto& texel = run.of(site::neighbour);
                       v[0] = texel[0] != 0.0F || texel[1] != 0.0F || texel[2] != 0.0F ? 1.0F : 0.0F;
                   })});
    const auto holds_where = [&](std::string_view name, std::string_view meaning, Formula formula) {
        all.push_back({name, meaning, holds(formula)});
    };
    static const auto read = [](Run run) { return vec3(run, site::neighbour); };
    holds_where("positive_sum_is_valid", "a texel holds a particle where x + y + z is above 0", [](Floats v, Run run) {
        const glm::vec3 p = read(run);
        v[0] = p.x + p.y + p.z > 0.0F ? 1.0F : 0.0F;
    });
    holds_where("zero_sum_is_empty", "a texel is empty where x + y + z is 0", [](Floats v, Run run) {
        const glm::vec3 p = read(run);
        v[0] = p.x + p.y + p.z != 0.0F ? 1.0F : 0.0F;
    });
    holds_where("all_positive_is_valid", "a texel holds a particle where x, y and z are above 0",
                [](Floats v, Run run) {
                    const glm::vec3 p = read(run);
                    v[0] = p.x > 0.0F && p.y > 0.0F && p.z > 0.0F ? 1.0F : 0.0F;
                });
    holds_where("any_positive_is_valid", "a texel holds a particle where x, y or z is above 0", [](Floats v, Run run) {
        const glm::vec3 p = read(run);
        v[0] = p.x > 0.0F || p.y > 0.0F || p.z > 0.0F ? 1.0F : 0.0F;
    });
    const auto reads = [&](std::string_view name, std::string_view meaning, Formula formula,
                           std::span<const float> constants = {}) {
        all.push_back({name, meaning, value(site::stored_position, formula), constants});
    };
    reads("stored_unpacked_as_normal", "2 * stored - 1 for the stored position",
          [](Floats v, Run) { set(v, 2.0F * get(v) - 1.0F); });
    reads("stored_packed_as_normal", "0.5 * stored + 0.5 for the stored position",
          [](Floats v, Run) { set(v, 0.5F * get(v) + 0.5F); });
    reads("stored_read_in_half_floats", "the stored position is read in half floats", [](Floats v, Run) {
        set(v, {half_round(v[0]), half_round(v[1]), half_round(v[2])});
    });
    reads(
        "stored_read_in_steps", "the stored position is read in steps of 1 / a constant",
        [](Floats v, Run run) { set(v, glm::round(get(v) * run.constants[0]) / run.constants[0]); }, stored_steps);
    reads(
        "stored_read_in_whole_steps", "the stored position is rounded down to steps of 1 / a constant",
        [](Floats v, Run run) { set(v, glm::floor(get(v) * run.constants[0]) / run.constants[0]); }, stored_steps);
    reads("stored_in_clip_space", "the stored position is taken to clip space, and the own is not",
          [](Floats v, Run run) { set(v, glm::vec3(projected(run, get(v)))); });
    reads("stored_size_taken", "the stored position's components without their signs",
          [](Floats v, Run) { set(v, glm::abs(get(v))); });
    all.push_back({"zero_x_is_empty", "a texel is empty where its x is 0",
                   holds([](Floats v, Run run) { v[0] = run.of(site::neighbour)[0] != 0.0F ? 1.0F : 0.0F; })});
    all.push_back({"zero_y_is_empty", "a texel is empty where its y is 0",
                   holds([](Floats v, Run run) { v[0] = run.of(site::neighbour)[1] != 0.0F ? 1.0F : 0.0F; })});
    all.push_back({"zero_z_is_empty", "a texel is empty where its z is 0",
                   holds([](Floats v, Run run) { v[0] = run.of(site::neighbour)[2] != 0.0F ? 1.0F : 0.0F; })});
    all.push_back({"any_zero_is_empty", "a texel is empty where x, y or z is 0", holds([](Floats v, Run run) {
                       const auto& texel = run.of(site::neighbour);
                       v[0] = texel[0] != 0.0F && texel[1] != 0.0F && texel[2] != 0.0F ? 1.0F : 0.0F;
                   })});
    all.push_back({"positive_x_is_valid", "a texel holds a particle where its x is above 0",
                   holds([](Floats v, Run run) { v[0] = run.of(site::neighbour)[0] > 0.0F ? 1.0F : 0.0F; })});
    all.push_back({"positive_y_is_valid", "a texel holds a particle where its y is above 0",
                   holds([](Floats v, Run run) { v[0] = run.of(site::neighbour)[1] > 0.0F ? 1.0F : 0.0F; })});
    all.push_back({"positive_z_is_valid", "a texel holds a particle where its z is above 0",
                   holds([](Floats v, Run run) { v[0] = run.of(site::neighbour)[2] > 0.0F ? 1.0F : 0.0F; })});
}

} // namespace lockstep::formulas

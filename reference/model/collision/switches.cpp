#include "reference/model/collision/switches.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

using Names = std::string_view;
constexpr std::array<Names, 3> search{"cdt", "octree", "depth"};
constexpr std::array<Names, 2> step{"transform_feedback", "compute"};
constexpr std::array<Names, 2> off_on{"off", "on"};
constexpr std::array<Names, 1> times_half{"times_half"};
constexpr std::array<Names, 2> base_texel{"truncate", "floor"};
constexpr std::array<Names, 2> self_position{"texel", "vertex"};
constexpr std::array<Names, 2> empty_texel{"phantom", "skip"};
constexpr std::array<Names, 1> outside_image{"skip"};
constexpr std::array<Names, 2> zero_distance{"hit", "skip"};
constexpr std::array<Names, 2> collision_step{"full", "tick"};
constexpr std::array<Names, 1> search_when{"collide_time_negative"};
constexpr std::array<Names, 2> not_searching{"moves", "stands"};
constexpr std::array<Names, 3> cdt_format{"rgba32f", "rgba16f", "rgba8"};
constexpr std::array<Names, 2> cdt_camera{"moving", "fixed"};
constexpr std::array<Names, 3> obstacles_in_cdt{"off", "vertices", "triangles"};
constexpr std::array<Names, 2> velocity{"direction_and_speed", "vector"};
constexpr std::array<Names, 2> raster_position{"before_step", "updated"};
constexpr std::array<Names, 2> arithmetic{"plain", "exact"};
constexpr std::array<Names, 8> one_to_eight{"1", "2", "3", "4", "5", "6", "7", "8"};
constexpr std::array<Names, 2> search_window{"texels", "projected"};
constexpr std::array<Names, 2> response{"single", "mutual"};

constexpr std::array<Names, 4> presets{"listing", "paper", "corrected", "exact"};

template <auto Member> SwitchInfo named(Names name, std::span<const Names> values, Names meaning) {
    return {name,
            values,
            meaning,
            [](const Switches& s) { return static_cast<int>(s.*Member); },
            [](Switches& s, int index) { s.*Member = static_cast<std::decay_t<decltype(s.*Member)>>(index); },
            nullptr};
}

/// A count from 1 on.
template <auto Member> SwitchInfo count(Names name, std::span<const Names> values, Names meaning) {
    return {name,
            values,
            meaning,
            [](const Switches& s) { return s.*Member - 1; },
            [](Switches& s, int index) { s.*Member = index + 1; },
            nullptr};
}

SwitchInfo number(Names name, float Switches::*member, Names meaning) {
    return {name, {}, meaning, nullptr, nullptr, member};
}

const SwitchInfo& find(std::string_view name) {
    const auto table = switch_table();
    const auto found = std::find_if(table.begin(), table.end(), [&](const SwitchInfo& s) { return s.name == name; });
    if (found == table.end()) {
        std::string names;
        for (const SwitchInfo& info : table)
            names += fmt::format("{}{}", names.empty() ? "" : ", ", info.name);
        throw Error(fmt::format("unknown switch '{}'; the switches are {}", name, names));
    }
    return *found;
}

} // namespace

std::span<const SwitchInfo> switch_table() {
    using S = Switches;
    static const std::array table{
        named<&S::perspective_divide>("perspective_divide", off_on,
                                      "divide clip x, y by w before the texture coordinate"),
        named<&S::texcoord>("texcoord", times_half, "(ndc + 1) times 0.5"),
        named<&S::base_texel>("base_texel", base_texel, "float to texel: toward zero, or to the texel it lies in"),
        named<&S::self_position>("self_position", self_position,
                                 "own position from the base texel, or from the vertex"),
        named<&S::empty_texel>("empty_texel", empty_texel,
                               "a cleared texel is a particle at the origin, or no particle"),
        named<&S::outside_image>("outside_image", outside_image, "texels outside the image are never fetched"),
        named<&S::zero_distance>("zero_distance", zero_distance, "a neighbour at distance 0 is a hit, or is skipped"),
        named<&S::collision_step>("collision_step", collision_step,
                                  "a hit moves by direction * speed, or by that * tick"),
        named<&S::search_when>("search_when", search_when, "a particle searches while its collide time is negative"),
        named<&S::not_searching>("not_searching", not_searching,
                                 "a particle that does not search moves and counts down, or keeps its state"),
        named<&S::cdt_format>("cdt_format", cdt_format, "what a texel of the CDT stores"),
        named<&S::cdt_camera>("cdt_camera", cdt_camera,
                              "the collision camera follows the render camera, or stands still"),
        named<&S::obstacles_in_cdt>("obstacles_in_cdt", obstacles_in_cdt, "how obstacles are drawn into the CDT"),
        named<&S::velocity>("velocity", velocity, "a particle holds direction and speed, or one vector and speed 1"),
        named<&S::raster_position>("raster_position", raster_position,
                                   "the point is drawn where the particle was, or is now"),
        named<&S::arithmetic>("arithmetic", arithmetic, "GLSL's own functions, or portable.glsl"),
        named<&S::search>("search", search,
                          "hits are looked for in the CDT, in an octree (thesis, chapter 5), or in obstacles' depth"),
        named<&S::step>("step", step, "the listing's step is made by vertex and fragment stages, or by compute stages"),
        count<&S::cdt_layers>("cdt_layers", one_to_eight, "particles a texel of the CDT holds, nearest first"),
        count<&S::cdt_cameras>("cdt_cameras", std::span(one_to_eight).first(2),
                               "collision cameras; the second stands at a right angle to the first"),
        named<&S::search_window>("search_window", search_window,
                                 "texel_collide_range each way, or of these what the collision range projects to"),
        named<&S::response>("response", response,
                            "a particle answers its nearest by itself, or both of a pair do, by momentum"),
        number("speed_factor", &S::speed_factor, "factor on the speed at a hit"),
        number("cdt_camera_offset", &S::cdt_camera_offset, "z offset of a moving collision camera, world units"),
    };
    return table;
}

bool places_points(const Switches& switches) {
    return switches.arithmetic == ArithmeticSwitch::exact || switches.step == Step::compute;
}

std::span<const std::string_view> preset_names() { return presets; }

Switches preset(std::string_view name) {
    Switches switches;
    if (name == "corrected")
        return switches;
    if (name == "exact") {
        switches.arithmetic = ArithmeticSwitch::exact;
        return switches;
    }
    if (name == "paper" || name == "listing") {
        switches.base_texel = BaseTexel::truncate;
        switches.self_position = SelfPosition::texel;
        switches.empty_texel = EmptyTexel::phantom;
        switches.zero_distance = ZeroDistance::hit;
        switches.collision_step = CollisionStep::full;
        switches.speed_factor = 0.2F;
        if (name == "paper")
            return switches;
        switches.perspective_divide = PerspectiveDivide::off;
        switches.raster_position = RasterPosition::before_step;
        switches.not_searching = NotSearching::stands;
        return switches;
    }
    throw Error(fmt::format("unknown preset '{}'; the presets are {}{}", name, fmt::join(presets, ", "),
                            did_you_mean(name, {presets.begin(), presets.end()})));
}

void set_switch(Switches& switches, std::string_view name, std::string_view value) {
    const SwitchInfo& info = find(name);
    if (info.number != nullptr) {
        float parsed = 0.0F;
        const auto [end, status] = std::from_chars(value.data(), value.data() + value.size(), parsed);
        if (status == std::errc::result_out_of_range)
            throw Error(fmt::format("switch {}: '{}' is beyond what a float holds, 1.2e-38 to 3.4e38", name, value));
        if (status != std::errc{} || end != value.data() + value.size() || !std::isfinite(parsed))
            throw Error(fmt::format("switch {}: '{}' is not a finite number", name, value));
        switches.*info.number = parsed;
        return;
    }
    const auto found = std::find(info.values.begin(), info.values.end(), value);
    if (found == info.values.end())
        throw Error(fmt::format("switch {}: '{}' is not one of {}", name, value, fmt::join(info.values, ", ")));
    info.set(switches, static_cast<int>(found - info.values.begin()));
}

std::string switch_value(const Switches& switches, std::string_view name) {
    const SwitchInfo& info = find(name);
    if (info.number != nullptr)
        return fmt::format("{}", switches.*info.number);
    return std::string(info.values[static_cast<std::size_t>(info.get(switches))]);
}

} // namespace lockstep

#include "reference/model/lifecycle/schema.hpp"

#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "reference/model/lifecycle/layout.hpp"

namespace lockstep::lifecycle {
namespace {

using Code = Packed::Code;
using Fields = std::vector<Field>;

Field word(std::string name, std::vector<Packed> packed) {
    return {.name = std::move(name), .scalar = Scalar::uint32, .unit = {}, .packed = std::move(packed)};
}

Field halves(std::string name, std::string high, std::string low, Code high_code = Code::half,
             Code low_code = Code::half) {
    return word(std::move(name), {{std::move(high), 16, 16, high_code}, {std::move(low), 0, 16, low_code}});
}

Field colors(std::string name, ColorCode code) {
    if (code == ColorCode::rgba8)
        return word(
            std::move(name),
            {{"r", 0, 8, Code::unorm}, {"g", 8, 8, Code::unorm}, {"b", 16, 8, Code::unorm}, {"a", 24, 8, Code::unorm}});
    return word(
        std::move(name),
        {{"r", 0, 10, Code::unorm}, {"g", 10, 10, Code::unorm}, {"b", 20, 10, Code::unorm}, {"a", 30, 2, Code::unorm}});
}

Field pads(int words) { return {.name = "pad", .scalar = Scalar::uint32, .components = words}; }

Fields largest() {
    return {{.name = "position", .components = 3},
            {.name = "initial_size"},
            {.name = "velocity", .components = 3, .unit = "1/s"},
            {.name = "initial_lifetime", .unit = "s"},
            {.name = "acceleration", .components = 3, .unit = "1/s2"},
            {.name = "initial_opacity"},
            {.name = "initial_color", .components = 3},
            {.name = "remain_lifetime", .unit = "s"},
            {.name = "end_color", .components = 3},
            {.name = "end_size"},
            {.name = "end_opacity"},
            {.name = "spawn_time", .unit = "s"},
            {.name = "spawn_order_in_frame", .scalar = Scalar::uint32},
            {.name = "distance_from_previous"},
            {.name = "distance_from_start"},
            pads(3)};
}

/// All words of a particle, in order.
Fields particle_fields(const Switches& s) {
    if (s.layout == Layout::bytes_112)
        return largest();
    const LayoutPlan& plan = plan_of(s.layout);
    Fields all;
    if (plan.floats) {
        all = {{.name = "position", .components = 3},
               {.name = "velocity", .components = 3, .unit = "1/s"},
               {.name = "initial_lifetime", .unit = "s"},
               {.name = "remain_lifetime", .unit = "s"},
               {.name = "acceleration", .components = 3, .unit = "1/s2"},
               {.name = "spawn_time", .unit = "s"}};
    } else {
        const Code time = s.time_code == TimeCode::ticks16 ? Code::uint : Code::half;
        const Code place = s.position_code == PositionCode::box16 ? Code::uint : Code::half;
        all = {halves("position_xy", "position.x", "position.y", place, place),
               halves("position_z_velocity_x", "position.z", "velocity.x", place),
               halves("velocity_yz", "velocity.y", "velocity.z"),
               halves("lifetimes", "initial", "remaining", time, time),
               halves("acceleration_xy", "acceleration.x", "acceleration.y"),
               halves("acceleration_z_spawn", "acceleration.z", "spawn_time", Code::half, time)};
    }
    if (plan.half_sizes) {
        all.push_back(halves("sizes", "initial", "end"));
    } else {
        all.push_back({.name = "initial_size"});
        all.push_back({.name = "end_size"});
    }
    if (plan.half_lengths) {
        all.push_back(halves("distances", "from_previous", "from_start"));
    } else {
        all.push_back({.name = "distance_from_previous"});
        all.push_back({.name = "distance_from_start"});
    }
    all.push_back(colors("initial_color", s.color_code));
    all.push_back(colors("end_color", s.color_code));
    std::size_t words = 0;
    for (const Field& field : all)
        words += static_cast<std::size_t>(field.components);
    if (words < plan.words)
        all.push_back(pads(static_cast<int>(plan.words - words)));
    return all;
}

Fields in_block(const std::string& block, std::vector<std::pair<std::string, int>> names) {
    Fields all;
    for (auto& [name, components] : names)
        all.push_back({.name = std::move(name), .scalar = Scalar::uint32, .components = components, .block = block});
    return all;
}

/// Sums of distances, along a ribbon and of blocks.
Fields lengths(const std::string& block, std::string name, DistanceSum how) {
    return {{.name = std::move(name),
             .scalar = how == DistanceSum::fixed ? Scalar::uint32 : Scalar::float32,
             .block = block}};
}

Schema made(const Switches& s) {
    Schema all{
        "lifecycle",
        {{.name = "particles", .item = "particle", .title = "the particles", .fields = particle_fields(s)},
         {.name = "counters",
          .item = "emitter",
          .title = "the counters",
          .fields = in_block("Counters", {{"alive", 1},
                                          {"emitted", 1},
                                          {"may_die", 1},
                                          {"survivors", 1},
                                          {"append", 1},
                                          {"died", 1},
                                          {"serial", 1},
                                          {"dropped", 1},
                                          {"dropped_total", 1},
                                          {"young", 1},
                                          {"ring_head", 1},
                                          {"distance_origin", 1},
                                          {"clamped", 1},
                                          {"killed", 1},
                                          {"spare", 2}})},
         {.name = "survivors",
          .item = "survivor",
          .title = "the survivors",
          .fields = in_block("Survivors", {{"survivor", 1}})},
         {.name = "scan_sums",
          .item = "sum",
          .title = "the sums of blocks",
          .fields = in_block("ScanSums", {{"sum", 1}})},
         {.name = "ring", .item = "count", .title = "the emission ring", .fields = in_block("Ring", {{"emission", 1}})},
         {.name = "arguments",
          .item = "call",
          .title = "the arguments",
          .fields = in_block(
              "Arguments",
              {{"destroy", 3}, {"move", 3}, {"simulate", 3}, {"ribbon", 3}, {"draw_sprite", 4}, {"draw_ribbon", 4}})},
         {.name = "distances",
          .item = "distance",
          .title = "the distances",
          .fields = lengths("Distances", "distance", s.distance_sum)},
         {.name = "length_sums",
          .item = "length",
          .title = "the lengths of blocks",
          .fields = lengths("LengthSums", "length", s.distance_sum)},
         {.name = "points",
          .item = "point",
          .title = "the ribbons' points",
          .fields = {{.name = "left", .components = 3, .block = "Points"},
                     {.name = "right", .components = 3, .block = "Points"},
                     {.name = "u", .components = 2, .block = "Points"}}}}};
    if (s.management == Management::index_lists) {
        std::vector<Field>& counters = all.resources[counter_buffer].fields;
        counters.pop_back();
        for (Field& field : in_block("Counters", {{"buried", 1}, {"list", 1}}))
            counters.push_back(std::move(field));
        all.resources.push_back(
            {.name = "dead", .item = "slot", .title = "the dead", .fields = in_block("Dead", {{"slot", 1}})});
        all.resources.push_back({.name = "keys",
                                 .item = "key",
                                 .title = "the keys of the points",
                                 .fields = in_block("Keys", {{"time", 1}, {"order", 1}, {"of", 1}})});
    }
    return checked(std::move(all));
}

} // namespace

const Schema& schema(const Switches& s) {
    static std::map<std::tuple<Layout, TimeCode, PositionCode, ColorCode, DistanceSum, Management>, Schema> all;
    const std::tuple key(s.layout, s.time_code, s.position_code, s.color_code, s.distance_sum, s.management);
    const auto known = all.find(key);
    return known != all.end() ? known->second : all.emplace(key, made(s)).first->second;
}

} // namespace lockstep::lifecycle

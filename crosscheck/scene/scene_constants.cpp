#include "crosscheck/scene/scene_constants.hpp"

#include <array>

namespace lockstep {
namespace {

struct ConstantInfo {
    std::string_view name;
    void (*set)(Constants&, const JsonValue&);
    nlohmann::json (*get)(const Constants&);
};

constexpr NumberRule octree_size{1e-6, 1e6, "a length from 1e-6 to 1e6"};

template <auto Member, const NumberRule& Rule> ConstantInfo real(std::string_view name) {
    return {name, [](Constants& c, const JsonValue& value) { c.*Member = value.number(Rule); },
            [](const Constants& c) { return nlohmann::json(c.*Member); }};
}

const std::array table{
    real<&Constants::tick, number::positive>("tick"),
    ConstantInfo{"gravity", [](Constants& c, const JsonValue& value) { c.gravity = value.vector(); },
                 [](const Constants& c) {
                     return nlohmann::json{c.gravity.x, c.gravity.y, c.gravity.z};
                 }},
    real<&Constants::collision_range, number::positive>("collision_range"),
    real<&Constants::collision_time, number::not_negative>("collision_time"),
    ConstantInfo{"texel_collide_range",
                 [](Constants& c, const JsonValue& value) {
                     c.texel_collide_range = static_cast<int>(value.integer(0, widest_neighbourhood));
                 },
                 [](const Constants& c) { return nlohmann::json(c.texel_collide_range); }},
    real<&Constants::billboard_radius, number::positive>("billboard_radius"),
    real<&Constants::octree_size, octree_size>("octree_size"),
    real<&Constants::surface_thickness, number::positive>("surface_thickness"),
};

} // namespace

std::span<const std::string_view> constant_names() {
    static const auto names = [] {
        std::array<std::string_view, table.size()> all;
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = table[i].name;
        return all;
    }();
    return names;
}

void set_constant(Constants& constants, std::string_view name, const JsonValue& value) {
    for (const ConstantInfo& info : table)
        if (info.name == name)
            info.set(constants, value);
}

void read_constants(const JsonValue& json, Constants& constants) {
    json.check_keys(constant_names());
    for (const std::string_view name : constant_names())
        if (const auto value = json.find(name))
            set_constant(constants, name, *value);
}

nlohmann::json constants_json(const Constants& constants) {
    nlohmann::json json = nlohmann::json::object();
    for (const ConstantInfo& info : table)
        json[std::string(info.name)] = info.get(constants);
    return json;
}

} // namespace lockstep

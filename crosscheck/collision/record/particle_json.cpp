#include "crosscheck/collision/record/particle_json.hpp"

#include <cstring>
#include <string_view>
#include <vector>

#include "reference/model/collision/collision_state.hpp"

namespace lockstep {

using nlohmann::json;

json state_json(const ParticleState& state) {
    const View item = view(state);
    json fields = json::object();
    for (std::size_t f = 0; f < item.fields().size(); ++f) {
        std::vector<std::uint32_t> words;
        for (int c = 0; c < item.fields()[f].components; ++c)
            words.push_back(item.value(f, 0, c).bits);
        fields[item.fields()[f].name] = words_text(words);
    }
    return fields;
}

ParticleState read_state(const JsonValue& value) {
    ParticleState state;
    const WritableView item = view(state);
    std::vector<std::string_view> names;
    for (const Field& field : item.fields())
        names.push_back(field.name);
    value.check_keys(names);
    for (std::size_t f = 0; f < item.fields().size(); ++f) {
        const Field& field = item.fields()[f];
        const auto words = read_words(value.at(field.name), static_cast<std::size_t>(field.components));
        std::memcpy(item.columns[f], words.data(), words.size() * sizeof words[0]);
    }
    return state;
}

std::string as_utf8(const std::string& text) {
    return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

} // namespace lockstep

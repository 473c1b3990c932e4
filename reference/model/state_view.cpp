#include "reference/model/state_view.hpp"

#include <algorithm>

namespace lockstep {

std::size_t find_word(const View& state, std::uint32_t word) {
    std::size_t first = state.count();
    for (std::size_t f = 0; f < state.columns.size(); ++f)
        for (std::size_t i = 0; i < first; ++i)
            for (int c = 0; c < state.fields()[f].components; ++c)
                if (state.value(f, i, c).bits == word)
                    first = i;
    return std::min(first, state.count());
}

bool has_nan(const View& state, std::size_t item) {
    for (std::size_t f = 0; f < state.columns.size(); ++f)
        for (int c = 0; c < state.fields()[f].components; ++c)
            if (state.value(f, item, c).is_nan())
                return true;
    return false;
}

std::vector<Component> components(const Resource& resource) {
    std::vector<Component> all;
    for (std::uint8_t f = 0; f < resource.fields.size(); ++f)
        for (int c = 0; c < resource.fields[f].components; ++c)
            all.push_back({f, c});
    return all;
}

std::vector<std::uint32_t> item_words(const View& state, std::size_t item) {
    std::vector<std::uint32_t> words;
    for (const Component& c : components(state.about()))
        words.push_back(state.value(c.field, item, c.component).bits);
    return words;
}

} // namespace lockstep

#pragma once
#include <algorithm>
#include <cstddef>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/system_state.hpp"
#include "reference/readings/decided.hpp"
#include "reference/system/pixel_boxes.hpp"

namespace lockstep {

// What a twin reads of the item that it makes, or of texels beside it: of one, or of as many as a reading has lanes
// (lane_items.hpp has the same of those).

inline Pixel pixel_at(int width, std::size_t item) { return Pixel::of(width, item); }
inline const Pixel& first_of(const Pixel& pixel) { return pixel; }

template <class R>
typename R::Real item_real(R& r, At at, const SystemView& state, FieldId field, std::size_t item, int component = 0) {
    return r.read(at, state.real(field, item, component));
}
/// The same as it stands.
inline float raw_real(const SystemView& state, FieldId field, std::size_t item, int component = 0) {
    return state.real(field, item, component);
}
/// The first three components of a vec4.
template <class R> typename R::Vec3 item_vec3(R& r, At at, const SystemView& state, FieldId field, std::size_t item) {
    return r.read(at, glm::vec3(state.vec4(field, item)));
}
template <class R>
typename R::Real whole_real(R& r, const SystemView& state, FieldId field, std::size_t item, int component = 0) {
    return r.real(state.word(field, item, component));
}

inline int clamped(int i, int low, int high) { return std::clamp(i, low, high); }
inline bool is_among(int i, int size) { return i >= 0 && i < size; }

/// The item of a texel.
inline std::size_t item_of(int x, int y, int width) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}
/// An integer that a reading knows, as an index.
template <class R> IndexOf<R> index_of(const typename R::Int& i) {
    if constexpr (HasLanes<R>)
        return IndexOf<R>(i.v);
    else
        return static_cast<int>(i);
}

} // namespace lockstep

#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "reference/model/dust/host.hpp"
#include "reference/model/dust/schema.hpp"
#include "reference/model/state_view.hpp"

/// What the fast ways of kernels share (ItemPassOptions::fast): grains in blocks of block_size.
namespace lockstep::dust {

/// Whether a view to write has the field.
inline bool has(const WritableView& view, FieldId field) { return view.columns[field.field] != nullptr; }

/// Where a field's words of a grain lie.
template <class Byte> Byte* words_at(const BasicView<Byte>& view, FieldId field, std::size_t grain) {
    return view.columns[field.field] +
           grain * static_cast<std::size_t>(view.fields()[field.field].components) * sizeof(float);
}

/// Grains first to last, the last excluded, as they were; tiny numbers 0 where the arithmetic reads them so.
void keep(const View& before, std::size_t first, std::size_t last, const WritableView& after, bool exact);

/// As far as a tool or a blast reaches: a kernel leaves grains outside as they are.
struct Reach {
    glm::vec3 centre{0.0F}, axis{0.0F, 0.0F, 1.0F};
    float sqr_range = 0.0F;
    float cosine = all_around; ///< of the cone's half angle
    static constexpr float all_around = -2.0F;
};

/// The vacuum's or the wind's cone in a frame.
Reach cone_of(const FrameValues& values);

/// Sets `marks` of a block where a position may be inside: of all that are, and of some beside the border, which a
/// twin's rounding may see otherwise. `positions`: three a grain, of block_size grains.
void mark(const Reach& reach, const float* positions, std::uint32_t* marks);

} // namespace lockstep::dust
